"""Slips of the keyboard, courtesy and motives: what is typed around a request."""

from __future__ import annotations

SLIPS: tuple[tuple[str, str], ...] = (
    (r"\btoo (?=(?:the|my|his|her|our)\b)", "to "),
    (r"\bhwo\b", "how"),
    (r"\b(?:thee|thyself)\b", "yourself"),
    (r"\b(the|an?|to|in|on|my|of|and)(?: (?:uh+|um+|er+),?)?(?: \1\b)+", r"\1"),
    (r"(?<=\w)\.\.(?=\w)", " "),
    (r"\b(the|a|that|my) read (?=\w)", r"\1 red "),
    (r"\biz\b", "is"),
    (r"\b(?:some ?bod(?:y|ie)|sombody|sumbody|someon)\b", "somebody"),
    (r"\b(put|take|bring|get|give|move|in|on|to|from|of|for|and|with|into)the\b", r"\1 the"),
    (r"\b(\w*)(?:lite)\b(?<!\bsatellite)", r"\1light"),
    (r"\b(?:nite)(?=\b|s?tand)", "night"),
    (r"\bthru\b", "through"),
    (
        (
            r"\b((?:take|bring|carry|give|hand|deliver|move"
            r"|get)\b.* \w+) 2 (?=(?!of\b)[^\W\d]+(?: [^\W\d]+){0,2}(?: (?:thx|pls|plz|please|thanks))?[.!]*$)"
        ),
        r"\1 to ",
    ),
    (
        (
            r"\b([^\W\d]+)'s (?=(?:in|on|at|not|here|there|under|near|next|home|asleep|gone|open|closed|shut"
            r"|locked|missing|lost|still|inside|with|an?|the|so|too|very|been|gone|all|getting|being|got|asking|waiting"
            r"|looking|calling|hiding|sitting|standing|lying|sleeping|hungry|thirsty|tired|ill|sick|busy|ready|out|away"
            r"|broken|dirty|empty|full|disappeared|vanished|fallen|dropped|rolled|turned|moved|left"
            r"|come|become|found|run)\b)"
        ),
        r"\1 is ",
    ),
    (r"\b(?:teh|hte|th)\b", "the"),
    (r"\b(?:adn|nad|n)\b(?= )", "and"),
    (r"\bgoto\b", "go to"),
    (r"\b(?:form)\b(?= the\b)", "from"),
    (r"\b(go|goes|come|drive|head|back|walk|move) (?:too|ot|2)(?= )", r"\1 to"),
    (r"\b(?:u+m+|e+r+m+|u+h+m*|h+m+|pleas|plase|pleese|pls+|plz+|plox|thx|tnx|thanx)\b(?=.)", "please"),
    (r"\byuo\b", "you"),
    (r"\b(?:fo|4|fro)(?= (?:me|you|her|him)\b)", "for"),
    (r"\bhow? m[an]?[an]?y\b", "how many"),
)
"""Words that are no English, and what was meant."""

