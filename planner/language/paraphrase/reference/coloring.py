"""Ways of telling a color and a spot: *a cup, blue or white*, *it has to be green*, *in the middle of the table*."""

from __future__ import annotations

_COLOR = r"(red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange|gold|silver|beige|turquoise)"
_MIDDLE = r"(?:very |exact )?(?:middle|cent(?:er|re))"
_ROOM = (
    r"(?=(?:the|my|our|his|her) (?:\w+ )?(?:room|kitchen|hall|hallway|office|bathroom|bedroom|garage|pantry"
    r"|library|laundry"
    r"|lab|gym|ward|terrace|corridor|lobby|house|reception|storage|studio|playroom|cellar)\b)"
)

COLORING: tuple[tuple[str, str], ...] = (
    (rf"\b(an?|any|some|the|one) {_COLOR} or (?:an? |the |some )?{_COLOR} (?=\w)(?!one)", r"a \2 or \3 "),
    (rf"\b(an?|any|some) (\w+(?: \w+)?), (?:either )?{_COLOR} or {_COLOR}(?: ones?)?(?=$|[.!?,])", r"a \3 or \4 \2"),
    (
        rf"\b(?:whose colou?r is|with the colou?r|of the colou?r|in the colou?r|that has the colou?r) {_COLOR}\b",
        r"that is \1",
    ),
    (rf"\b(any|an?) (\w+),? but (?:not )?(?:an? |the )?{_COLOR}(?: one)?(?=$|[.!?])", r"\1 \2 that is not \3"),
    (
        (
            rf"\b(an?|the|my|any|some|one) (\w+(?: \w+)?)[,.;] (?:it|they|that|which) (?:really |absolutely "
            rf"|just )?(?:has to|have"
            rf" to|must|should|needs to|ought to|is to) be (?:the |an? )?{_COLOR}(?: ones?)?(?=[.!?]*$)"
        ),
        r"\1 \2 that is \3",
    ),
    (
        (
            rf"\b(an?|the|my|any|some|one) (\w+(?: \w+)?)[,.;]? (?:preferably|ideally|if possible|best|rather|at "
            rf"best|but if"
            rf" possible|hopefully)(?: (?:the|an?|in))? {_COLOR}(?: ones?)?(?=$|[.!?,])"
        ),
        r"\1 \2 that is \3",
    ),
    (
        (
            rf"\b(an?|the|my|any|some|one) (\w+(?: \w+)?)[,.;] (?:the |an? )?{_COLOR}(?: ones?)?,? if (?:possible"
            rf"|you can|there is one|you have it)(?=[.!?]*$)"
        ),
        r"\1 \2 that is \3",
    ),
    (r"^(?:i|we) prefer (?=(?:the|an?|some|my)\b)", "i want "),
    (rf"^not the {_COLOR} (\w+),? (?:but )?(?:the )?{_COLOR}(?: one| \2)?(?=[.!?]*$)", r"the \3 \2"),
    (rf"\b(?:in|into|at|to|on) the {_MIDDLE} of {_ROOM}", "in "),
    (rf"\b(?:in|into|at|to|on|onto) the {_MIDDLE} of (?=(?:the|my|our|his|her)\b)", "on "),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou ))(?:go|stand|wait|drive"
            r"|come|park|move|stop)"
            r"(?: yourself)? (?:behind|(?:to |on )?the (?:left|right) of|(?:left|right) of|underneath|to the side of"
            r"|to the (?:left|right)(?:-hand)? side of) (?=(?:the|my)\b)"
        ),
        "go to ",
    ),
    (r"^what is (nearest|closest)(?: to (?:you|me|us|here))?(?=[?.!]*$)", r"what is the \1 thing"),
)
"""Before the rules of ``CHOOSING``."""
