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
_ADDED = r"(?: before| originally| earlier| at first| initially| in the first place| again| previously)?"
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
