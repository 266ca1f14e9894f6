"""Ways of saying *back where it was*: *to its old place*, *from where you took it*."""

from __future__ import annotations

import re

_THEY = r"(?:you|we|i|it|they|she|he|that|this|those)"
_PLACED = (
    r"(?:got|get|found|find|took|taken|take|picked|grabbed|fetched|retrieved|came|come|comes|been|stood|lay|sat|was"
    r"|were|brought|removed|moved|belongs?|belonged|goes|go|used to be|had been|lived?|lives)"
)
_SPOT = r"(?:place|spot|position|location|home|whereabouts)"
_OLD = (
    r"(?:old|original|previous|former|usual|proper|right|rightful|own|initial|first|earlier|normal|prior|same|"
    r"correct)"
)
_ADDED = (
    r"(?: before| originally| earlier| at first| lying| standing|"
    r" sitting| kept| initially| in the first place| again| previously)?"
)
_AS_IT_WAS = (
    rf"(?:exactly |just )?(?:how|as|like|the way|the same way) {_THEY} (?:was|were|had (?:it|them)|found (?:it|them))"
)
_OWN_PLACE = rf"(?:in|on|to|into|at) (?:its|their) (?:{_OLD} )?{_SPOT}"
_DONE = (
    r"(?:(?:read|used|seen|heard|had|finished|done)(?: (?:reading|using|drinking|eating|with))?"
    r"(?: (?:it|them|that|this|those))?|(?:done|finished|through)(?: (?:reading|using|drinking|eating|looking|with it"
    r"|with them|with that))?)"
)

RETURNING: tuple[tuple[str, str], ...] = (
    (
        (
            r"(?:^|(?<=[.;!,] ))(?:and |so |now |then |ok )*back(?: again)? with (it|them|that|those|both) "
            r"(?=(?:to|in|into|on|onto) )"
        ),
        r"put \1 back ",
    ),
    (
        (
            r"^(?:and |so |now |then |ok |please )*(?:get|take|fetch) (it|them) back,? and (?:then )?(put"
            r"|bring|take|carry"
            r"|give) (?:it|them) "
        ),
        r"\2 \1 ",
    ),
    (
        (
            rf"^(?:(?:i|we|he|she|they) (?:have|has|am|are|is)|[a-z]+'s|[a-z]+ (?:is|has)|all)(?: now| all|"
            rf" just| already)? {_DONE}"
            r"(?: now| already| again)?[,.;!]+ (?:and |so |now )*"
            r"(?=(?:back|put|take|bring|return|carry|move|it|they|you can|could|can|please)\b)"
        ),
        "",
    ),
    (
        (
            r"^((?:i|we|he|she) (?:do|does) not (?:want|need) (?:it|them|that)(?: any ?more| now| any"
            r" longer)?) (?=(?:put|take|bring|return)\b)"
        ),
        r"\1, ",
    ),
    (
        (
            rf"^back (?:it|they|that) (?:goes|go)(?: again| now| please| then| {_OWN_PLACE}"
            rf"| (?:to )?where {_THEY} (?:was|were|came from|found it|got it from|belongs?))+(?=[.!]*$)"
        ),
        "put it back where it was",
    ),
    (
        (
            rf"(?:^|(?<=[.;!] ))back(?: again| {_OWN_PLACE}| (?:to )?where it (?:was|came from|belongs))? with"
            rf" (?:it|them|that)(?=[.!]*$)"
        ),
        "put it back where it was",
    ),
    (
        (
            r"\b(?:stick|pop|shove|slip|tuck|stow|chuck|plonk|hang|lay|stand|whack|bung|chuck|pack|slot)"
            r" ((?:it|them|that|those|these|both|(?:the|my) [\w ]+?)) back(?! (?:and|up|down)\b)"
        ),
        r"put \1 back",
    ),
    (r"\b(put|return|take|bring|carry|move|get|fetch|give) both of (?:them|these|those)\b", r"\1 both"),
    (
        (
            rf"\b(?:put|set|leave|move|return) (?:it|them|that|things|everything|it all)(?: back)?(?: to)?"
            rf" {_AS_IT_WAS}(?: before| originally)?(?=[.!]*$)"
        ),
        "put it back where it was",
    ),
    (
        (
            r"\b(?:go |go and )?(?:get|fetch|take|collect|grab|retrieve|pick up) (it|them) (?:back )?(?:from|off) \w+"
            r"(?:,| and)+ (?:then )?(?:put|return|bring|take|carry) (?:it|them) back(?: again)?(?=[.!]*$)"
        ),
        r"put \1 back",
    ),
    (
        (
            rf"\b(?:return|take|bring|put|carry) (it|them|these|those|that) (?:back )?(?:to|on|in|onto|into) "
            rf"(?:the|my|\w+'s) [\w ]+?,? where {_THEY} (?:was|were|found it|got it from|came from|belongs?)(?=[.!]*$)"
        ),
        r"put \1 back where it was",
    ),
    (
        (
            r"^(\w+ (?:needs|wants|would like)) (it|them|(?:the|his|her|my) [\w ]+?) back(?: now| again|"
            r" please)?(?=[.!]*$)"
        ),
        r"\1 \2",
    ),
    (r"^(?:please )?(?:undo|revert|reverse|roll back)(?=[.!]*$)", "undo that"),
)
"""In the order in which they are tried."""

_RESTORING = r"\b(?:put|return|take|bring|carry|move|place|set|leave|drop|get|give|restore|go)\w*\b"

_ORIGIN = (
    (
        rf"back (?:to|in|into|on|onto|at) (?:the|its|their|that) [\w ]{{2,40}}? (?:where|that"
        rf"|which) {_THEY}(?: originally| just)?(?: had| have| has)?"
        rf" {_PLACED}(?: it| them| that)?(?: up)?(?: from| off| out of)?{_ADDED}"
    ),
    (
        rf"(?:back )?(?:(?:to|in|into|at|on|from) )?(?:exactly |right |just )?(?:(?:the|its|their) )?(?:{_OLD} )?"
        rf"(?:{_SPOT} )?(?:from where|where|wherever|from which)"
        rf" {_THEY}(?: originally| first| just)?(?: had| have| has)?"
        rf" {_PLACED}(?: it| them| that| this| those)?(?: up)?(?: from)?{_ADDED}"
    ),
    (
        rf"(?:back )?(?:to|in|into|on|at) the {_SPOT} (?:that |which |where )?{_THEY}(?: had| have)? {_PLACED}"
        rf"(?: it| them| that)?(?: up)?(?: from| in| at| on)?{_ADDED}"
    ),
    (
        rf"(?:back )?(?:to|in|into|on|at) (?:its|their|the|his|her|it is) (?:{_OLD},? )*{_SPOT}{_ADDED}"
        r"(?! (?:of|where|in|on|at)\b)"
    ),
    rf"back (?:to|in|into|on|onto|at) (?:its|their) (?!{_OLD}\b|{_SPOT}\b)\w+(?! (?:of|in|on|next|at|where)\b)",
    rf"back (?:to|in|into|on|onto) (?:the|its|their) [\w ]{{2,40}}? where {_THEY} (?:was|were|came from){_ADDED}",
)
BACK = re.compile(rf"({_RESTORING}[^.;?!]*?) (?:{'|'.join(_ORIGIN)})(?=$|[\s.,;!?])")
"""A verb of putting, what is put, and the place that it came from."""
