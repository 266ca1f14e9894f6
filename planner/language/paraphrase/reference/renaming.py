"""Names that are told as news: *the den has been renamed to lab*, *the den is what we call the library*."""

from __future__ import annotations

_PEOPLE = r"(?:we|i|you|they|people|everybody|everyone|the (?:kids|children|family|staff|others))"
_SINCE = (
    r"(?:from (?:today|now|here|this day|tomorrow)(?: on(?:wards?)?)?|as of (?:today|now|tomorrow)|starting "
    r"(?:today|now"
    r"|tomorrow|from now)|for (?:us|me|all of us)|from this (?:moment|minute|day) on(?:wards?)?"
    r"|for the future|for future reference|henceforth|nowadays|these days|in (?:our|this) (?:house|home|family"
    r"|office|school))"
)
_MIND = (
    r"(?:please )?(?:remember|note|memorize|keep|got|understand|understood|ok|okay|save|learn)(?: (?:that|it|this))?"
    r"(?: in mind)?"
)

RENAMING: tuple[tuple[str, str], ...] = (
    (
        (
            rf"^(?:and |so |ok |okay |,)*{_SINCE}[,:;]* (?=(?:the|this|that|my|our|we|i|you|call|please|\w+'s)\b)"
            r"(?=[^.?]*\b(?:call|calls|called|name|named|rename|renamed|known|is (?:the|our|my)|will be|shall be)\b)"
        ),
        "",
    ),
    (
        (
            r"^((?:the|this|my|our) [\w' ]+?|(?:meeting room|ward|office|classroom|room) \w+) (?:shall be"
            r"|becomes?|is becoming"
            r"|is going to be|is to be|turns into|turned into|is turning into|has become|will become|(?:will |is "
            r"going to )?"
            r"(?:serves?|is used|be used|counts?) as|will now be|is from now on|will be used as) "
            r"(?=(?:the|my|our|a|an|\w+'s)\b)(?!(?:a|an) (?:mess|problem|bit)\b)"
        ),
        r"\1 is ",
    ),
    (r"\bthis (room|place) (?:right )?here\b", r"this \1"),
    (
        (
            r"^you are (?:(?:now|currently|here|standing|parked|right now|at the moment) )*in ((?:the|my|our) [\w ]+?)"
            r"(?: now| right now| here| at the moment)?(?=[.!]*$)"
        ),
        r"this room is \1",
    ),
    (
        (
            r"^(this is (?:the|our|my) [\w' ]+?),? (?:that |which |where )?(?:you|we) (?:are|stand)(?: standing| "
            r"parked)?"
            r"(?: in)?(?: now)?(?=[.!]*$)"
        ),
        r"\1",
    ),
    (r"^(?:please )?give ((?:the|this|my) [\w' ]+?) the (?:nick)?name(?: of)? (?=\w)", r"call \1 "),
    (r"^(?:please )?give the (?:nick)?name(?: of)? ([\w' ]+?) to ((?:the|this|my) [\w' ]+?)(?=[.!]*$)", r"call \2 \1"),
    (r"^(?:let|ensure) ((?:the|this|my) [\w' ]+?) be (?:called|named|known as) ", r"call \1 "),
    (
        (
            r"^(?:the )?([\w']+) is (?:my|our|the|a|her|his) (?:(?:pet|own|new|special) )?(?:nick)?(?:name|word) for "
            r"((?:the|this|my) [\w' ]+?)(?=[.!]*$)"
        ),
        r"call \2 \1",
    ),
    (
        (
            r"^(?:the |that |this )((?:\w+ )*?)(\w+) (?:belongs to|is owned by) (?!me\b|us\b|the\b|my\b|it\b|him\b"
            r"|her\b|them\b)(\w+)"
            r"(?=[.!]*$)"
        ),
        r"call the \1\2 \3's \2",
    ),
    (
        r"^(?:the |that |this )((?:\w+ )*?)(?!it\b|that\b)(\w+) is (?!it's\b|that's\b)(\w+'s)(?: own)?(?=[.!]*$)",
        r"call the \1\2 \3 \2",
    ),
    (r"^(?:the |that |this )((?:\w+ )*?)(\w+) belongs to (?:me|us)(?=[.!]*$)", r"call the \1\2 my \2"),
    (r"^(the \w+ one) is ((?:my|our) \w+)(?=[.!]*$)", r"\2 is \1"),
    (
        (
            r"^(?:(?:everybody|everyone|all|most people|my (?:\w+ )?\w+|the \w+|people|they|you can|you may|you "
            r"should|just"
            r"|please) (?:all |usually |always |just |mostly )*(?:calls?|address(?:es)?) me|i go by(?: the "
            r"name(?: of)?)?"
            r"|i am known as|i answer to|people know me as|(?:(?:the|my) )?name(?: here)?(?: is|'s)|it is(?= \w+ "
            r"here[.!]*$)) "
            r"(?!(?:the|a|an|my|his|her)\b)(\w+(?: (?!here\b)\w+)?)(?: here)?(?=[.!]*$)"
        ),
        r"my name is \1",
    ),
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
