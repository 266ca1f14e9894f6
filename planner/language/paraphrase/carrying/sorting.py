"""Ways of asking for order: *gather up the cups and put them in the sink*, *toys everywhere, put them in the box*."""

from __future__ import annotations

_PUT = r"(?:put|bring|take|carry|drop|move|place|stick|pop|throw|chuck|stow|set)"
_THEM = r"(?:them|it|them all|it all|all of them|everything)"
_LYING = (
    r"(?:everywhere|all over(?: the (?:place|floor|room|house))?|(?:lying|scattered|spread|strewn)"
    r"(?: (?:around|about|everywhere|all over(?: the (?:place|floor))?))?)"
)

SORTING: tuple[tuple[str, str], ...] = (
    (r"\b(?:gather|scoop|round) (?:up|together) (?=(?:the|all|my|both|every|any)\b)", "collect "),
    (
        r"^(?:please )?(?:make|get) ((?:the|my|that|this) [\w ]+?) (?:empty|clear|tidy|neat|clean|cleared)(?=[,.;:])",
        r"clear \1",
    ),
    (
        (
            rf"^((?:the|my|all the) [a-z ]+?s) (?:is|are) {_LYING}[,.;!]+ (?:so |please |can you |could you"
            rf" )*{_PUT} {_THEM} (?=\w)"
        ),
        r"put \1 ",
    ),
)
"""In the order in which they are tried."""
