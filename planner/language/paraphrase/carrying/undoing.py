"""Said of what is done once more, taken back, or no longer needed: *undo that*, *return it to its shelf*."""

from __future__ import annotations

_IT = r"(it|them|that|this|these|those|both|(?:the|my|his|her) [\w ]+?)"
_ASKED = (
    r"(?:(?:can|could|would|will) you (?:mind )?|i (?:want|need|would like) you to |do you mind |please |now |then "
    r"|and |just |kindly |quickly )*"
)
_AMISS = (
    r"(?:wrong|a mistake|my mistake|an error|not right|no good|silly|not what i (?:meant|wanted|asked for)|too much"
    r"|enough|all|it|(?:not )?the (?:wrong|right|other) (?:one|\w+)|not (?:it|the one(?: i \w+)?))"
)

TAKING_BACK: tuple[tuple[str, str], ...] = (
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
    (r"\b([^\W\d]+)'s (?=(?:finished|done|through)\b)", r"\1 is "),
    (r"\bboth of (?:these|those|them) (?=(?:can|may|should|must|could|need|go|belong)\b)", "both "),
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
            r"^((?:.*\b)?(?:need|want|have|borrow|like|get|carry|hold|keep|give me|lend me|bring me|hand me|pass "
            r"me)\b[^.;]*?),? "
            r"(?:just )?"
            r"for (?:a|an|one|just a|two|three|five|ten|a few|a couple of|half an) (?:little |short |quick "
            r")?(?:while|bit"
            r"|secs?|seconds?|minutes?|moments?|hours?|mo|tick)(?=[.!?]*$)"
        ),
        r"\1",
    ),
    (r"\b(can|could|may|might) (i|we) (?:please )?borrow\b", r"\1 \2 have"),
    (
        (
            r"^(?:oh |ah |no |sorry |oops |wait )*i (?:did not|do not) (?:mean|want|ask for) (?:that|it|this|you to "
            r"[^,.;]+|to [^,.;]+)"
            r"[,.;!]+ (?=(?:so |and |please |can you |could you )*(?:undo|put|take|return|bring|back)\b)"
        ),
        "",
    ),
    (r"^(?:no[,.! ]+)+(?=back (?:to|in|on|into|onto) [\w' ]+ with (?:it|them|that)[.!]*$)", ""),
    (r"\b(he|she|it) is (?=had\b)", r"\1 has "),
    (
        (
            r"^(?:i|we|they|he|she|\w+) (?:has|have) had (?:enough|plenty|some|his fill|her fill|my fill)(?: of "
            r"(?:it|that|them))?"
            r"(?: now| already)?[,.;!]+ (?:so |and )*(?=\w)"
        ),
        "",
    ),
    (rf"\b(put|take|bring|carry|move|set) {_IT} back there(?=$|[.,!?])", r"\1 \2 back"),
    (
        (
            r"^(?:it|they|that|(?:the|my) [\w ]+?) (?:was|were|looked|looks|is) (?:just |much |quite )?(?:fine"
            r"|better|good|nicer|ok"
            r"|okay|all right|alright|perfect) (?:where (?:it|they|that) (?:was|were)|before|there|as (?:it|they) "
            r"(?:was|were))"
            r"[,.;!]+ (?:so |and |please )*(?=(?:put|take|return|bring|move|leave) (?:it|them|that)\b)"
        ),
        "",
    ),
    (r"^here(?: you (?:go|are)| it is| we are)?[,.!]+ (?=(?:now |please )*(?:put|take|return|bring|carry|move)\b)", ""),
    (
        (
            r"^(?:(?:i|we|they|he|she|\w+) (?:am|is|are|has|have) )?(?:now |all |just |already )*(?:done|finished"
            r"|through)"
            r"(?: with)? \w+ing(?: [\w' ]+?)?[,.;!]+ (?:so |and |now )*(?=\w)"
        ),
        "",
    ),
    (
        (
            r"(?:,|;)? (?:but|and|though) i (?:will |want to |would like to |am going to )?(?:keep|hold on to|hang "
            r"on to|still need) "
            r"(?:the|my|that) [\w ]+(?=[.!]*$)"
        ),
        "",
    ),
    (rf"^let us have {_IT} back (?=(?:in|on|at|to) (?:its|their)\b|where\b)", r"put \1 back "),
    (
        (
            rf"\b{_IT} (?:can|may|should|must|needs? to|has to|have to) (?:now )?be (?:returned|put back|taken back"
            rf"|brought back"
            r"|moved back|given back|carried back)(?: now| again| please)*(?=$|[.,!?])"
        ),
        r"put \1 back",
    ),
    (
        (
            rf"\b{_IT} (?:can|may|should|must|needs? to|has to|have to) (?:now )?be (?:returned|put back|taken back"
            rf"|brought back"
            r"|moved back|carried back) (?=(?:to|in|on|into|onto)\b)"
        ),
        r"return \1 ",
    ),
    (
        (
            r"\b(?:return|put back|take back|bring back) (?:what|whatever|everything|all|the things?) (?:that )?you "
            r"(?:have )?(?:just "
            r")?(?:brought|took|moved|fetched|got|carried|delivered)(?: me| us| him| her)?(?=$|[.,!?])"
        ),
        "put it back",
    ),
    (
        (
            r"^(?:oh|ah|oops|sorry|damn|wait|no|dear|hm+)?[,.! ]*(?:that is |it is |this is )?(?:the )?wrong "
            r"(?:thing|one|\w+)[,.;!]+ "
            r"(?:so |and |please |can you |could you )*(?=(?:put|take|return|bring|carry) (?:it|them|that)\b)"
        ),
        "",
    ),
)
"""In the order in which they are tried; before those of ``returning``."""
