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

_IT = r"(it|them|that|this|these|those|both|(?:the|my|his|her) [\w ]+?)"
_ASKED = (
    r"(?:(?:can|could|would|will) you (?:mind )?|i (?:want|need|would like) you to |do you mind |please |now |then "
    r"|and |just |kindly |quickly )*"
)
_AMISS = (
    r"(?:wrong|a mistake|my mistake|an error|not right|no good|silly|not what i (?:meant|wanted|asked for)|too much"
    r"|enough|all|it|(?:not )?the (?:wrong|right|other) (?:one|\w+)|not (?:it|the one(?: i \w+)?))"
)

AGAIN: tuple[tuple[str, str], ...] = (
    (
        rf"^{_ASKED}(?:undo(?:ing)?|revert(?:ing)?|revers(?:e|ing)) (?:it|that|this|everything|all that)(?=[.!?]*$)",
        "undo that",
    ),
    (
        (
            rf"^(?:oh |no |sorry |but |ok )*(?:that|this|it) (?:was|is|will be) (?:all )?{_AMISS}(?: now| then| for "
            rf"now)?"
            r"[,.;!]+ (?:so |and |please )*(?=(?:undo|put|take|return|bring|carry|move)\b)"
        ),
        "",
    ),
    (
        rf"\b(?:take|put|bring|carry|clear|move) {_IT} (?:away|off) again(?=$|[.,!?])",
        r"put \1 back where it was",
    ),
    (
        (
            rf"\b(?:put|set|lay|place|leave) {_IT} (?:back )?(?:down|away|over|up)(?: again)?"
            r"(?= (?:back )?(?:exactly |just |right )?(?:(?:to|in|on|at) )?(?:where|wherever|its|their)\b)"
        ),
        r"put \1 back",
    ),
    (
        rf"\b((?:put|set|lay|place|take|bring|return|carry|move) {_IT}\b[^.;!?]*?) again(?=$|[.,!?])",
        r"\1",
    ),
    (r"(?<= with )(it|them|that|this|these|those) again(?=$|[.,!?])", r"\1"),
    (
        (
            rf"\b(?:return|restore) {_IT} (?:to|in|on|onto|into|at) (?:its|their) (?!\w*owners?\b)[\w ]+?"
            r"(?=$|[.,;!?]| and )"
        ),
        r"put \1 back where it was",
    ),
    (
        (
            r"\b(?:put|place|set|lay|take) (it|them|that|this|these|those|both) (?:to|in|on|onto|into|at) (?:its"
            r"|their) "
            r"(?!\w*owners?\b)[\w ]+?(?=$|[.,;!?]| and )"
        ),
        r"put \1 back where it was",
    ),
    (
        (
            r"(?<=\w )(?<!and )(?<!then )(?<!please )(?<!now )(?<!to )(?:(?:can|may|could|should|must|might|will)"
            r"(?: both| all| now| please)* )?(?:go(?:es)?|belongs?) back (?:(?=(?:to|in|on|into|onto) (?:its|their)\b)|"
            r"(?:to |in |on )?(?:exactly |just |right )?(?=(?:where|wherever|its|their)\b))"
            r"(?!(?:to )?where(?:ver)? you (?:are|were|started|came|began|set|left)\b)"
        ),
        "should go back ",
    ),
    (
        (
            r"^\w+ (?:do|does) not (?:need|want|use|require|like) ((?:the|my|his|her|our|those|these|that) [\w' ]+?)"
            r"(?: any ?more| any longer| now| right now)*[,;.!]+ (?:so |and |please |you can |can you )*"
            r"(put|take|return|bring|carry) (?:it|them) (?=back\b)"
        ),
        r"\2 \1 ",
    ),
    (
        (
            r"\b(?:get|take|fetch|collect|pick up|grab|retrieve) ((?:the|my|his|her|our|those|these|that) "
            r"[\w' ]+?)(?: back)? "
            r"(?:back )?from (?!the\b|its\b|my\b)\w+(?:,| and)+ (?:then )?(?:put|return|bring|take|carry) (?:it"
            r"|them)(?: back)? "
            r"(?=(?:back|to (?:its|their)|where)\b)"
        ),
        r"put \1 back ",
    ),
    (
        (
            r"^(?:(?:no|oh|actually|on second thoughts?|wait|hang on|sorry)[,.! ]+)*do not[,.;!]+ (?:just |please )*"
            r"(?=(?:put|take|leave|return|bring)\b)"
        ),
        "",
    ),
    (
        (
            rf"^(?:and |so |now )*(?:you (?:can|may) (?:have|take)|(?!i\b|we\b)\w+ (?:wants?|needs?|would like)) "
            rf"{_IT} back "
            rf"(?=(?:to |in |on |at )?(?:where|its|their)\b)"
        ),
        r"put \1 back ",
    ),
    (rf"^(?:and |so |now )*you (?:can|may) (?:have|take) {_IT} back(?: again| now)?(?=[.!]*$)", r"put \1 back"),
    (
        (
            r"^(?:what an? |such an? )?(?:lovely|nice|great|beautiful|good|pretty|funny|interesting|wonderful) "
            r"\w+[.!,]+ "
            r"(?=(?:now |then |please |ok |and |can you )*(?:put|hang|take|return|bring|lay) (?:it|them) back\b)"
        ),
        "",
    ),
    (r"\b((?:the|my|his|her|our) [\w' ]+?|it|they) (?:can|may|should|could|must) go home(?=$|[,.!])", r"put \1 back"),
    (
        (
            r"\b(?:leave|set|keep|place|put) (it|them|that) (?:on|in|at|by) (?:the|my|\w+'s) [\w ]+?,? "
            r"(?=where (?:it|they|that) (?:was|were|stood|lay|sat)\b)"
        ),
        r"put \1 back ",
    ),
    (r"\b([^\W\d]+)'s (?=(?:finished|done|through) with\b)", r"\1 is "),
    (r"\bthe two of (?:them|these|those)\b", "both"),
    (
        r"\b(?:these|those|the|all(?: the| these| those)?) (?:things|items|objects|stuff) back(?=$|[.,!?])",
        "all back",
    ),
    (
        (
            r"\b(both|these|those|(?:the|my|all(?: the)?) [\w' ]+?) (?:both |all )?(?:can|may|could|should|must"
            r"|might|will"
            r"|has to|have to|needs? to)(?: both| all| now| please)* go back(?: again| now| please)*"
            r"(?=$|[.,!?])"
        ),
        r"put \1 back",
    ),
    (
        (
            r"\b(?:can|may|could|should|must|might|will|has to|have to|needs? to)(?: both| all| now| please)* go back"
            r"(?: again)? (?=(?:in|on|to|into|onto|inside)(?: to)? (?!(?:its|their|where|the \w+ (?:it|they))\b))"
        ),
        "should go back ",
    ),
    (
        (
            r"^((?:.*\b)?(?:need|want|have|borrow|like|get|give me|lend me|bring me|hand me|pass me)\b[^.;]*?),? "
            r"(?:just )?"
            r"for (?:a|an|one|just a|two|three|five|ten|a few|a couple of|half an) (?:little |short |quick "
            r")?(?:while|bit"
            r"|secs?|seconds?|minutes?|moments?|hours?|mo|tick)(?=[.!?]*$)"
        ),
        r"\1",
    ),
    (r"\b(can|could|may|might) (i|we) (?:please )?borrow\b", r"\1 \2 have"),
)
"""Said of what is done once more, or taken back; before any other of these."""

RETURNING: tuple[tuple[str, str], ...] = (
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
