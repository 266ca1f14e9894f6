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

_COLOR = r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|gold|silver)"

AMOUNTS: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:i|we) do not (?:want|need|like) ((?:the|my|that|this|those|these|his|her) [\w' ]+?)(?: (?:here"
            r"|there|any ?more|now|in"
            rf" here|any longer|lying around|around))*[,.;]+ {_SO}({_DEED}|throw) (?:it|them) (?=\w)"
        ),
        r"\2 \1 ",
    ),
    (
        (rf"^no ([\w' ]+?) (on|in) ((?:the|my) [\w' ]+?)[,.;!]+ {_SO}({_DEED}) (?:it|them) (?=\w)"),
        r"\4 the \1 \2 \3 ",
    ),
    (
        (
            rf"^((?:the|my|our|all the|those|these) [\w' ]+?) (?:do not|does not|should not|must not|can not) "
            rf"(?:belong|be|lie|stay|"
            rf"stand|live|go) (?:on|in|at) ((?:the|my) [\w' ]+?)[,.;!]+ {_SO}({_DEED}) (?:it|them) (?=\w)"
        ),
        r"\3 \1 from \2 ",
    ),
    (r"\b(?:all )?(?:the )?(?:stuff|things) (?=(?:from|off) (?:the|my)\b)", "everything "),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bplease )|(?<=\byou ))(?:sweep|brush|shovel|scoop|tip|dump"
            r"|shift) "
            r"(everything|it all|all (?:the )?[\w' ]+?) (?=(?:on|from|off|in) )"
        ),
        r"put \1 ",
    ),
    (
        (
            rf"^(?:someone|somebody|they|people|the (?:kids|children|guests|boys|girls)|\w+) (?:has |have )?(?:left"
            rf"|put|dropped|spread|"
            rf"scattered|strewn) {_MANY}([\w' ]+?) {_ABOUT}(?: again)?[,.;!]+ {_SO}({_DEED}) (?:all of )?(?:it|them"
            rf"|those)(?: all)?\b"
        ),
        r"\2 all the \1",
    ),
    (
        (
            rf"^((?:the|my|our) [\w' ]+?) (?:needs? to be|has to be|must be|should be|is to be) (?:cleared|tidied"
            rf"|cleaned"
            rf"|emptied|tidy|clean|sorted)(?: up| out)?[,.;:!]+ {_SO}"
            r"(?=(?:take|put|bring|carry|move) (?:the|all|both|every|my)\b)"
        ),
        r"tidy \1: ",
    ),
    (
        (
            r"^(?:let us |time to |it is time to |please |can you |could you )*(?:clean|tidy|clear|sort)(?: things)? "
            r"up[:,.!]+ (?=\w)"
        ),
        "",
    ),
    (
        (
            r" (?:in|from|throughout|around) the (?:whole |entire )?(?:building|house|flat|apartment|hospital|school)"
            r"(?= (?:to|in|into|on|onto|go|goes|belong|belongs|should)\b)"
        ),
        "",
    ),
    (
        (
            r"\b(?:take|get|pull|dig|fish) out ((?:the|my|his|her|all the|both) [\w' ]+?)(?:,| and)+ (?:then )?"
            r"(?=(?:put|bring|take|give|throw|carry|place) (?:it|them)\b)"
        ),
        r"take \1 and ",
    ),
    (r"^(?:please )?do (?=(?:put|bring|take|go|come|get|fetch|give|carry|move|return|find)\b)", ""),
    (
        (
            r"\b(?:the|my|our|these|those) ([\w' ]+?s),? all (two|three|four|five|six|seven|eight) of (?:them|these"
            r"|those)\b"
        ),
        r"all \2 \1",
    ),
    (
        rf"^not the {_COLOR} (\w+)[,:;]+ (?:but |just |i mean |rather )*the ({_COLOR}) one(?= please|[.!]*$)",
        r"the \2 \1",
    ),
    (rf",? no,? (?=not (?:the|an?) {_COLOR}(?: ones?)?[.!]*$)", ", "),
    (r",? (?:only|just|though|and) no (\w+)(?=[.!]*$)", r" but no \1"),
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
            r"^(?:please |can you |could you |would you )*(?:clear|empty|unload|strip|tidy|clean|free)(?: (?:off|out"
            r"|up))? "
            rf"((?:the|my|our|his|her|\w+'s) [\w' ]+?)(?: (?:off|out|up|bare))?(?:[,.;:]| and|, and)+ (?:then )?{_SO}"
            rf"{_DEED} {_ALL_OF_IT} (?:back |over |away )?(?=(?:to|in|into|on|onto|inside)\b)"
        ),
        r"put everything from \1 ",
    ),
    (
        (
            rf"^((?:the|my|our|his|her|\w+'s) [\w' ]+?) (?:needs? to be|should be|must be|has to be|is to be|needs"
            rf"|wants) "
            rf"(?:empty|emptied|cleared|clear|tidy|tidied|clean|cleaned|free|emptying|clearing)(?: up| out| "
            rf"off)?[,.;:!]+ "
            rf"{_SO}{_DEED} {_ALL_OF_IT} (?:back |over |away )?(?=(?:to|in|into|on|onto|inside)\b)"
        ),
        r"put everything from \1 ",
    ),
    (
        (
            r"(?: (?:that|which) (?:is|are))? (?:lying|standing|strewn|scattered|left) (?:around|about|everywhere)"
            r"(?= (?:go|goes|belong|belongs|should|must|need|needs|to|in|into|can|have)\b)"
        ),
        "",
    ),
    (r"^(?:please )?make (?:some |more |a bit of )?(?:room|space) (?:on|in|at) ([^:,.;]+)[:,.;]+ (?=\w)", r"tidy \1: "),
    (
        (
            r"^(?:please |can you |could you )*(?:(?:put|pack|stow)(?: (?:away|up))?|(?:tidy|clear) (?:away|up)) "
            r"((?:the|all|all the|my"
            r"|these|those)"
            r" (?:(?! of )[\w' ])+?)(?: (?:away|up))?[,.;:]+ (?:they|it|these|those) (?:all |both )?(?:go(?:es)?"
            r"|belongs?|live"
            r"|should (?:go|be)|"
            r"can go|must go) "
        ),
        r"put \1 ",
    ),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bplease )|(?<=\byou ))(?:sort|file|stack|pile|heap|shelve|line"
            r"|arrange)"
            r"(?: up)? ((?:the|all|my|all the|these|those) [\w' ]+?)(?: up)? (?=(?:on|onto|in|into|inside) (?:the|my"
            r"|a|\w+'s)\b)"
        ),
        r"put \1 ",
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
            r"^(?:over |out |up |down )?(in|on|at|under|next to) ((?:the|my|\w+'s) [\w' ]+?),? you (?:will|can"
            r"|should|might|may)"
            r" (?:find|see) ((?:an?|some|the|my|his|her|two|three) [\w' ]+?)(?=[,.;!]+ )"
        ),
        r"\3 is \1 \2",
    ),
    (
        (
            r"^(?:from|out of|off) ((?:the|my|\w+'s) [\w' ]+?),? (i (?:need|want|would like)|(?:bring|get|fetch|give"
            r"|hand) "
            r"(?:me|us|\w+)) ((?:the|an?|some|my|two|three|all the|both) [\w' ]+?)(?=[.!]*$)"
        ),
        r"\2 \3 from \1",
    ),
    (
        r"\bthere (?:should|must|might|may|could|ought to|will)(?: still| probably| surely)? be (?=an?|some|the|two)",
        "there is ",
    ),
    (r"\b(is|are) (?!(?:it|that|there|what|who|let|here)'s)(\w+)'s(?=[,.;]+ )", r"\1 for \2"),
    (r"\b(?:either|any one) of (?=(?:the|my|our|these|those)\b)", "one of "),
    (
        (
            r"^(?:somewhere )?(in|on|at|under|next to) ((?:the|my|\w+'s) [\w' ]+?),? there (?:is|are) ((?:an?|some"
            r"|the|two|three) "
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
    (r"\bon (?:the|your) way (?:back|there|home|over)\b,? ?", ""),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou ))(?:stash|keep|park|rest|prop"
            r"|lean|perch"
            r"|shelve|stand|balance|tuck away|stow away|hide) ((?:it|them|(?:the|my|our|his|her|all|both|\w+'s) "
            r"[\w' ]+?)) "
            r"(?=(?:in|on|onto|into|inside|next to|beside|against) (?:the|my|our|a|his|her|\w+'s)\b)"
        ),
        r"put \1 ",
    ),
    (
        r"^((?:the|my|that|this) (?:\w+ )?\w+) (?:is|are) (?:meant |intended )?for (\w+)(?=[.!]*$)",
        r"\1 should go to \2",
    ),
    (
        (
            r"^((?:the |my )?(?!(?:this|that|here|there|it)\b)[\w' ]+?) is where ((?:the|my|our|all the|his|her) "
            r"[\w' ]+?)"
            r" (?:should (?:go|be|live)|belongs?|goes?|go|has to go|must go|needs? to (?:go|be)|ought to (?:go|be)"
            r"|lives?)"
            r"(?: now)?(?=[.!]*$)"
        ),
        r"take \2 to \1",
    ),
    (
        (
            r"^(?:the )?(?:right |proper |best |correct )?(?:place|spot|home) (?:for|of) ((?:the|my|our|his|her) "
            r"[\w' ]+?) is "
            r"(?!where\b)(?=(?:in|on|at|next to) )"
        ),
        r"put \1 ",
    ),
    (
        (
            r"^(?:the )?(?:right |proper |best |correct )?(?:place|spot|home) (?:for|of) ((?:the|my|our|his|her) "
            r"[\w' ]+?) is "
            r"(?=(?:the|my|\w+'s) )"
        ),
        r"take \1 to ",
    ),
    (
        (
            r"\b((?:put|leave|place|set|lay) (?:(?! for )[^,.;])+? (?:on|in|at|onto|into) (?:the|my|\w+'s) [\w' ]+?) "
            r"for "
            r"(?:him|her|(?!the\b|now\b|my\b|an?\b|me\b|us\b)\w+)(?: to (?:find|see|read|use|have|take))?(?=[.!]*$)"
        ),
        r"\1",
    ),
)
"""In the order in which they are tried."""
