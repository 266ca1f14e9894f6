"""Ways of asking for things to be carried: *the cup should be on the desk*, *could the vase be moved*."""

from __future__ import annotations

_COLOR = r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange|gold|silver|clear)"

BRINGING: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:whatever|everything that|anything that|all that)(?: there)? (?:is|are|stands|lies|you"
            r" find|you see) "
            r"((?:in|on|at|under|by) [^,;.?]+?)[,;.:]+ (?:please |just |you can )*(bring|take|put|carry|move|give|get) "
            r"(?:it|them|that|those) all (?=(?:to|in|on|into|onto|me)\b)"
        ),
        r"\2 everything \1 ",
    ),
    (
        (
            r"^(put |take |move |bring |carry |get |)(?:the )?([^,]+?), all of (?:it|them), (?=(?:to|in|into"
            r"|on|onto|for) )"
        ),
        r"\1all the \2 ",
    ),
    (
        (
            r"^((?:some|an?|the|two|three|any) [^,.;]+?) for ((?:(?:mister|nurse|doctor|miss|mrs) )?[a-z]+)"
            r" (from (?:the "
            r"|my |our |room |ward |office |\w+'s )?[\w' ]+?)(?=[.!]*$)"
        ),
        r"bring \1 \3 to \2",
    ),
    (
        (
            r"\b(the \w+ (?:\w+ )?(?:in|on|at|from|by|near|next to) [^,.;]+?), (?:and )?not the (?:one|other)s? "
            r"(?:in|on|at|from|by|near|next to) [^,.;]+(?=[.!]*$)"
        ),
        r"\1",
    ),
    (r"^((?:can|could|may) \w+ (?:please )?(?:have|get) (?:his|her|their|the|my) [\w ]+?) back(?=[.!?]*$)", r"\1"),
    (
        (
            r"\b(it|that|this|they|those|the [\w ]+?) (?:goes?|can go|should go|belongs?|needs to go"
            r"|wants to go|has to go"
            r"|may go|must go) back(?: (?:to|in|into|on|onto|at) (?:its|their|the) (?:\w+ )?(?:place|spot|home|position"
            r"|location))?(?=$|[.,!])"
        ),
        r"put \1 back",
    ),
    (r"^(?:and |now |then |ok |,)*back (?:it|they|that|this) goes?(?=[.!]*$)", "put it back"),
    (
        (
            r"(?:\b(?:can|could|would|will) you (?:please )?)?\b(?:make sure|see to it|ensure|take care"
            r"|(?:see|check)(?= that\b))(?: that)? ([^,.;]+?) (?:gets|comes"
            r"|makes it|makes its way"
            r"|ends up|winds up|finds its way|lands|arrives|get|end up|makes it back|is (?:put|placed"
            r"|taken|moved|brought"
            r"|delivered|returned)) (?=(?:to|on|in|at|into|onto|back|next)\b)"
        ),
        r"\1 should go ",
    ),
    (
        (
            r"\b(?:needs?|wants?|requires?) (?:moving|putting|taking|bringing|carrying|returning|placing|delivering"
            r"|transferring|shifting|transporting)(?: over| back)? (?=(?:to|on|in|at|into|onto|next)\b)"
        ),
        "should go ",
    ),
    (r"\b(bring|take|carry)( [^,.;]+?) (?:along )?with you\b", r"\1\2"),
    (
        (
            r"^do not (?:put|take|bring|move|carry|leave) ((?:the|my|his|her|that|those|these) [^,.;]+?) (?:in|on|to"
            r"|into|onto|at|next to) [^,.;]+[,.;]+ (?:but |just |instead |please |rather )*(?:put|take|bring|move"
            r"|carry|leave) (?:it|them) (?=(?:in|on|to|into|onto|at|next)\b)"
        ),
        r"put \1 ",
    ),
    (r"(^|[.;!] )(the [\w ]+?) (?:could|can|might|may) go (?=(?:on|in|to|into|onto|at|next)\b)", r"\1put \2 "),
    (r"^(?:can|could|may|might) (the [\w ]+?) go (?=(?:on|in|to|into|onto|at|next)\b)", r"put \1 "),
    (r"\b(?:shove|stick|chuck|plonk|plop|slide|tuck) (.+?) (in|into|onto|on) (?=(?:the|a|my)\b)", r"put \1 \2 "),
    (
        (
            r"\b(?:walk|run|wheel|rush|whisk|drive) (it|them|that|the [\w ]+?) (?:over |across |up |down |along )*"
            r"(?=to )"
        ),
        r"take \1 ",
    ),
    (
        (
            r"\b(put|take|bring|move|carry) (\w+|the [\w ]+?) ((?:on|in|to|into|onto|at) [^,.;]+?),? (?:and |then |,)*"
            r"do the same (?:with|for|to) ([^,.;]+)(?=[.!]*$)"
        ),
        r"\1 \2 \3, then \1 \4 \3",
    ),
    (
        (
            r"^(?:please )?(?:gather|round|collect)(?: up)? ([^,.;]+?),? and (?:set|leave|place|drop|lay|move|store"
            r"|stack|pile|stow) (?=(?:it|them|those|these|everything)\b)"
        ),
        r"pick up \1 and put ",
    ),
    (r",? but (?:no|none of the) (\w+),? (?=(?:for|to|in|into|on|onto) )", r" except the \1 "),
    (r"\b(the [\w ]+?) (?:sitting|standing|lying|resting) (?=(?:on|in|at|next to|by|near) )", r"\1 "),
    (r"(?:^|(?<=[.;!] ))(?:(?:step|number) )?(?:one|two|three|four|five|six)[,:] (?=\w)", ""),
    (
        (
            r"^(?=.* (?:in|on|to|into|onto|at|near|for) )(.+?),? (?:anything|everything|all)(?: of them)? but "
            r"(?:the |an? )?(\w+(?: ones?)?)(?=[.!?]*$)"
        ),
        r"\1 except the \2",
    ),
    (
        (
            r"^(?=.* (?:in|on|to|into|onto|at|near|for) )([^,]+?),(?: and| but| just| only)* not (?:the|an?|any) "
            r"(\w+(?: ones?)?)(?=[.!?]*$)"
        ),
        r"\1 except the \2",
    ),
    (r"\b(?:put|tidy|clear|pack|stow) (\w+|(?:the|my|all|every|these|those) [\w ]+?) away(?=$|[.!?])", r"put \1"),
    (
        (
            r"^(?:can|could|may|might) (?!i\b|you\b|we\b|it\b|the\b|this\b|that\b|someone\b|somebody\b)(\w+)"
            r" (?:please )?(?:have|get|borrow|use) (?=(?:the|a|an|my|some|one|two|any|that|his|her|their)\b)"
        ),
        r"bring \1 ",
    ),
    (
        (
            r"^(?:i|we) do not (?:want|need|like) the (\w+) (\w+)[,.;]+ (?:but |so "
            r"|please )?(.*?)\bthe other(?: one| \2)?(?=$|[ .!?])"
        ),
        r"\3the \2 that is not \1",
    ),
    (
        "^(?:please )?(?:just )?(?:leave|keep) (.+?) (?:where|as) (?:it|they|he|she) (?:is|are)(?=[.!]*$)",
        r"do not move \1",
    ),
    ("^(put |take |move |bring |carry |)(?:the )?(.+?),? all of (?:it|them)(?=[.!]*$)", r"\1all the \2"),
    (
        (
            "^(?:please )?(?:clear|empty|unload|tip)(?: out| off| up)? (the (?:(?![,:;.] )"
            r".)+?),? (onto|into|on to|in to|on|in) (?=(?:the|my) [^,;:.]+[.!]*$)"
        ),
        r"put everything from \1 \2 ",
    ),
    (
        (
            r"(?<!where )(?<!what )\b(?:would|will|might|could) (?:be|look|fit|feel)(?: (?:much|far|way|so"
            "|very))?(?: (?:better|good|nice|nicer|best|great|well|lovely))(?: off)? (?=(?:on|in|at|next to|by"
            "|near|with) )"
        ),
        "should be ",
    ),
    (r"\bgo on to (?=(?:the|my)\b)", "go to "),
    (r"\b(them|those|these) (?:both|all)\b", r"\1"),
    (r"^(.+?), (?:meaning|that is|i\.?e\.?|namely) (.+?), (?=(?:in|on|to|into|onto)\b)", r"\2 "),
    (r"\bget rid of (.+?) by (?:putting|placing|throwing) (?:it|them) ", r"put \1 "),
    (r"\bshow (?=(?:me|him|her|anna|ben|\w+) the \w+ and (?:then )?(?:return|put|bring))", "bring "),
    (
        (
            r"\bthrow (.+?) (?:away )?(in|into|in to) (?=(?:the |a |my )?(?:\w+ )?(?:trash|bin|garbage|rubbish"
            "|waste|dustbin))"
        ),
        r"put \1 in ",
    ),
    (
        r"(?<!the )(?<!a )(?<!my )\b(?:toss|chuck|dump|sling|bin) (.+?) (in|into|onto|on) (?=(?:the|a|my)\b)",
        r"put \1 \2 ",
    ),
    (
        r"\b(put|set|place|lay|stow|store|tidy|clear|pack|drop|move|take) (.+?) away (?=(?:in|into|on|onto|to)\b)",
        r"\1 \2 ",
    ),
    (r"\b(?:put|tidy|clear|pack|stow) away (.+?) (?=(?:in|into|on|onto)\b)", r"put \1 "),
    (
        (
            "(?:^|(?<=and )|(?<=then )|(?<=, )|(?<=please ))(put|set|lay) (?=(?:on|onto|in|into"
            r"|next to) (?:the |a |my )?\w+(?: \w+){0,4}[.!]*$)"
        ),
        r"\1 it ",
    ),
    (r"\b(give|hand|pass|deliver) (?=to (?:me|him|her|us|[a-z]+)[.!]*$)", r"\1 it "),
    (
        (
            r"\b(?:make sure|see to it|ensure|see|take care)(?: that)? (\w+) (?:has|gets|receives|is given) "
            r"(?=(?:the|his|her|an?|some|my|their|one|two)\b)"
        ),
        r"bring \1 ",
    ),
    (r"\b(bring|take|carry|drop) (?=to (?:me|him|her|(?:the|my) \w+(?: \w+)?)[.!]*$)", r"\1 it "),
    (r"\b(?:is|are) to (?:be|go|stay|stand|come|end up) (?=(?:in|on|at|to|into|onto|next)\b)", "should be "),
    (
        (
            r"\b(?:should|must|needs? to|ought to|has to|have to|is supposed to|are supposed to) (?:be )?(?:put"
            "|placed|moved|taken|brought|delivered|carried|stored|kept|returned|transferred) "
        ),
        "should go ",
    ),
    (
        r"\b(?:should|must|needs? to|ought to|has to|have to) (?:live|stand|sit|lie|sleep|rest|reside|end up|belong) ",
        "should be ",
    ),
    (r"\b(?:wants? to be|want) (?=(?:on|in|onto|into) the\b)", "should be "),
    (r"\b(\w+ (?:is|are)) to (?:be )?(?:put|placed|moved|brought|taken) ", r"\1 to go "),
    (r"\b(?:belongs?|goes) (?=(?:on|in|at|with|inside|next|into|onto|back)\b)", "should be "),
    (
        r"\b(?!lets\b|thanks\b|always\b|us\b)(\w+s) (?:can |may |will )?go (?=(?:on|in|into|onto|next)\b)",
        r"\1 should be ",
    ),
    (r"\bgoes (?=to (?:me|him|her|the|\w+)\b)", "should be "),
    (
        r"(?<!if )\b(\w+) (?:should|must|may|can|shall) (?:have|get) (it|them|that|the [\w ]+)(?=$|[.!?,])",
        r"give \2 to \1",
    ),
    (r"\b(?:i want(?:ed)? )?(it|them|that|this) to (?:go|be) (?=to )", r"put \1 "),
    (r"\b(?:i want(?:ed)? )(it|them|that|this) to (?:go|be) ", r"put \1 "),
    (r"\bto (?:the|his|her|my) (?=where)", ""),
    (r"\blet(?: us)? (?=(?:the|my|all|every)\b[^.]* (?:go|be) )", "ensure "),
    (
        (
            r"\b(?:the rest|everything else|all else|the others?) (?:can |may |should )?(?:stays?"
            "|remains?)(?: (?:where|there|put|as|here)[^.,;]*)?"
        ),
        "",
    ),
    (r"\bgo(?: and)? (?:bring|get|fetch) \b", "fetch "),
    (r"\b(?:over )?to where i am(?: now| standing| sitting)?\b", "to me"),
    (
        (
            r"\b(?:back )?(?:again )?to where you (?:were|started|came from|came|began|set off)"
            r"(?: from)?(?: before| at| out)?\b"
        ),
        "to your starting point",
    ),
    (r"^(?:and |ok |okay |then |now )*(?:and )?then (?=\w)", "then "),
    (r",? from there (?=(?:to|go|on|drive|head)\b)", ", then "),
    (r"\b(?:after|having done|once done with) that\b,?", "then"),
    (r"^(?:please )?(?:gather|round|collect)(?: up)? (.+?) and (?=(?:put|bring|take|carry)\b)", r"pick up \1 and "),
    (r"\b(put|take|bring|return|move) (?:everything|it all|all of it|all of them|all that) back\b", r"\1 all back"),
    (r"^(?:i|we) (?:do not|no longer) need (?:\w+ ){1,4}?(?:any ?more|any longer|now)[,.;!]+ (?:so )?(?:please )?", ""),
    (r"^(?:i|we) (?:am|are) (?:done|finished|through)(?: with [\w ]+?)?[,.;!]+ (?:so )?", ""),
    (
        (
            r"^(?:do not \w+ (?:me )?|not )(?:the |a )(?:\w+ )?(\w+)[,;]+ (?:but |just |instead )*(?=(?:bring"
            r"|take|put|go|fetch|get|carry|move|give)\b)(.*)\bone\b"
        ),
        r"\2\1",
    ),
    (r"^not (?:the |a |to the )[\w ]+?[,;] (?:but )?(?=(?:bring|take|put|go|fetch|get|carry|move|give)\b)", ""),
    (r"\bthat is not an? (\w+)(?=$|[.!?,])(?<! one)", r"except \1s"),
    (rf",? but (?:no|not an?|not the) ({_COLOR})(?: ones?)?(?=$|[.!?])", r" that is not \1"),
    (
        r",? but (?:please )?(?:no|not any|not an?|not the|none of the) (?!one\b|other\b)(\w+(?: \w+)?)(?=$|[.!?])",
        r" except the \1",
    ),
    (
        (
            r",? any (?:colou?r|one|kind|shade) (?:except|but|other than|apart from|as long as "
            r"it is not) (?:for )?(?:the )?(\w+)"
            r"(?: ones?)?(?=$|[.!?])"
        ),
        r" that is not \1",
    ),
    (r",? (?:all )?(?:without|save(?: for)?|bar) (the [\w ]*?ones?)\b", r" except \1"),
    (
        (
            rf"^not the ({_COLOR}) (\w+)[,:;] (?:but |please,? )*(?:i (?:want|need|would like)|"
            rf"(?:please )?(?:bring|give|get) me) "
            r"the other(?: one| \2)?(?=$|[ .!?])"
        ),
        r"i want the \2 that is not \1",
    ),
    (
        (
            rf"^not the ({_COLOR}) (\w+)[,:;] (?:please[,:;]? )?(?:but )?the ({_COLOR}) one,? (?=(?:to|"
            rf"for|in|on|into|onto) )"
        ),
        r"the \3 \2 ",
    ),
    (
        rf"^not the ({_COLOR}) (\w+)[,:;] (?:but )?the other (?:one|\2)[.,;]+ (?=(?:to|for|in|on|into|onto) )",
        r"the \2 that is not \1 ",
    ),
    (
        r"\b(?:something|anything) (red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange)\b",
        r"a \1 thing",
    ),
    (r"\bout of (the [\w ]+?) and (?:over |back |up |down |across )?(?:in|on)?to\b", r"from \1 to"),
    (
        r"^(the [\w ]+?) (?:is|goes) (for|to) (\w+),? and (the [\w ]+?) (?:(?:is|goes) )?(for|to) (\w+)(?=[.!]*$)",
        r"\1 to \3 and \4 to \6",
    ),
    (r"^(?:could|can|may) (the [\w ]+?) be (?:moved|put|brought|taken|placed|delivered|carried) ", r"put \1 "),
    (
        r"^(?:please )?(?:have|get) (the (?:(?!and\b)\w+ )+?)(?:brought|taken|moved|delivered|carried|put|placed) ",
        r"put \1 ",
    ),
    (r"^(?:please )?(?:get|take|grab|fetch|pick up) (the [\w ]+?)[,;] (?:it|they|that) should be ", r"put \1 "),
    (r"\b(bring|give|get|fetch|take)me\b", r"\1 me"),
    (r"\b(?:quickest|fastest|shortest|best|easiest) (?:route|path|way)\b", "way"),
    (r"^what (\w+) (?:do|have) (?:we|you|i) (?:have|got)(?=$|[.!?])", r"which \1 are there"),
    (
        (
            r"^(?:is|are) (?!there\b)(.+?) (?:in|on|at) (?:the |a |my )[\w ]+? or (?:in |on |at )?(?:the |a "
            r"|my )?[\w ]+?(?=$|[.!?])"
        ),
        r"where is \1",
    ),
    (r",? (?:but |and )?only (?:the |an? )?(\w+) ones?(?=$|[.!?])", r" that is \1"),
    (
        (
            r"^(?:i|we) do not (?:want|need) [\w ]+?[,.;]+ (?:just |but |so |please )*(?=(?:bring|take|put|get"
            r"|fetch|give)\b)"
        ),
        "",
    ),
    (r"^do not (\w+)( me)? the (?:\w+ )?(\w+),? but (?:rather |instead )?the (\w+) one(?=$|[.!])", r"\1\2 the \4 \3"),
    (r"^on (?:the|your) way to ([\w ]+?), (.+)$", r"\2, then go to \1"),
    (r",? on (?:the|your) way to ([\w ]+)(?=$|[.!])", r", then go to \1"),
    (
        r"^(?:while|when|if) you are (?:over )?(?:in|at) ([\w ]+?), (?=(?:bring|take|get|fetch|pick|put|grab)\b)",
        r"go to \1, then ",
    ),
    (r"\b(?:meet|join|wait for) (?:me|us) (?=(?:in|at)\b)", "go "),
    (r"\b(?:the|all the|all) stuff (?=(?:on|in|from|at)\b)", "everything "),
    (
        (
            r"^(?:i|we) (?:forgot|left|need|lost|want|misplaced) (my|the|our) ([\w ]+?)[,.;]+ (?:can|could|will"
            "|would)? ?(?:you )?(?:please )?(?:bring|get|fetch|grab) (?:me )?(?:it|them)(?: to me"
            "| for me)?(?: please)?(?=$|[.!?])"
        ),
        r"bring me \1 \2",
    ),
    (
        (
            r"^(?:get rid of|deal with|take care of) (the [\w ]+?)[,;.:] (?:please )?(?:put|take|throw"
            "|drop) (?:it|them) "
        ),
        r"put \1 ",
    ),
)
"""In the order in which they are tried."""
