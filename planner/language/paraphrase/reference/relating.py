"""Which one, told by who left it or where it can be found: *the cup you will find in the staff room*."""

from __future__ import annotations

_COLOR = (
    r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange|gold|silver|clear|small|big|large|little)"
)
_WHERE = r"(?=(?:(?:over|out|up|down|back) )?(?:in|on|at|inside|next to|by|near|under|with|beside)\b)"
_NO_NOUN = (
    r"(?:the|an?|my|his|her|that|this|no|not|only|me|him|it|them|which|what|other|and|"
    r"or|but|to|with|also|make|is|one)\b"
)
_DEED = r"(?:bring|take|put|get|fetch|give|carry|move|hand|pick|place|pass|grab)"

RELATING: tuple[tuple[str, str], ...] = (
    (
        (
            r"\b((?:that|which) (?:is|are) )?(on|in|from|at) the same (?!room\b)([\w]+(?: \w+)?) (?:as|like|where) "
            r"((?:the|my|his|her|a|an|that|those|all|every) [\w' ]+?|\w+)(?: (?:is|are))?"
            r"(?=,|[.!?]|$| (?:and|to|into|onto|for|if|unless) )"
        ),
        r"\1\2 the \3 where \4 is",
    ),
    (
        r"\b(?:(?:sharing|shares|that shares|which shares) (?:a|the|its) room with|(?:in|from) the same room where) ",
        "in the same room as ",
    ),
    (
        (
            r"\b(?:that|which) (?:i|you|we|he|she|they|someone|somebody|\w+) (?:have |had "
            r"|has |just )*(?:left|put|placed|"
            rf"dropped|forgot|forgotten|laid|set|saw|seen|kept|stored|keeps?|stores?)(?: "
            rf"lying| standing| down| behind)? {_WHERE}"
        ),
        "that is ",
    ),
    (
        (
            r"(?:\b(?:that|which) )?\b(?:you|we|i) (?:will|can|could|should|might|may|are "
            r"going to|ought to)(?: be able to)? "
            rf"(?:find|see|get|spot|discover) {_WHERE}"
        ),
        "that is ",
    ),
    (
        (
            r"\bwhat(?:ever)? (?:i|you|we|they|he|she|people|somebody|someone) (?:usually "
            r"|always )?(?:keep|keeps|have|has|"
            rf"store|stores|put|left|leave) {_WHERE}"
        ),
        "whatever is ",
    ),
    (
        (
            r"\bwhat (?:is|are|lies|stands) ((?:in|on|inside) (?:the|my|that) [^,.;]+?), (?=(?:bring|"
            r"take|put|carry|move|get)\b)"
        ),
        r"whatever is \1, ",
    ),
    (rf"\b(lying|sitting|standing|hanging|left|floating|laying) (?:around|about|there|over there) {_WHERE}", r"\1 "),
    (rf"\b(thing|stuff|one|object) (?:around|about) {_WHERE}", r"\1 "),
    (
        (
            rf"\b((?:{_DEED}|want|need|like|have)\b(?:(?! (?:it|them|to)\b)[^,.;!?])*? "
            rf"(?!(?:it|them|me|him|her|if|when|where|because|as|that|which|unless|until|since|once|so|and|or"
            rf"|but)\b)\w+)"
            rf"[,.;]? (?:it|they) (?:is|are|lies?|stands?|sits?)(?: lying| standing| somewhere)* "
            rf"(?=(?:in|on|at|inside|next to|by|near|under) [\w' ]+[.!]*$)"
        ),
        r"\1 that is ",
    ),
    (
        r"\b(the|my|that|an?) (\w+),? the one (?=(?:in|on|at|that|which|next|from|near|by|with|under|inside)\b)",
        r"\1 \2 ",
    ),
    (rf"\b(an?) (\w+), an? ({_COLOR}) one,? ", r"\1 \3 \2 "),
    (
        (
            rf"((?:^|\b{_DEED} )(?:me |him |her )?)(?!{_NO_NOUN}|{_DEED}\b)(\w+),? (?:the )?({_COLOR})"
            rf" one(?=,? (?:to|for|in|on)\b|[.!]*$)"
        ),
        r"\1the \3 \2",
    ),
    (r"(?<=\w): (?=the [\w ]*?ones?\b)", ", "),
    (
        (
            r"(?<=\w),? (?:and |just |but )*(?:any|either|just|only)? ?(?:one|two|three|four|a single one|half a dozen)"
            r"(?: of them| piece| pieces)? (?:is|are|will be|would be|will|would) (?:enough|"
            r"fine|plenty|sufficient|ok|okay|do|good)"
            r"(?=[.!]*$|[.,;!] )"
        ),
        "",
    ),
    (
        (
            r"(?<=\w), (?:just |only )?(?:any|either) (?:one|two|three|four|of them|will do)"
            r"(?: of them| will do)?(?=[.!]*$|[.,;:] )"
        ),
        "",
    ),
    (
        (
            r"\b(an?|some|one) ([\w ]+?)[,.;] (?:and |but )?there (?:is|are|should be|must "
            r"be) (?:one|some|a few|plenty|any)(?: left)? "
            r"(?=(?:in|on|at|under|next to) )"
        ),
        r"\1 \2 that is ",
    ),
    (r"\b(?:in|into|to) (?:that|the) same room\b(?! as)", "over there"),
    (
        (
            rf"^((?:any|some|one|two|three|all|both|either) (?![^,]*\b(?:is|are|was|were|will|would|has"
            rf"|have)\b)[^,.;!?]+?), "
            rf"(?:please |can you "
            rf"|could you )*({_DEED}) (?:it|them|one) "
        ),
        r"\2 \1 ",
    ),
    (
        (
            rf"^(?:what about|how about|as for|regarding|concerning|speaking of|now to|with "
            rf"regard to|you know|remember|you see) "
            rf"((?:the|my|that|those|his|her) [^,.;!?]+?)[?,.;:!]+ (?=(?:please |can you |could "
            rf"you |so )*{_DEED} (?:it|them)\b)"
        ),
        r"\1, ",
    ),
    (r"^(?:the|my|an?|that) (\w+)[!.]+ (?=the [\w ]*?\1\b)", ""),
    (
        (
            rf"^(?:any|an?|some) ([\w ]+?) (?:will|would) (?:do|be (?:fine|ok|okay|good)"
            rf"),? (?:as long as|so long as|if|provided) "
            rf"it is not (?:from|in) ([^,.;]+?)[,.;!]+ (?:so |just |please |and )*({_DEED})"
            rf" (me |him |her )?(?:one|it|any)"
            rf"(?: of them)?\b"
        ),
        r"\3 \4a \1 that is not in \2",
    ),
)
"""In the order in which they are tried."""
