"""Ways of saying which one: *but not the red one*, *the one nearest to you*."""

from __future__ import annotations

_COLOR = r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|gold|silver)"

CHOOSING: tuple[tuple[str, str], ...] = (
    (
        rf",? but not the ({_COLOR})(?: ones?)?,? (?=(?:to|for|in|on|into|onto|goes?|should)\b)",
        r" that is not \1 ",
    ),
    (
        (
            rf"^no {_COLOR} (\w+?)s?,? (?:please,? )?(?:just |but |only )*((?:bring|give|take|get|fetch"
            rf"|put)\b.*?\bthe \w+) ones?\b"
        ),
        r"\2 \1",
    ),
    (
        (
            rf"^(?:leave|skip|ignore|spare|do not (?:touch|take|move)) the ({_COLOR}) (\w+?)s?(?: alone| out| be| "
            rf"there)?[,.;]"
            r"(?: and| but)* (take|bring|put|carry|move) (?:all )?the others?(?: ones| \2s?)? (?=(?:to|in|on|into"
            r"|onto)\b)"
        ),
        r"\3 all the \2s except the \1 one ",
    ),
    (
        (
            r"^(?:leave|skip|ignore|spare) (the [\w ]+?)(?: alone| out| be)?,(?: and| but)* (?=(?:take|bring|put"
            r"|carry|move)"
            r" (?:the|all|my|both|every))"
        ),
        r"do not move \1, but ",
    ),
    (
        (
            r"\bthe (red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|gold|silver|small|big|large"
            r"|tall|\w+est"
            r"|\w+er|left|right)(?: ones?)? (?:out )?of (?:them|those|these|that|the (?:two|three|four|five|lot|bunch))"
            r"(?=$|[.,!?]| (?:to|in|on|into|onto|for|and)\b)"
        ),
        r"the \1 one",
    ),
    (
        (
            r"\bwhichever (\w+)(?: of \w+)? (is|are|happens to be) (?=(?:in|on|at|next|near|under|by|from|standing"
            r"|lying)\b)"
        ),
        r"the \1 that is ",
    ),
    (
        (
            r"^the colou?r of (the [\w ]+?) (?:that )?(?:i|we) (?:want|need|mean|meant|am after|am thinking of) is "
            r"(\w+)(?=[,.;])"
        ),
        r"\1 that is \2",
    ),
    (
        (
            r"^(the [\w ]+?) (?:that )?(?:i|we) (?:want|need|mean|meant|am after|am thinking of|had in mind|have "
            r"in mind)"
            r" (?:is|are) (?=(?:the|in|on|at|next|near|by|red|green|blue|yellow|black|white|brown|pink|purple|gray|grey"
            r"|gold|silver|orange)\b)"
        ),
        r"\1 that is ",
    ),
    (
        r"\ball (?:but|except|save|minus) (one|two|three|four|five|\d+) (?:of )?(?:the |my |our )?(?=\w+s\b)",
        r"allbut \1 of the ",
    ),
    (
        (
            r"\b(?:all )?(?:the|my|our) (\w+s),? (?:all )?(?:but|except|minus) (one|two|three|four|five)"
            r"(?=,| (?:to|in|on|into|onto|for)\b|[.!]*$)"
        ),
        r"allbut \2 of the \1",
    ),
    (r",? but not (?:one )?(?:from|out of|in) (the [\w ]+?)(?=[.!]*$)", r" that is not in \1"),
    (
        (
            r"\b(except|but not|other than|apart from|besides|excluding) (?:those|the ones|that|any"
            r"|anything) (?=(?:on|in|at|from|next|near|by|under)\b)"
        ),
        r"\1 the ones ",
    ),
    (
        (
            r"\b((?:all )?(?:the|my|our) \w+s), (?:other than|except(?: for)?|apart from|excluding|bar|save for|without"
            r"|minus|but not|all but) (the \w+(?: ones?)?), (?=(?:in|on|to|into|onto|go|goes|should)\b)"
        ),
        r"\1 except \2 ",
    ),
    (
        (
            r", (?:both|all|each|every one|each and every one|every single one|the (?:whole )?lot)"
            r"(?: of (?:them|these|those))?,? (?=(?:for|to|in|on|into|onto) )"
        ),
        " ",
    ),
    (
        (
            r"(?<!er, )\bthe (red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|gold|silver) "
            r"(\w+) or (?:the |an? )?(red|green|blue|yellow|black|white|brown|pink|purple|gray|grey"
            r"|gold|silver) ones?\b"
        ),
        r"a \1 or \3 \2",
    ),
    (
        (
            r"[.;,!] (?:but |and )?(?:it|they|that)(?: really| definitely)? "
            r"(?:must not|mustn't|mustnt|should not|shouldn't|shouldnt|can not|cannot|can't|may not) be "
            r"(?:an? |the )?(red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|gold|silver|orange)"
            r"(?: ones?)?(?=[.!]*$)"
        ),
        r" but not the \1 one",
    ),
    (r"\b(that|those) (\w+(?: \w+)?) there(?=,)", r"\1 \2"),
    (
        (
            r"^(?!(?:take|bring|give|carry|get|fetch|put|move|hand|deliver|send|pass|want|need|and|then|no|not|just"
            r"|also)\b)"
            r"(\w+),? (?:the )?(red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|gold"
            r"|silver) one,? (?:2 |to |for )(?=\w)"
        ),
        r"the \2 \1 to ",
    ),
    (
        (
            r",?(?: but| and)? not (?:the )?(\w+)(?: ones?)?(?:,| and|, and|,? or)? (?:and )?not "
            r"(?:the )?(\w+)(?: ones?)?(?: either)?(?=[.!]*$)"
        ),
        r", neither \1 nor \2",
    ),
    (
        (
            r",? (?:bar|save(?: for)?|barring|minus|all bar|leaving out|leaving aside|omitting|ignoring"
            r"|skipping|but for|not counting|"
            r"with the exclusion of|to the exclusion of) (?=(?:the|any|my|his|her|that|those|anything)\b)"
        ),
        " except ",
    ),
    (
        (
            r",? (?:and |but |though |just |only |please )*(?:leave|keep|spare|skip|ignore|omit"
            r"|not touch|do not touch|do not take|do not move|"
            r"leave out|leave behind|let) (the [\w ]+?)(?: alone| behind| out| be| there| here| stay| "
            r"(?:where|as) (?:it|they) (?:is|are)|"
            r" in (?:its|their) place| untouched| in place)(?=[.!]*$)"
        ),
        r" except \1",
    ),
    (
        (
            r"^(?=[^.;]*\b(?:all|every|each|everything|both|any|things|(?:the|my|these|those) (?:\w+ ){0,2}\w+s)\b"
            r"[^.;]*\bleave\b)([^.;]+?),? (?:and |but |though |just |only |please |you can )*leave "
            r"((?:the|my|his|her|that|those|any) (?:(?!on\b|in\b|at\b|to\b|with\b|for\b|by\b|next\b|near\b)\w+ ?)+?)"
            r"(?=[.!]*$)"
        ),
        r"\1 except \2",
    ),
    (
        (
            r"(?:,? (?:something|anything|whichever|whatever)|, (?:any|one|an other))(?: one| color"
            r"| kind| sort)?(?: you like)?(?:,)? "
            r"(?:other than|but|except(?: for)?|apart from|besides|bar|that is not) (?:the |an? )?(\w+)"
            r"(?: ones?)?(?=$|[.!?,])"
        ),
        r" that is not \1",
    ),
    (
        (
            r"^(?:anything|any|whatever|all)(?: of them| one)? (?:but|except(?: for)?|other than"
            r"|apart from) the (\w+) (\w+)[,:;] (.+? an?) \2(?=[.!]*$)"
        ),
        r"\3 \2 that is not \1",
    ),
    (
        (
            r"^not the (\w+) (\w+),? (?:but )?(?:(?:please )?(?:take|bring|get|give|use) )?(?:me )?the "
            r"(\w+) ones?,? (?:please )?(bring|fetch|get|take|give)(?: me)?(?: it| that)?(?=[.!]*$)"
        ),
        r"\4 me the \3 \2",
    ),
    (r"\b(the [\w ]+?), (?:and )?not the [\w ]+?, (?=(?:in|on|to|into|onto|at|next|for|goes|should)\b)", r"\1 "),
    (
        (
            r"\b(the [\w ]+?), (?:the one (?:that|which) is )?not (?:the )?(\w+)(?: ones?)?, (?=(?:in"
            r"|on|to|into|onto|at|next|for|goes|should|bring|take|put)\b)"
        ),
        r"\1 that is not \2, ",
    ),
    (
        (
            r"\b(the [\w ]+?),? (?:other than|except(?: for)?|apart from|excluding|but not|bar|without"
            r"|save for|all but) the (\w+)(?: ones?)? (?:and|or|nor) (?:the )?(\w+)(?: ones?)?,? (?="
            r"(?:in|on|to|into|onto)\b)"
        ),
        r"\1 that is neither \2 nor \3 ",
    ),
    (
        (
            r"(?:,|,? (?:and |but )?(?:i|we)) (?:really )?(?:do not|does not) (?:care|mind|matter"
            r"|bother|fuss)(?: about| at all)?(?: which| what)?(?: one| color| of them)?(?=$|[.!?,])"
        ),
        "",
    ),
    (
        (
            r",? (?:it |that )?(?:does not|makes no|no) (?:really )?(?:matter|difference)(?: which"
            r"| what)?(?: one| color| of them)?(?: to me)?(?=$|[.!?,])"
        ),
        "",
    ),
    (
        (
            r"(?:,| and| but) (?:i|we) (?:do not|really do not) (?:know|remember|recall|care"
            r"|mind) which(?: one| of them)?(?=$|[.!?,])"
        ),
        "",
    ),
    (
        (
            r"(?:,|(?= (?:whichever|whatever|you))) (?:whichever|whatever|either|any|you choose"
            r"|your choice|you pick|you decide|dealer's choice|take your pick)(?: one| of them"
            r"| you like| you want| is (?:fine|closer|closest|handy|easiest)| will do| works)?(?=[.!]*$)"
        ),
        "",
    ),
    (r"\bany (two|three|four|five|six) of the (?:two |three |four |five |six )?(?=\w)", r"\1 of the "),
    (
        (
            r"\bwhichever (\w+) (?:is|are|happens to be) (red|green|blue|yellow|black|white|brown|pink"
            r"|purple|gray|grey|orange|gold|silver)\b"
        ),
        r"the \1 that is \2",
    ),
    (
        (
            r"^(?:(?:out )?of|from(?: among)?|among|between) (?:the|all the|both|those|these|my) "
            r"(?:two |three |four |five )?((?:\w+ )*?\w+?)s((?: (?:in|on|at|from) [\w' ]+?)?),? "
            r"(?:please )?"
            r"((?:i (?:want|need|would like|prefer|would prefer)|(?:could|can) i have|bring|take|get"
            r"|give|fetch|hand|pick|put|grab|carry|move|choose)\b[^,.;]*?) the ([\w ]+?) one\b"
        ),
        r"\3 the \4 \1\2",
    ),
    (r"\b(?:which|what) (\w+)\?+ (?:the one|that one) ", r"the \1 "),
    (r"\b(?:all )?(?:by itself|on its own|all alone|alone)(?: there)? (?=(?:in|on|at)\b)", ""),
    (
        (
            r"\b((?:an?|any|one|some) [\w ]+?), (?:(?:any|either|whichever)(?: one)?(?: of (?:them|those|the two))?"
            r"(?: (?:will|would) do| (?:is|are) (?:fine|ok|okay|good|all right|alright))?"
            r"|(?:i do not (?:care|mind)|(?:it )?does not matter) which(?: one)?)(?=$|[.!?,]),?"
        ),
        r"\1",
    ),
    (r"\b(one|two|three|any|some|either|each) of the (?:two|three|four|five|six|\d+) (?=\w)", r"\1 of the "),
    (r"\b(?:further|farther)(?: away)? from\b", "farthest from"),
    (r"\b(the \w+est [\w ]+?) (?:that )?there is\b", r"\1"),
    (r"\bneither (\w+) nor (\w+),? nor (\w+)\b", r"neither \1 nor \2 and is not \3"),
    (
        (
            r"^(?:out )?of (?:the|all the|both|those|these) (?:two |three |four |five )?(\w+?)s,? ([^,]+?) the one "
            r"(?=(?:that|which|in|on|at|next|by|near|nearest|closest)\b)"
        ),
        r"\2 the \1 ",
    ),
    (
        r"\b(every|all(?: the)?|each) ([\w ]+?) (?:that )?you (?:can )?(?:find|see) and (?=(?:put|bring|take)\b)",
        r"\1 \2 and ",
    ),
    (r"\b(with (?:the|an?|my|some) [\w ]+?) (?:in|on|inside) it\b", r"\1"),
    (
        (
            r"\b(every|all(?: the| of the| my| our)?|any|each|the|both) ([\w ]+?) (?:that |which )?(?:we|i"
            "|you) (?:own|possess|have got|have|can find|can see|know of)(?=$|[,.!]| (?:go|goes|should|to|in"
            r"|on|into|onto|belong|belongs)\b)"
        ),
        r"\1 \2",
    ),
    (r"^not the (\w+) (\w+),? (?:but )?(?:the )?(?:other)(?: ones?)?,? ", r"the \2 that is not \1 "),
    (
        (
            "(?:,|,? (?:only|but|just|and))(?: (?:only|but|just|and|so|please))* (?:do not|not) (?:take|bring"
            r"|use|fetch|get|grab|give)(?: me| him| her)? (the \w+ ones?)(?=[.!]*$)"
        ),
        r" except \1",
    ),
    ("^without (?:touching|taking|using|moving|bringing|disturbing) (.+?), (.+?)(?=[.!]*$)", r"\2 except \1"),
    (r",? without (?:touching|taking|using|moving|bringing|disturbing) (?=(?:the|any|my)\b)", " except "),
    (r"\b(?:somewhere|anywhere) (?=(?:in|on|at)\b)", ""),
    (
        r",? (?:anything|any color|whatever|everything|all) but (?:the |a )?(\w+)(?: ones?)?(?=$|[.!?,])",
        r" that is not \1",
    ),
    (
        (
            r",?(?<!\bis)(?<!\bare)(?: and| but| just| only)* not (?:a |the |an |any )(\w+)(?: ones?"
            "| colou?red one)(?=$|[.!?])"
        ),
        r" that is not \1",
    ),
    (r"\breddish\b", "red"),
    (r"\b(green|brown|yellow|pink|gray|grey|black|orange)ish\b", r"\1"),
    (r"\bblu(?:e)?ish\b", "blue"),
    (r"\b(nearest|closest|farthest|furthest)( one)?(?: to (?:you|here|us)| from (?:here|you|us))", r"\1"),
    (r"\b(?!is\b|are\b|the\b)(\w+)(?: that is| which is)? (nearest|closest|farthest|furthest)(?=$|[.!?,])", r"\2 \1"),
    (
        (
            "(?:, it is|, which is|, that is|, i mean) the (biggest|largest|smallest|nearest|closest"
            "|tallest) (?:one|of them)?"
        ),
        r", the \1 one",
    ),
    (
        (
            r"\b(?:somewhere|anywhere|around here|in this (?:house|home|building|school|office|hospital|flat"
            "|apartment|place)|in the (?:house|home|building|school|hospital|flat|apartment)|at all"
            "|lying around|around)(?=$|[.!?])"
        ),
        "",
    ),
    (r"\b(are there|is there|do we have|have we got|do you have|have you got) (any|some|a) (.+?) left\b", r"\1 \2 \3"),
    (r"^how many (.+?) are\s*[?]*$", r"how many \1 are there"),
    (" from the (?:left|right)(?=$|[.!?])", ""),
    (r"\b(in|into|on|onto|at|near|to) the (nearest|closest) (\w+) to (?=the\b)", r"\1 the \3 nearest to "),
    (
        (
            r"\b((?:in|into|on|onto|at|from|next to) (?:the|a|that) \w+(?: \w+)?)(?<! over)(?<! in)(?<! on) "
            r"there(?=$|[.!?,])"
        ),
        r"\1 over there",
    ),
)
"""In the order in which they are tried."""
