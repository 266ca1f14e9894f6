"""Slips of the keys in the small words, which no name of the graph can settle: *cna you*, *hwere is*, *to me the*."""

from __future__ import annotations

_CARRYING = r"(?:take|bring|carry|give|hand|deliver|send)"

MISTYPED: tuple[tuple[str, str], ...] = (
    (r"^[-*•>–]+\s+(?=\w)", ""),
    (r"(?<=\w)\s*(?:&|\+)\s*(?=[a-z])", " and "),
    (r"\bb4\b", "before"),
    (r"\b(?:wat|wut|whut|waht|wht|hwat|wath|whta)\b(?= (?:is|are|r|u|you|do|can|color|colour|room|did|was)\b)", "what"),
    (r"\bgt(?= (?:me|the|my|him|her|it|a|an)\b)", "get"),
    (r"^((?:please |can you |could you )*)got to (?=(?:the|my|teh|\w+'s)\b)", r"\1go to "),
    (r"\b(need|want|bring|take|get|put|give|fetch|find|move|carry|leave|see|have|hand|drop|of) '?em\b", r"\1 them"),
    (r"\b(?:cna|acn|cen|cann|cabn|cn|vcan|xan|czn|ca|kan)(?= (?:you|u|i|we)\b)", "can"),
    (r"\b(?:cud|coud|coukd|coudl|culd|cld)(?= (?:you|u|i|we)\b)", "could"),
    (r"\b(?:wud|woud|woudl|wuold|wld)(?= (?:you|u)\b)", "would"),
    (r"\b((?:can|could|would|will|do) )(?:u|yu|yo|ypu|tou)\b", r"\1you"),
    (r"\b(?:hwere|whre|wehre|wheer|whare|whear|wher|whrere|were)(?= (?:is|are|the hell|on earth)\b)", "where"),
    (r"^(?:whres|weres|wheres|wher's|wheer's|whers)\b", "where is"),
    (r"\b(?:gte|egt|gett)\b", "get"),
    (r"\b(?:ptu|upt|putt|puth|puut|pu|pit|oput)\b(?= (?:t?the|my|it|them|that|this|all|a|an|his|her)\b)", "put"),
    (r"\b(?:tak|teak|taek|tkae|atke)(?= (?:the|my|this|that|it|them|an?|teh|all|both)\b)", "take"),
    (r"\b(?:giv|gvie|gice|guve)\b", "give"),
    (r"^(i|we) (?:ned|nede|nead|neeed|nned|neded)\b", r"\1 need"),
    (r"^(i|we) (?:wnat|watn|wan|wamt|wnt|whant)\b(?! to\b)", r"\1 want"),
    (r"\b(?:thr|tge|tje|rhe|tthe|tha|thw|yhe|ht)(?= [a-z])", "the"),
    (r"\b(me|him|her|us)the\b", r"\1 the"),
    (r"\b(?:ot|tio|tpo)(?= [a-z])", "to"),
    (r"\bgot o(?= )", "go to"),
    (r"(?<=[a-z])2(?=(?:the|me|my|his|her|[a-z]{3,})\b)", " to "),
    (r"\b(the|my) ?, (?=\w)", r"\1 "),
    (
        r"\b((?:put|bring|take|move|carry|leave|return|place) (?:it|them|that) back) (?:were|wher|whre)(?= )",
        r"\1 where",
    ),
    (
        (
            rf"\b({_CARRYING}\b[^,.;]*? )too (?!please|now|then|and|thanks?|thx|for|if|when|to|from|in|on"
            rf"|at|as|but|with"
            r"|many|much)(?=[a-z]+[.!]*$)"
        ),
        r"\1to ",
    ),
)
"""In the order in which they are tried."""
