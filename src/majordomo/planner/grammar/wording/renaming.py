"""Names that are told as news: *the den has been renamed to lab*, *the den is what we call the library*."""

from __future__ import annotations

_PEOPLE = r"(?:we|i|you|they|people|everybody|everyone|the (?:kids|children|family|staff|others))"
_SINCE = (
    r"(?:from (?:today|now|here|this day|tomorrow)(?: on(?:wards?)?)?|as of (?:today|now)|starting (?:today|now"
    r"|from now)"
    r"|for the future|for future reference|henceforth|nowadays|these days|in our (?:house|home|family))"
)
_MIND = (
    r"(?:please )?(?:remember|note|memorize|keep|got|understand|understood|ok|okay|save|learn)(?: (?:that|it|this))?"
    r"(?: in mind)?"
)

RENAMING: tuple[tuple[str, str], ...] = (
    (
        (
            "^(?:just so you know|for your information|fyi|remember this|note this|learn this|please note"
            "|by the way|btw|listen)[,.:;]* "
        ),
        "",
    ),
    ("^(?:please )?(?:remember|note|know|keep in mind|learn|be aware|memorize|do not forget)(?: that|:|,)+ ", ""),
    (
        (
            rf"^((?:[^.?]*?\b)?(?:call|calls|called|named|name|rename\w*)\b[^.?]*?)"
            rf"(?:[,;]? {_SINCE})+(?=[.!]*$)"
        ),
        r"\1",
    ),
    (
        rf"^([^.?]*?\b(?:call|calls|called|named|name|rename\w*)\b[^.?]*?)[,;.] {_MIND}(?=[.!]*$)",
        r"\1",
    ),
    (rf"^(the .+?|this .+?) is (?:what|how) {_PEOPLE} (?:\w+ly |often |always )?(?:call|name)s? ", r"call \1 "),
    (
        (
            rf"^(?:{_PEOPLE} )?(?:have |has )?(?:just |now |recently )*(?:renamed|rebaptized|relabeled|rechristened)"
            r" (the [\w' ]+?|this [\w' ]+?)(?:,? (?:and )?(?:it|that|this) is (?:now )?(?:called|named)| to| as|"
            r" into)"
            r" (?:the )?(.+?)(?: now)?(?=[.!]*$)"
        ),
        r"call \1 the \2",
    ),
    (
        (
            r"^((?:the|this) [\w' ]+?) (?:has been|was|is being|got|gets|is going to be|will be|should be|must be"
            r"|is also|has just been|can be) (?:now )?(?:renamed|called|named|known|rechristened|relabeled"
            r"|referred to)"
            r"(?: to| as)? "
        ),
        r"call \1 ",
    ),
    (r"^((?:the|this) [\w' ]+?) has (?:a|an other) new name[,:;]* (?:it is )?(?:the )?", r"call \1 the "),
    (r"^((?:the|this) [\w' ]+?)'s (?:new|other) name (?:is|shall be|will be)(?: now)? (?:the )?", r"call \1 the "),
    (
        r"^((?:the|this) [\w' ]+?) (?:now )?(?:has|bears|carries|answers to|listens to) the name(?: of)? (?:the )?",
        r"call \1 the ",
    ),
    (
        (
            r"^(?:can|could|shall|may|might|should) (?:we|you|i) (?:please |maybe |perhaps )*(?:call|name|rename"
            r"|refer to)"
            r" (?=(?:the|this|my)\b)(.+?)(?: (?:as|to))? ((?:the )?\w+)(?=[?.!]*$)"
        ),
        r"call \1 \2",
    ),
    (r"^(?:change|switch|set) the (?:name|label) of (the .+?|this .+?) to (?:the )?", r"call \1 the "),
    (
        (
            r"\bthe (?:room|place) (?:that |which |where )?(?:you|we) (?:are|stand|have parked)(?: now| currently)?"
            r"(?: standing| sitting| waiting| parked| right now)?(?: in| at)?(?: (?:right )?now)?"
            r"(?= (?:is|shall|should|will|we|gets)\b)"
        ),
        "this room",
    ),
)
"""Before the rules of ``NAMING``."""