COURTESY: tuple[tuple[str, str], ...] = (
    (r"\b(?:all )?(?:the|my|those|these) ((?:\w+ )?\w+s),? both of (?:them|these|those)\b,?", r"both \1"),
    (
        (
            r"(?<=\w),? (?:by the way|btw|just so you know|for your information|fyi|if you (?:did not|do not) "
            r"know)(?=[.!?]*$)"
        ),
        "",
    ),
    (
        (
            r"(?:^|(?<=\w),? )(?:if|when|once|as soon as) you are (?:not (?:too |very |otherwise |that )?busy"
            r"|free|available"
            r"|not doing anything(?: else| important)?|idle|bored|up to it|able|not needed elsewhere)(?: right "
            r"now| now)?"
            r"(?=$|[.!?,]| \w),? ?"
        ),
        "",
    ),
    (r"^would it (?:kill|hurt|bother|trouble|be too much for|be possible for) you (?:too much )?to (?=\w)", ""),
    (
        (
            r"^(?:please )?(?:(?:do|there are|i have|here are|i have got) )?(?:these |the following |just )?"
            r"(?:two|three|four|five|some|a few|several|a couple of) (?:things|jobs|tasks|chores|errands)"
            r"(?: for you| to do| for you to do)?[:,.-]+ (?=\w)"
        ),
        "",
    ),
    (
        (
            r"^(?:somebody|someone|anyone|anybody|one of you),? (?:please )?(?=(?:get|bring|take|fetch"
            r"|put|give|go|come|find|carry|move)\b)"
        ),
        "",
    ),
    (r"(?<=\w), (?:and )?(?:no|not|nothing) more(?: than that)?(?=[.!]*$)", ""),
    (
        (
            r"^(?:the |my |our )?([\w' ]+?) (?:needs|wants|could do with|requires|is due) (?:some "
            r"|a good |a bit of |a )?"
            r"(?:tidying|cleaning|clearing|sorting|sorted|tidy|clean|clearing)(?: up| out)?[:;,.]+ "
        ),
        r"tidy the \1: ",
    ),
    (
        (
            r"\b(?:be |being )?(?:so )?(?:good|kind|nice|sweet|gracious|obliging|lovely) (?:as|enough) to "
            r"(?=\w)"
        ),
        "",
    ),
    (r"^(?:it is )?(?:about |high )?time (?:for you |you )?(?:to )?(?=\w)(?!is\b)", ""),
    (r"\s*(?:-+>|=+>|→)\s*|(?<=\w) >+ (?=\w)", " to "),
    (r"^first(?:ly)?[,:]? (.+?)(?:,|;|\.| and|, and)+ second(?:ly)?[,:]? (?=\w)", r"\1, then "),
    (r"^(?:maybe|perhaps|possibly)[, ]+(?=\w)", ""),
    (r"^(?:tidy|clean|clear|pick) up after (?:the |your |our |my )?[\w ]+?[:,;.]+ ", ""),
    (
        (
            r"^(?:(?:so|like|well|ok|okay|yeah|right|now)[, ]+)*(?:i was (?:just )?(?:thinking"
            r"|wondering|hoping)|i have been thinking|i (?:think|guess|figure|reckon|suppose))(?: that"
            r"| maybe| perhaps)*,? (?=(?:the|my|it|we|you|can|could|would)\b)"
        ),
        "",
    ),
    (r",? (?:yeah|yes|ok|okay),? (?:please )?do that(?=[.!]*$)", ""),
    (
        (
            r"(?<=\w)(?<! or)(?<! if),? (?:and )?so (?:please |can you |could you |then |now |just "
            r"|if you could )*(?=(?:the|my|his|her|go|bring|take|put|get"
            r"|fetch|give|find|come|move|carry|drop|return|look|hand|pick)\b)(?!(?:it|they|my \w+"
            r"|the \w+) (?:can|could|will|may|is|are|does)\b)"
        ),
        ". ",
    ),
    (
        (
            r"(?<=\w)(?<! or)(?<! if),? so (?=(?:the|my|his|her) [\w ]+? (?:can|could|may|should|must"
            r"|has to|needs to) (?:go|be|return)\b)"
        ),
        ". ",
    ),
    (r",? i mean,? (?=(?:she|he|they|it|we) (?:needs?|wants?|is|are|has|have)\b)", ", "),
    (
        (
            r",? if you (?:can |could |happen to |manage to |are able to |ever )*(?:find|see|spot"
            r"|locate|get hold of|track down|come across|have) (?:it|them|one|any|some|him|her)"
            r"(?: somewhere| anywhere)?(?=$|[.!?,])"
        ),
        "",
    ),
    (
        (
            r"((?:^|[.,;!] |\band |\bthen ))you (?:may|might|shall|are free to|are welcome to|can now"
            r"|may now|can)(?: now| then)? (?=(?:return|put|take|bring|go|carry|move|get|fetch|give"
            r"|come|drive|leave|drop|place)\b)"
        ),
        r"\1",
    ),
    (
        (
            r"\bbe an? (?:\w+ )?(?:dear|darling|love|pal|sweetheart|angel|lad|boy|girl|sport|robot|star|friend|gem"
            r"|treasure|hero)(?:,| and)+ "
        ),
        "",
    ),
    (
        (
            r"\b(would be) (?:most|very|so|really|ever so|extremely|truly|incredibly|awfully) (?=(?:grateful|happy"
            r"|glad|pleased|obliged|thankful|delighted|nice|kind|great|good|helpful|lovely)\b)"
        ),
        r"\1 ",
    ),
    (
        (
            r"(?<=\w)[,.;]+ (?:(?:would|could|can|will) you )?(?:please )?(?:see to|take care of|handle|sort out"
            r"|attend to|arrange) (?:that|it|this)(?: for me| for us)?(?=[.!?]*$)"
        ),
        "",
    ),
    (
        (
            r"(?<=\w)[,;!]+ it is (?:raining|snowing|pouring|freezing|cold|hot|warm|dark|late|sunny|windy|wet|urgent"
            r"|important|getting \w+)(?: outside| out there| in here| today)?(?=[.!?]*$)"
        ),
        "",
    ),
    (r"^(?:can|could|would|will) (?:some(?:one|body)|anyone|anybody) (?:please )?(?=\w)", "can you "),
    (
        (
            r"^(?:(?:(?:i|we|they) have|(?:he|she|it) (?:has|is)|they are) )?(?:all )?(?:just |now )?(?:done|finished"
            r"|through|not \w+ after all|(?<=have )taken|(?<=has )taken)\b[^,.;!?]*[,.;!]+ (?:so |and |now )*(?="
            r"(?:please |you can |you may |kindly )*(?:put|return|take|bring|carry|it can|they can|it should|back)\b)"
        ),
        "",
    ),
    (
        (
            r"^(?:you should know|be aware|bear in mind|keep in mind)(?: that)?"
            r",? (?=\w)"
        ),
        "",
    ),
    (r"\bfrom (?:today|this day|this moment|here) on(?:ward|wards)?\b", "from now on"),
    (r"\s*(?:\.{2,}|…)\s*(?=\w)", ", "),
    (r"(?<=\w),? +[-–—]+ +(?=\w)", ", "),
    (
        (
            "^(?:(?:hi|hey|hello|yo|ok|okay|so)?[!,. ]*)?(?:a |one )?(?:quick|small|little) (?:one|question"
            r"|thing|favou?r|request|task|job)\s*[-,:.!]+ ?"
        ),
        "",
    ),
    (
        (
            r"(?<!would )(?<!do )(?<!if )\b(you|please|just) like (?=(?:go|come|bring|take|get|fetch|put|move"
            r"|give|find|tell|carry|drive|grab|pick)\b)"
        ),
        r"\1 ",
    ),
    (r"(?<=\w),? or (?:something(?: like that)?|so|whatever|somewhere)(?=$|[.!?])", ""),
    (
        (
            r"(?<=\w),? (?:can|could|will|would|can not|will not"
            "|would not) you(?: please)?(?: help(?: me)?(?: out)?| find (?:it|them))?(?=[?.!]*$)"
        ),
        "",
    ),
    (
        (
            r"(?<=\w),? (?:wherever|where ever) (?:it|they|he|she|that) (?:is|are|may be|might be|went|got to"
            "|has gone)(?=$|[.,!?])"
        ),
        "",
    ),
    (r" and (?:nothing|no one|nobody) else\b", ""),
    (
        (
            r"^(?:he|she|they|\w+) (?:do|does|did) not (?:want|need|like) (?:it|them|that|this)(?: any ?more"
            "| any longer| after all)?[,.;!]+ (?:so )?"
        ),
        "",
    ),
    (
        (
            r"(?<=\w),? (?:when|once|after|as soon as) you (?:have|are) (?:been there|done(?: (?:that|it|so))?"
            "|finished|through|ready|there)(?=$|[.,!?])"
        ),
        "",
    ),
    (" (?:at the moment|at present|right now|as we speak|these days)(?=[?.!]*$)", ""),
    (
        (
            r"(?<!\btake)(?<!\bbring)(?<!\bput)(?<!\bmove)(?<!\bcarry)(?<!\bget)(?<!\bfetch)(?<!\bme)(?<!\bhim)(?<!\bher)(?<!\bup)"
            ",? (?:the )?(?:both|all|each and every one|each|every one)(?: (?:two|three|four))? of (?:them"
            "|these|those)(?=$|,| (?:except|but|apart|without|into|onto|in|on|to|go|goes"
            r"|should|must|can|belong|belongs)\b),?"
        ),
        "",
    ),
    (
        (
            "^(?:i am|we are|he is|she is) (?:so |really |very |a bit |a little |quite |feeling )*(?:thirsty"
            "|hungry|cold|tired|bored|busy|sick|late|hot|in a hurry|starving|freezing)[,.!;:]*(?: and"
            r"| so)? (?=\w)"
        ),
        "",
    ),
    (
        (
            r",? (?:because|cause|cuz) (?:i|we|he|she|it|they|my|the \w+|\w+) (?:am|is|are|was|have|has|need"
            r"|needs|want|wants|would|will|can not|feel|feels|forgot)\b[^.;!?]*(?=$|[.;!?])"
        ),
        "",
    ),
    (
        (
            r",? so (?:that )?(?:i|we|he|she|they|it) (?:can|could(?! (?:do with|use|go "
            r"for|have|murder|get)\b)|will|may"
            r"|do not|does not|is|are|am)\b(?! i (?:have|get|borrow)\b)[^.;!?]*(?=$|[.;!?])"
        ),
        "",
    ),
    ("^i(?: would|) (?:need|want|like|love|prefer)(?: for)? you to ", ""),
    (r"\b(?:for|to) the (?:moment|time being)\b", ""),
)
"""Openings, moods and reasons; they change nothing in what is asked."""

