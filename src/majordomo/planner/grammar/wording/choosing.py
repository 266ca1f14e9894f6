"""Ways of saying which one: *but not the red one*, *the one nearest to you*."""

from __future__ import annotations

CHOOSING: tuple[tuple[str, str], ...] = (
    (
        (
            r"\b((?:an?|any|one|some) [\w ]+?), (?:(?:any|either|whichever)(?: one)?(?: of (?:them|those|the two))?"
            r"(?: (?:will|would) do| (?:is|are) (?:fine|ok|okay|good|all right|alright))?"
            r"|(?:i do not (?:care|mind)|(?:it )?does not matter) which(?: one)?)(?=$|[.!?,]),?"
        ),
        r"\1",
    ),
    (r"\b(one|two|three|any|some|either|each) of the (?:two|three|four|five|six|\d+) (?=\w)", r"\1 of the "),
    (r"\b(?:further|farther)(?: away)? from\b", "farthest from"),
    (r"\b(the \w+est [\w ]+?) (?:that )?there is\b", r"\1"),
    (r"\bneither (\w+) nor (\w+),? nor (\w+)\b", r"neither \1 nor \2 and is not \3"),
    (
        (
            r"^(?:out )?of (?:the|all the|both|those|these) (?:two |three |four |five )?(\w+?)s,? ([^,]+?) the one "
            r"(?=(?:that|which|in|on|at|next|by|near|nearest|closest)\b)"
        ),
        r"\2 the \1 ",
    ),
    (
        r"\b(every|all(?: the)?|each) ([\w ]+?) (?:that )?you (?:can )?(?:find|see) and (?=(?:put|bring|take)\b)",
        r"\1 \2 and ",
    ),
    (r"\b(with (?:the|an?|my|some) [\w ]+?) (?:in|on|inside) it\b", r"\1"),
    (
        (
            r"\b(every|all(?: the| of the| my| our)?|any|each|the|both) ([\w ]+?) (?:that |which )?(?:we|i"
            "|you) (?:own|possess|have got|have|can find|can see|know of)(?=$|[,.!]| (?:go|goes|should|to|in"
            r"|on|into|onto|belong|belongs)\b)"
        ),
        r"\1 \2",
    ),
    (r"^not the (\w+) (\w+),? (?:but )?(?:the )?(?:other)(?: ones?)?,? ", r"the \2 that is not \1 "),
    (
        (
            "(?:,|,? (?:only|but|just|and))(?: (?:only|but|just|and|so|please))* (?:do not|not) (?:take|bring"
            r"|use|fetch|get|grab|give)(?: me| him| her)? (the \w+ ones?)(?=[.!]*$)"
        ),
        r" except \1",
    ),
    ("^without (?:touching|taking|using|moving|bringing|disturbing) (.+?), (.+?)(?=[.!]*$)", r"\2 except \1"),
    (r",? without (?:touching|taking|using|moving|bringing|disturbing) (?=(?:the|any|my)\b)", " except "),
    (r"\b(?:somewhere|anywhere) (?=(?:in|on|at)\b)", ""),
    (
        r",? (?:anything|any color|whatever|everything|all) but (?:the |a )?(\w+)(?: ones?)?(?=$|[.!?,])",
        r" that is not \1",
    ),
    (
        (
            r",?(?<!\bis)(?<!\bare)(?: and| but| just| only)* not (?:a |the |an |any )(\w+)(?: ones?"
            "| colou?red one)(?=$|[.!?])"
        ),
        r" that is not \1",
    ),
    (r"\breddish\b", "red"),
    (r"\b(green|brown|yellow|pink|gray|grey|black|orange)ish\b", r"\1"),
    (r"\bblu(?:e)?ish\b", "blue"),
    (r"\b(nearest|closest|farthest|furthest)( one)?(?: to (?:you|here|us)| from (?:here|you|us))", r"\1"),
    (r"\b(?!is\b|are\b|the\b)(\w+)(?: that is| which is)? (nearest|closest|farthest|furthest)(?=$|[.!?,])", r"\2 \1"),
    (
        (
            "(?:, it is|, which is|, that is|, i mean) the (biggest|largest|smallest|nearest|closest"
            "|tallest) (?:one|of them)?"
        ),
        r", the \1 one",
    ),
    (
        (
            r"\b(?:somewhere|anywhere|around here|in this (?:house|home|building|school|office|hospital|flat"
            "|apartment|place)|in the (?:house|home|building|school|hospital|flat|apartment)|at all"
            "|lying around|around)(?=$|[.!?])"
        ),
        "",
    ),
    (r"\b(are there|is there|do we have|have we got|do you have|have you got) (any|some|a) (.+?) left\b", r"\1 \2 \3"),
    (r"^how many (.+?) are\s*[?]*$", r"how many \1 are there"),
    (" from the (?:left|right)(?=$|[.!?])", ""),
    (r"\b(in|into|on|onto|at|near|to) the (nearest|closest) (\w+) to (?=the\b)", r"\1 the \3 nearest to "),
    (
        r"\b((?:in|into|on|onto|at|from|next to) (?:the|a|that) \w+(?: \w+)?)(?<! over) there(?=$|[.!?,])",
        r"\1 over there",
    ),
)
"""In the order in which they are tried."""
