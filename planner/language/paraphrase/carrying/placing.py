"""Where something is to be, said as a fact or a wish: *it lives on the shelf*, *I'd like it moved to the hall*."""

from __future__ import annotations

_WHAT = (
    r"((?:the|my|our|his|her|every|an?) [\w' ]+?|(?:that|those|these|this|all|both|it|they|them|\w+'s)(?: [\w' ]+?)??)"
)
_PREP = r"(?=(?:to|in|on|into|onto|at|next to|by|near|inside|back|from)\b)"
_DONE = (
    r"(?:moved|brought|put|taken|placed|carried|delivered|returned|transferred|transported|set|stored|laid|shifted|"
    r"relocated|dropped off|left|stowed|kept)"
)
_BELONGS = (
    r"(?:goes|belongs|should (?:go|be|live|stand)|go|belong|lives?|is kept|are kept|needs "
    r"to (?:go|be)|has to (?:go|be)|"
    r"must (?:go|be)|ought to (?:go|be)|is supposed to (?:go|be)|is meant to (?:go|be)|can go|is to go)"
)
_MISPLACED = (
    r"(?:has no business|have no business|does not belong|do not belong|should not (?:be|lie|stand|stay|live|sit)|"
    r"is not supposed to (?:be|lie|stand)|is out of place|is in the wrong place|is wrong|is not right|has no place|"
    r"can not (?:stay|remain|lie|stand|be)|must not (?:be|lie|stand|stay))"
)
_STAND = r"(?<!\btv )(?<!\bplant )(?<!\bnight )(?<!\bcoat )(?<!\bhat )(?<!\bumbrella )stand"
"""What things do; a TV stand is furniture."""