UNDOING: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:ok(?:ay)? |now |and |then |please |,)*back (?=(?:to|in|into|on|onto|at) (?:(?:where|wherever) (?:you"
            r"|it|they|we|i)|(?:its|their) (?:\w+ )?(?:place|spot|position|home))\b)"
        ),
        "put it back ",
    ),
    (
        (
            "^(?:please )?(?:undo|reverse|revert|take back|roll back) (?:what you (?:have )?(?:just )?did"
            "|what you have (?:just )?done|your last (?:step|move|action|task)|the last (?:one|step|thing|move"
            "|task|action)|it|that|this)(?: please)?[.! ]*$"
        ),
        "put it back where it was",
    ),
    (
        (
            "^(?:please )?(?:never mind|nevermind|forget it|stop|wait|no)[,.;:!]+ (?=(?:put|take|return"
            r"|bring) (?:it|them|that|the \w+) back\b)"
        ),
        "",
    ),
    (r"^(?:please )?(?:never mind|nevermind|forget it)[,.;:]* (?=(?:put|take|return|bring)\b)", ""),
    (
        (
            r"\b(?:i|you|we|he|she|they|someone|somebody) (?:have |had |just )*(?:left|put|placed|dropped"
            "|forgot|laid|set|saw)(?: lying| standing| down)? (?=(?:on|in|at|next|by|near) )"
        ),
        "that is ",
    ),
)
"""Taking back, in a word."""
