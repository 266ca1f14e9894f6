"""How many and which, said apart from the thing: *the socks all go …*, *two will do, bring them*, *put all of it …*."""

from __future__ import annotations

_DEED = r"(?:bring|take|put|get|fetch|give|carry|move|hand|pick|place|pass|grab|set|lay|deliver|return)"
_SO = r"(?:so |just |please |and |then |can you |could you |you can |now )*"
_FINITE = r"(?:is|are|was|were|will|would|has|have|can|do|does|should|must|may|might)"
_BEINGS = r"(?:go(?! (?:and|to (?:get|fetch|see))\b)|belong|should|must|can|may|have to|need to|are to|live|stay|come)"
_ALL_OF_IT = (
    r"(?:it all|all of it|all of them|them all|everything(?: (?:on|in|from|off) (?:it|there))?|the lot|the contents|"
    r"its contents|all that|(?:what|whatever|all that) is (?:on|in) it|all the (?:things|stuff)(?: (?:on|in) it)?)"
)
_MANY = r"(?:so much |so many |a lot of |lots of |some |too much |too many |all this |all these |the )?"
_ABOUT = (
    r"(?:everywhere|all over(?: the (?:place|house|floor|flat|building|room))?|(?:lying|standing|strewn|scattered|left)"
    r" (?:around|about|everywhere|all over(?: the place)?)|around|in every room|on every surface)"
)

AMOUNTS: tuple[tuple[str, str], ...] = (
    (rf"\bthe (?:two )?([\w' ]+?s) both (?={_BEINGS}\b)", r"both \1 "),
    (rf"\b(?:all )?((?:the|my|our|his|her|their|these|those) [\w' ]+?s) (?:all|each) (?={_BEINGS}\b)", r"all \1 "),
    (
        (
            rf"^(?:just |well |please )*((?:any|one|two|three|four|five|a|an|some|either)\b(?![^,.;]*\b(?:is|are) "
            rf"not\b)"
            rf"[^,.;]*?) (?:will|would|should|is|are|can)(?: really| certainly)? (?:do|be (?:enough|fine|ok|okay|good|"
            rf"sufficient|plenty|all right)|suffice|enough|fine|ok|okay|plenty)(?: for (?:me|now|today))?[,;.!]+ "
            rf"{_SO}({_DEED}) (?:(me|him|her|us) )?(?:it|them|one|that|those)\b"
        ),
        r"\2 \3 \1",
    ),
    (
        (
            r"^(?:please |can you |could you |would you )*(?:clear|empty|unload|strip|tidy|clean)(?: (?:off|out|up))? "
            rf"((?:the|my|our|his|her|\w+'s) [\w' ]+?)(?: (?:off|out|up|bare))?(?:[,.;:]| and|, and)+ (?:then )?{_SO}"
            rf"{_DEED} {_ALL_OF_IT} (?:back |over |away )?(?=(?:to|in|into|on|onto|inside)\b)"
        ),
        r"put everything from \1 ",
    ),
    (
        (
            rf"^(?:we have(?: got)?|there (?:is|are)|i (?:can )?(?:see|keep finding|found)|look at) {_MANY}([\w' ]+?) "
            rf"{_ABOUT}(?: here| again)?[,.;!]+ {_SO}({_DEED}) (?:all of |every bit of )?(?:it|them|that|those)(?: "
            rf"all)?\b"
        ),
        r"\2 all the \1",
    ),
    (
        (
            r"\b((?:take|bring|put|carry|move|fetch|get|return) (?:the|all|both|those|that|these|my) [\w ]+?)"
            r"(?<! over)(?<! from)(?<! in) there (?=(?:back )?(?:to|into|onto)\b)"
        ),
        r"\1 over there ",
    ),
    (
        (
            r"^((?:i|we) (?:could (?:do with|use)|need|want|would (?:like|love|need)|am looking for|am after)\b"
            r"(?:(?! (?:it|them|to)\b)[^,.;!?])*? \w+)[,.;]+ (?:i think |probably |maybe )?(?:it|they|that) "
            r"(?:is|are|was|were|should be|must be|might be|may be|will be|could be|ought to be)"
            r"(?: (?:probably|still|somewhere|lying|standing|surely|usually|kept))* "
            r"(?=(?:in|on|at|inside|next to|by|near|under) [\w' ]+[.!]*$)"
        ),
        r"\1 that is ",
    ),
    (
        (
            r"\b(?:must|should|ought to|might|may|could|will|has to) (?:still|surely|probably|certainly|already|now)"
            r"(?: still)? be (?=(?:in|on|at|near|by|next|under|inside)\b)"
        ),
        "is ",
    ),
    (
        (
            r"^(in|on|at|under|next to) ((?:the|my|\w+'s) [\w' ]+?) there (?:is|are) ((?:an?|some|the|two|three) "
            r"[\w' ]+?)"
            r"(?=[,.;!]+ )"
        ),
        r"there is \3 \1 \2",
    ),
    (
        (
            rf"^(?:the|that|this|those|these) (?:\w+ )?(\w+?)s? (?:is|are) not (?:mine|ours|his|hers|for (?:me|us)|the"
            rf" (?:one|right one|ones)(?: i (?:want|need|meant|asked for|wanted))?|what i (?:want|need|meant|asked "
            rf"for))"
            rf"[,;.!]+ (?:but |instead |rather )?{_SO}({_DEED}\b[^,.;]*?\bthe \w+) ones?\b"
        ),
        r"\2 \1",
    ),
    (
        r"\bthat is not (milk|juice|water|tea|coffee|wine|soap|medicine|fruit|glue|tape|food|bread)\b",
        r"that is not a \1",
    ),
    (
        r"\bnot the (\w+) (?:that|which) is (red|green|blue|yellow|black|white|brown|pink|purple|gray|gold|silver)\b",
        r"not the \2 \1",
    ),
    (
        r"\b(?:inside|indoors|upstairs|downstairs|outdoors) (?=(?:to|into|onto) (?:the|my|me|him|her|\w+))",
        "",
    ),
    (
        (
            rf"^((?!{_FINITE}\b)(?:i|we) (?:would (?:like|love)|want|need)|\w+ (?:wants|needs)|put|bring|take|place"
            rf"|lay)"
            r"(\b[^;.!?]*?),? (?:for )?(?:tonight|this (?:evening|morning|afternoon)|today)(?=[.!]*$)"
        ),
        r"\1\2",
    ),
    (
        (
            r"(?<=\w)[,;.!]+ (?:because )?(?:i|we) (?:really |just |do )?(?:want|like|love|need|prefer|would "
            r"like)(?: to have)?"
            r" (?:a|an|the|my|our|this|things|it|everything)?(?: \w+)? ?(?:nice and )?(?:tidy|clean|neat"
            r"|organi[sz]ed|clear|"
            r"empty|in order|orderly)(?: (?:and \w+))?(?: \w+)?(?=[.!]*$)"
        ),
        "",
    ),
)
"""In the order in which they are tried."""