PLACING: tuple[tuple[str, str], ...] = (
    (
        (
            r"(?<=\w)(?: back)? (?:among|amongst|with|beside|to|next to) (?:all )?(?:the|its) (?:others?"
            r"|rest|other ones?"
            r"|other \w+s) (?=(?:on|in|at|inside) )"
        ),
        " ",
    ),
    (
        (
            r"^(?!.*\b(?:only|remains?|stays?|left|two|three|one|ones|empty|none|nothing|full|each|same|other)\b)"
            r"((?:please |can you |could you |you can |just )*(?:leave|put|place|set|lay|bring|take|carry|move|get|drop"
            r"|fetch|hang|hand)\b[^,;.]*?),? so (?:that )?(?:i|we|he|she|they|nobody|no one|everyone"
            r"|everybody|people|it"
            r"|you|(?:the )?[a-z]+) (?:can |will |do not |does not |may |could |have |has |am |is |are )?[a-z]+\b"
            r"[^,.;]*(?=[.!?]*$)"
        ),
        r"\1",
    ),
    (
        (
            r"^((?:please |can you |could you )*(?:move|take|bring|put|carry|get|go)\b[^.;]*?)[,;.]"
            r" (?:because |since )?"
            r"(?!i\b|we\b|you\b|it\b)(?:\w+|the \w+) (?:wants?|needs?|has|have|likes?|loves?|would like|is going"
            r"|are going|plans?) to (?!have\b|get\b)\w+(?: [\w' ]+?)? (?:there|with (?:it|them))(?=[.!]*$)"
        ),
        r"\1",
    ),
    (
        (
            r"^((?:please |can you |could you )*(?:pick|hold|take|grab|lift|get)\b[^.;]*?)[,;]?(?: but|"
            r" and)? (?:please )?"
            r"(?:do not (?:go|drive|move|run|come)|without (?:going|driving|moving|running))(?: off| away| anywhere)+"
            r"(?: with (?:it|them|that))?(?: just yet| yet| now| for now)*(?=[.!]*$)"
        ),
        r"\1",
    ),
    (
        (
            r"\b(?:pile|stack|heap) (it|them|those|these|both) (?:up |neatly )*(?=(?:on|onto|in|into|upon) (?:the|my"
            r"|our|\w+'s) )"
        ),
        r"put \1 ",
    ),
    (
        (
            r"^there (?:is|are) (?:an?|some|the) ([^,.;!?]+?) (?:which|that) (?:(?:should|must|needs? to|has to|"
            rf"have to|ought to) (?:go|be|come)|belongs?|goes?) {_PREP}"
        ),
        r"put the \1 ",
    ),
    (
        (
            rf"\b(?:i|we) (?:would (?:like|love|prefer)|want|need|wish)(?: to (?:have|see|"
            rf"get))? {_WHAT} (?:to be )?{_DONE}"
            rf"(?: over| back| away)? {_PREP}"
        ),
        r"move \1 ",
    ),
    (
        (
            rf"(?:^|(?<=[.;!] )){_WHAT} {_MISPLACED}(?: [^,.;!]*)?[,.;!]+ (?:and |but |so |please )*(?:it|they|that) "
            rf"{_BELONGS}(?: back)? {_PREP}"
        ),
        r"put \1 ",
    ),
    (
        (
            rf"(?:^|(?<=[.;!] )){_WHAT} (?:(?:can|may|should|could|must) (?:live|belong|go|stay|stand|be)|lives?|"
            rf"belongs?|goe?s?|is kept|are kept|is at home|stay|{_STAND}|be|"
            rf"has its place|is supposed to be|"
            rf"should be) ((?:in|on|at|inside|next to|with) [^,.;!]+?)(?: from now on| from today)?(?:,|;|\.)? (?:and "
            rf"|so |then |please |could you |can "
            rf"you )*(?:put|take|bring|return|carry|move|place) (?:it|them) (?:back )?(?:there|in there|on there|back)"
            rf"(?=[.!?]*$)"
        ),
        r"put \1 \2",
    ),
    (
        (
            rf"(?:^|(?<=[.;!] ))(?:i (?:have |always |have always )*(?:thought|think|find|feel)(?: that)? )?{_WHAT} "
            rf"(?:looks?|would look|fits?|would fit|is|would be|does|stands) (?:much |far "
            rf"|so much )?(?:better|nicer|best) "
            rf"((?:in|on|at|next to|by|near) [^,.;!]+?)[,.;]+ (?:so |please |could you |"
            rf"can you |would you |and )*(?:put|"
            rf"take|bring|carry|move|place) (?:it|them) there(?=[.!?]*$)"
        ),
        r"put \1 \2",
    ),
    (
        (
            rf"(?:^|(?<=[.;!,] )){_WHAT} (?:has|have|needs?|should|must|ought)(?: to)? (?:get|"
            rf"come|go|travel|move|be moved|be "
            rf"taken|be brought|be carried) (?=from [^,.;]+? (?:to|into|onto|over to)\b)"
        ),
        r"take \1 ",
    ),
    (
        (
            r"\b(should|must|have to|has to|needs? to|ought to|can) (?:both|all|each|all three|"
            r"now|please|then|also) (?=\w)"
        ),
        r"\1 ",
    ),
    (
        (
            r"\b(?:should|must|have to|has to|needs? to|ought to) (?:end up|find (?:its|"
            r"their) way|come|get|wind up|land|make "
            r"(?:its|their) way|arrive)(?: inside| in| out| back| over)?,? (?=(?:to|in|on|into|onto|at|next)\b)"
        ),
        "should go ",
    ),
    (
        r"\b(?<!you )(?:is|are) (?:required|needed|wanted|expected|due|missing|missed) (?=(?:in|on|at) (?:the|my|\w+))",
        "should be ",
    ),
    (r"\b((?:the|my|that) [\w ]+?) (?:is|are) (?:required|needed|wanted|expected) by (?=\w)", r"\1 should go to "),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen ))(?:pack|stuff|squeeze|cram|load)"
            r" ([^,.;!]+?)(?: up| away)? "
            r"(?=(?:in|into|inside) (?:the|a|my|that)\b)"
        ),
        r"put \1 ",
    ),
    (r"\b(bring|carry|take) (it|them) in(?:side)?(?: to| for) (me|us|him|her)\b", r"\1 \2 to \3"),
    (
        (
            r"\b(bring|carry|take|get|put|move) (?!from\b)([\w' ]+?) (?:over )?here (?=(?:to|"
            r"in|into|at|on) (?:the|my|me|us)\b)"
        ),
        r"\1 \2 ",
    ),
)
"""In the order in which they are tried."""
