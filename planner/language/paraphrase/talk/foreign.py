"""English of learners and of children: *please to bring for me*, *me want cookie*, *it gives a stapler*."""

from __future__ import annotations

_DEED = r"(?:bring|take|put|go|get|fetch|give|come|carry|move|find|drop|return|look|hand|pick|place|pass|grab|drive)"
_DET = r"(?:the|an?|my|some|one|two|three|his|her|that|those|any|all|both|every)"
_ROOMS = (
    r"(?:room|kitchen|hall|hallway|office|bathroom|bedroom|garage|pantry|library|house|home|building|flat|place|terrace"
    r"|laundry|lab|gym|ward|storage|table|desk|shelf|cabinet|drawer|box|bag|fridge|cupboard|wardrobe|couch|sofa"
    r"|floor)s?"
)

FOREIGN: tuple[tuple[str, str], ...] = (
    (
        (
            rf"^((?:please |can you |could you |you |and |then )*)(?:search|seek|look|find for|search me)(?: for"
            rf"| after)? "
            rf"(?!.* for )(?=(?:the|my|his|her|our) [\w ]+?[.!?]*$)(?![\w ]*\b{_ROOMS}\b)(?!after\b)"
        ),
        r"\1find ",
    ),
    (r"\bits (?=(?:in|on|at|under|next|near|by|not|an?|the|too|so|very|here|there)\b)", "it is "),
    (r"\bnxt\b", "next"),
    (r"\b([a-z]+)'s got (?=an?\b|the\b|no\b|some\b|to\b|his\b|her\b)", r"\1 has "),
    (r"^(?:ich meine|entschuldigung|bitte|por favor|s'il vous plait|alors|also)[,.!]* (?=\w)", ""),
    (r"\b(?:da|tha|ze|dah)\b(?= \w)", "the"),
    (r"\b(?:dis)\b(?= \w)", "this"),
    (r"\b(?:dat)\b(?= \w)", "that"),
    (r"\b(?:rn|atm|right now rn)\b(?=[.!?]*$)", "right now"),
    (r"\bblu\b", "blue"),
    (r"^(?:pretty |pwetty |very )(?=please\b)", ""),
    (r"^(?:please,? )?to (?=(?:bring|take|put|go|get|fetch|give|carry|move|find|come)\b)", ""),
    (rf"\b({_DEED}) please (?=\w)", r"\1 "),
    (
        rf"\b(bring|get|fetch|take|carry|give) (?:for|to) (me|us|him|her) (?={_DET}\b|\w+(?:[.!]*$| from| in| on| of))",
        r"\1 \2 ",
    ),
    (r"^me (?:want|wants|wanna have|need|needs|like|likes)(?: to have| have)? ", "i want "),
    (r"\b(?:i am|we are) (?:needing|wanting|requiring|wishing)(?: for)? ", "i need "),
    (r"\b(\w+) (?:is|are) (?:needing|wanting|requiring|wishing for) ", r"\1 needs "),
    (
        (
            r"\b(?:i|we) (?:would like|want|need|wish|would prefer|prefer|ask)(?: it)? that you "
            r"(?:should |shall |will |please )?"
            rf"(?={_DEED}\b)"
        ),
        "",
    ),
    (
        (
            r"\b(?:i|we) (?:would like|want|need|wish|would prefer|prefer) (?:it )?(?:that |if "
            r")(?=(?:the|my|his|her|all|both|every)"
            r" [^,.;]+? (?:is|are|be|goes|go|gets|comes|were|was)\b)"
        ),
        "make sure that ",
    ),
    (r"\b(make sure that [^,.;]+?) (?:goes|gets|comes|were|was) (?=(?:to|in|on|into|onto|at|next)\b)", r"\1 is "),
    (r"\bit gives (?=an?\b|some\b|the\b)", "there is "),
    (r"^where (?:stays|stands|lies|sits|lives|remains) (?=(?:the|my|our|his|her)\b|\w+[?.]*$)", "where is "),
    (
        (
            r"^(?:i|we) (?:search|seek|am searching|look)(?: for)? ([\w' ]+?)[,.;]+ where (?:he|she|it|they) (?:is|are)"
            r"(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (r"(?:^|(?<=[,;.] ))where (he|she|it|they) (is|are)(?=[?.!]*$)", r"where \2 \1"),
    (
        (
            r"\b(go|drive|walk|come|move|head) (?:in|on|at|inside) (?=(?:kitchen|bathroom|bedroom|"
            r"living room|office|hall|garage|"
            r"library|laundry|pantry|storage|terrace|balcony|gym|lab)\b)"
        ),
        r"\1 to ",
    ),
    (
        (
            rf"\b({_DEED} (?:me |him |her )?(?:the|an?|my)) (\w+) (red|green|blue|yellow|black|white|brown|pink|"
            r"purple|gray|grey)(?=[.,!?]*$| (?:to|on|in|for|from|at|into|onto)\b)"
        ),
        r"\1 \3 \2",
    ),
)
"""In the order in which they are tried."""
