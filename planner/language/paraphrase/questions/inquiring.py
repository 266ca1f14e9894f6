"""Questions that lean on set phrases: tags (*…, right?*), what is empty, what leads where, how long something takes."""

from __future__ import annotations

_ASKED = r"(?:how|where|what|which|who|is|are|do|does|can|have|has|did|in which|whose|when|why|if)"
_ADDRESSED = (
    r"(?:young|old|dear|good|kind|my|little|mr|mister|miss|madam|ma'am|sir|man|lady|boy|girl|friend|buddy|mate|pal"
    r"|fellow|robot|there|you|everyone|folks|love|darling|honey|sweetie|son|dude|chap|then|again)"
)
_TAGS = (
    r"(?:right|correct|is not it|is it not|are not they|yes|no|true|or|or not|am i right|is that right|huh|eh"
    r"|does it)"
)
_BETWEEN = r"(?:of (?:them|these|those|the two) )?"

INQUIRING: tuple[tuple[str, str], ...] = (
    (r"^where abouts? (?=(?:is|are|was|were|did|do|can|in|on)\b)", "where "),
    (
        (
            r"^where (?:have|has|did) (.+?) (?:gone|got(?:ten)?|go|get|wandered off|run off"
            r"|disappeared|vanished|ended up|end up|been put)(?: to)?(?=[?.!,;]|$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^what (is|are) ([^?,;]+?) (?:in|on|inside)[,;]* (?:and )?(?:in |and )*(?:which|what) "
            r"room(?: (?:is it|are they))?(?: in)?(?=[?.!]*$)"
        ),
        r"where \1 \2",
    ),
    (r"^(when did you [^?,;]+?)[,;]* (?:and )where(?: (?:was|were) (?:it|that|they))?(?=[?.!]*$)", r"\1"),
    (
        (
            r"^where (?:was|were) ([^?,;]+?),? (?:the )?last time(?: that)? you (?:saw|noticed|looked)(?: "
            r"(?:it|them|him|her))?(?=[?.!]*$)"
        ),
        r"where did you last see \1",
    ),
    (
        (
            r"^(?:do (?:we|you|i) (?:still |even )?(?:have|own)|have (?:we|you) (?:still )?got|(?:is|are) "
            r"there(?: still)?) (?:any |some )?([\w ]+?)(?: left)?((?: (?:in|on|at|under|near"
            r"|next to) [^?,.;]+)?)[?,.;]+ (?:and )?(?:if (?:so|yes),? )?how many(?: of them)?(?: (?:are "
            r"there|do we have|are left))?(?=[?.!]*$)"
        ),
        r"how many \1 are there\2",
    ),
    (r"^(?:please )?(?:list|name|enumerate|recite|read out)(?: me)? (?=(?:what|who) (?:is|are)\b)", ""),
    (
        (
            r"^what (?:kinds?|sorts?|types?) of (?:things?|tasks?|jobs?|stuff|work|chores?) (?:can|could"
            r"|do|are) you (?:do|able to do|help(?: me)? with|manage)(?: for (?:me|us))?(?=[?.!]*$)"
        ),
        "what can you do",
    ),
    (
        (
            r"^(?:in |at )?(?:which|what) (?:part|area|corner|end|side|section)(?: of (?:the |this "
            r")?(?:building|house|flat|home|place|apartment))? (is|are) (?!the \w+er\b)"
        ),
        r"where \1 ",
    ),
    (
        (
            r"^(what|which) (?![\w ]*\bcolou?r)([\w ]+?) (?:does|do) ((?:the|my|our|room|ward|\w+'s) ?[\w"
            r" ]*?) (?:have|hold"
            r"|contain|store|offer"
            r"|stock|keep)(?: in stock)?(?=[?.!]*$)"
        ),
        r"\1 \2 are in \3",
    ),
    (
        r"\b(?:what|which) (?:kinds?|sorts?|types?|varieties|variety) of (?!colou?rs?\b)(?=\w)",
        "what ",
    ),
    (r"^((?:in|on|at|and|tell me) )*(?:wich|whitch|wihch|whcih)\b", r"\1which"),
    (
        (
            rf"^(?:excuse me|pardon me|pardon|hello|hey|hi|good (?:morning|day|evening|afternoon)|oh|dear|say"
            rf"|listen|look"
            rf"|tell me|quick question|question|so|well|now|ok|okay|right)(?:,?"
            rf" {_ADDRESSED})*\s*[,:.!]+\s*(?={_ASKED}\b)"
        ),
        "",
    ),
    (rf"^(which|what|who)(?: one)? {_BETWEEN}(is \w+er|has more|has fewer)\s*[:;–-]\s*(?=\w)", r"\1 \2, "),
    (rf"^(which|what|who)(?: one)? {_BETWEEN}(is \w+er|has (?:more|fewer))\b", r"\1 \2"),
    (r"^(?:which|who) has (?=(?:the )?(?:more|fewer|most|fewest)\b)", "what has "),
    (rf"^((?:the|my|our|there|[a-z]+) [^?]*?\b(?:is|are|has|have)\b[^?]*?), {_TAGS}[?.! ]*$", r"tell me if \1?"),
    (r"\b(?:have |has )?(?:lost|losing) (?:all )?(?:track|sight) of ", "lost "),
    (
        (
            r"((?:look(?:ing)? for|searching for|lost|misplaced|can not find|missing) [^.;?!,]+?)[,;.?!]+"
            r" (?:(?:and |but )?"
            r"(?:any (?:idea|clue|hint|thoughts?|tips?|suggestions?)|do you know|can you help(?: me)?|help(?: me)?"
            r"|(?:have you )?seen (?:it|them)|where (?:is it|are they|(?:could|might|can) (?:it|they) be)))[?!. ]*$"
        ),
        r"\1",
    ),
    (
        (
            r"^(?:is|are) (.+?) (?:still |already |quite |completely |all |currently )*(?:empty|unoccupied"
            r"|vacant|bare)"
            r"(?: now| yet| at the moment)?(?=[?.!]*$)"
        ),
        r"is there nothing at \1",
    ),
    (
        (r"^is there (?:really |still )?not (?:anything|any thing) (?=(?:in|on|at|under|next|inside|near)\b)"),
        "is there nothing ",
    ),
    (
        (
            r"^(?:can|could|may|is it possible (?:for me )?to) (?:i |we |one |somebody |anyone )?(?:get|go|walk"
            r"|come|enter)"
            r" (?=(?:to|into|in|inside|through to)\b)(?:to|into|inside|in to|in|through to) "
        ),
        "can you reach ",
    ),
    (
        (
            r"^why (?:can|could) (?:not )?(?:you|i|we) (?:not )?(?:go|get|drive|enter|reach|come)(?: in)?(?: to|"
            r" into| in)?"
            r" (?=(?:the|my|our)\b)"
        ),
        "can you reach ",
    ),
    (
        (
            r"^how (?:long|much time|many (?:minutes|seconds)) (?:would|will|does|do|might|could|is) (?:it |you "
            r"|that )?"
            r"(?:take|need|require)?(?: (?:you|me|us|one|a robot))?(?: to)? (?:get|go|drive|walk|come|reach"
            r"|be)(?: over| there)?"
            r"(?: to| in| into| at)? (?=(?:the|my|our|me|a|an|here|\w+)\b)"
        ),
        "how long to reach ",
    ),
    (
        (
            r"^how (?:long|much time|many (?:minutes|seconds)) (?:would|will|does|do|might|could|is) (?:it |you "
            r"|that )?"
            r"(?:take|need|require)?(?: (?:you|me|us|one|a robot))?(?: to)? (?:bring|fetch|get|carry|deliver|hand)"
            r"(?: me| us| over| here)? (.+?)(?: (?:to me|here|over|for me))?(?=[?.!]*$)"
        ),
        r"how long to fetch \1",
    ),
    (
        (
            r"^(which|what) (rooms?) (?:is|are|lies?|do) (?:directly |right |just )?(?:connected (?:to|with)"
            r"|adjacent to"
            r"|adjoining(?: to)?|attached to|joined to|reached from|behind|beyond|after|off|adjoin"
            r"|border(?:ing)?(?: on)?"
            r"|lead(?:ing)? (?:off|from)|accessible from|beside) "
        ),
        r"\1 \2 is next to ",
    ),
    (
        (
            r"^(?:through|via|by) (?:which|what) (?:rooms?|doors?|way) (?:do|must|would|should|can) (?:i|we|you|one) "
            r"(?:have to |need to )?(?:go|pass|walk|drive|get)(?: through)?(?: in order)?(?: to)? (?:get to"
            r"|reach|go to|to) "
        ),
        "how do i get to ",
    ),
    (
        (
            r"^(?:can you |could you |please )*(?:name|recite|write down|give me a list of|give me|make a list"
            r" of|tell me|say)"
            r" (?:me )?(?=all (?:the |my |our )?\w+)(?!all (?:the )?(?:way|about))"
        ),
        "list ",
    ),
    (r"^(?:please )?(?:give|make|show)(?: me)? (?:a |the )?list of (?:all )?", "list "),
    (
        (
            r"^(?:can you |could you |please )*(?:tell me|name|list|say|show me) (?:everything|all things|all"
            r"|anything)"
            r"(?: you (?:have seen|see|know))?(?: (?:that|which))?(?: (?:is|are|there is|you see|you know))?"
            r"(?: there)? (?=(?:in|on|at|under|inside|next to)\b)"
        ),
        "what is ",
    ),
    (r"^what does (.+?) look like(?=[?.!]*$)", r"describe \1"),
    (r"^what is (.+?) like(?=[?.!]*$)", r"describe \1"),
    (
        (
            r"^who (?:all |else )?is (?:at home|home|around|about|in the house|in the building|in)(?:"
            r" now)?(?=[?.!]*$)"
        ),
        "where is everyone",
    ),
    (
        (r"^(?:do|did) you (?:happen to |perhaps |maybe |ever )*(?:have )?(?:seen|see|spotted|spot|noticed?) "),
        "have you seen ",
    ),
    (r"^(is|are) (.+?) (?:locked|bolted|shut|barred|locked up|closed up)(?: up| off)?(?=\W)", r"\1 \2 closed"),
    (r"^(is|are) (.+?) unlocked(?=[?.!]*$)", r"\1 \2 open"),
    (r"^(which|what) (?:one )?of (?:the|my|our|these|those) (\w+?)s (is|has)\b", r"\1 \2 \3"),
    (r"\b(is|are) there (?:still|already|actually|currently|maybe|perhaps|even|ever|really) ", r"\1 there "),
    (r"^(?:are|is|did|have) (?:we|you|it) (?:run |gone )?(?:all |completely )?out of (?!the\b|my\b)", "is there no "),
    (
        (
            r"^(?:is (?:any|some)thing|what(?: things?)? (?:is|are|did i|have i|do we)) (?:currently )?"
            r"(?:missing|lost|gone|lose|misplaced?)(?=[?.!]*$)"
        ),
        "which things are missing",
    ),
    (r"^(\w+) (?:is|are) (?:where|whereabouts)(?=[?.!]*$)", r"where is \1"),
    (
        (
            r"^(?!(?:\w+ )*(?:tell|i|you|me|us|is|are|was|know|idea|clue|look|find|see|go|any|no|to|of|in|on|at)\b)"
            r"(?:the |my |our )?((?:\w+ ){1,3}?\w+|\w+),? where(?: is it| are they)?(?=[?.!]*$)"
        ),
        r"where is the \1",
    ),
    (r"^(?:where (?:oh|o)|oh where) ", ""),
    (r"^((?:the|my|our) [\w' ]+?) (?:is|are|has|have) (?:what|which) colou?r(?=[?.!]*$)", r"what color is \1"),
    (r"^(?:the |my |our )?((?!what|which)[\w' ]+?),? (?:what |which )?colou?r(?=[?]+$)", r"what color is the \1"),
    (r"^(?:the |our |my |all )?([\w ]+?),? how many(?: are there| do we have| of them)?(?=[?.!]*$)", r"how many \1"),
    (
        r"^((?:the|my|our) [\w' ]+?) (?:is|are) not [^,.;?]+?[,;.] (?:so )?where (?:is|are) (?:it|they)\b",
        r"where is \1",
    ),
    (r"^how far (?:away )?are you (?:away )?from ", "how far is it to "),
    (r"^which way (?:is it )?(?:to|into) ", "how do i get to "),
    (
        (
            r"^(is|are) there (?:an? |any |some )?(\w+) or (?:an? |any |some )?(\w+)((?: (?:in|on|at)"
            r" [^?]+?)?)(?=[?.!]*$)"
        ),
        r"is there a \2\4? is there a \3\4",
    ),
    (
        r"^(?:what|which) (?:things )?(?:can|could|may) (?:i|we) (?:eat|snack on|have for \w+)(?=[?.!]*$)",
        "which food is there",
    ),
    (r"^(?:what|which) (?:things )?(?:can|could|may) (?:i|we) drink(?=[?.!]*$)", "which drinks are there"),
)
"""Before the rules of ``ASKING``."""
