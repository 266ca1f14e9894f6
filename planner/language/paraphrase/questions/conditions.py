"""Ways of stating a condition: *in the event that*, *should Anna be in*."""

from __future__ import annotations

_ELLIPTIC = r"(?:he|she|it|they|there|that|this|we|you|i)"
_DOES = r"(?:is|are|was|were|does|do|did|has|have|can)"
_DEED = (
    r"(?:go|bring|put|take|come|get|drive|fetch|return|wait|pick|give|carry|tell|move|leave|stay|please|then"
    r"|hand|drop)"
)
_HANDS = r"(?:you have (?:your|one|both) hands?|your (?:hands?|grippers?|arms?) (?:is|are))"

CONDITIONS: tuple[tuple[str, str], ...] = (
    (
        (
            r"\b(there (?:is|are)|(?:is|are) there) ((?:no|not any|any|some|still|enough|an?|two|three"
            r"|more)\b[^,.;?]*?) left"
            r"\b(?! (?:of|side|hand)\b)"
        ),
        r"\1 \2",
    ),
    (r"\b(if|unless) no ((?:\w+ ){0,2}\w+) (?:is|are) (?:left(?: over)?|there|remaining)\b", r"\1 there is no \2"),
    (
        (
            r",? (?:or |and |but )*if (?:(?:we|you|they|i|there) (?:have|has|are|is|find|see) (?:none|not any|no more)"
            r"|(?:we|you) (?:are|have run) out|there (?:is|are) (?:none|not any))(?: of (?:them|it|those))?(?: left"
            r"| there| any ?more)?,? (?:then |just |please )*(?=(?:the|an?|some|my|one|two)\b)"
        ),
        ", otherwise ",
    ),
    (
        (
            r"^no ([a-z ]+?)(?: left| there)?\? (?:well,? |ok,? |all right,? )*(?:then )?((?:the |some |an?"
            r" )?[a-z ]+?) "
            r"(?:is|are|will be|would be) (?:fine|ok|okay|good|all right|alright|nice)(?: too| as well| then)?"
            r"(?:[,;.]| so| and)+ (?:bring|get|fetch|give)(?: me| us)? (?:it|that|them)(?: to me)?(?=[.!]*$)"
        ),
        r"if there is no \1, bring me \2",
    ),
    (
        (
            r"^(if there (?:is|are) (?:no|not any) [^.;!?]*?)[,;.] (?:but |and )*if there (?:is|are)(?: some"
            r"| any| one)?,? "
            r"(?:then )?(?=(?:the|an?|some|one|two|three|bring|take|get|give|fetch|put|go|come)\b)"
        ),
        r"\1, otherwise ",
    ),
    (
        r"^when ((?:the|my|his|her) [\w ]+?) is (open|closed)(?=, )",
        r"if \1 is \2",
    ),
    (
        (
            r"^(if [^,.;]+? is closed, [^.;!?]*?)[,;.] (?:but |and )*(?:when|if) it is (?:open|not closed),? (?:then )?"
            r"(?=to )"
        ),
        r"\1, otherwise take it ",
    ),
    (
        (
            r"^(if [^,.;]+? is open, [^.;!?]*?)[,;.] (?:but |and )*(?:when|if) it is (?:closed|not open),? (?:then )?"
            r"(?=to )"
        ),
        r"\1, otherwise take it ",
    ),
    (r"^should you (?:happen to |ever )?(?=(?:see|find|come across|spot|notice|have|discover)\b)", "if you "),
    (
        (
            r"\b(if|unless) ((?!(?:it|he|she|they|there|that|this|nobody|someone|somebody|anyone|anybody|you|the|one"
            r"|everyone)\b)\w+) is "
            r"(?:at home|home|around|about|in|there|here)(?=,| (?:bring|take|give|go|tell|hand|fetch)\b)"
        ),
        r"\1 there is \2",
    ),
    (
        (
            r"^(?:if|when|in case) ([^.?!;]+?), (?:please )?(?:tell me|let me know|say so)(?: so| "
            r"please)?(?=[.!]*$)"
        ),
        r"tell me if \1",
    ),
    (r"^((?:if|unless)\b[^.?!;]*?),? instead(?=[.!]*$)", r"\1"),
    (
        (
            rf"\b({_DEED}(?: me| us| him| her)?) either ((?:the|an?|my|some) [\w' ]+?) or ((?:the|an?|my"
            rf"|some) [\w' ]+?)(?=[.!]*$)"
        ),
        r"\1 \2, otherwise \3",
    ),
    (r"^((?:if|in case|suppose|supposing|assuming|provided)\b[^:;,.]*): (?=\w)", r"\1, "),
    (r"\b((?:if|unless)\b[^,.;!?]*?) (?:already|yet|currently|by now|by then|indeed)\b", r"\1"),
    (
        (
            r"^((?:please )?(?:take|bring|put|carry|move) )((?:the|my|his|her|that|an?|some) [\w' ]+?) "
            r"(to|in|on|into|onto|at) ([\w' ]+?),? unless (?:it|they|that) (?:is|are) there(?=[.!]*$)"
        ),
        r"unless \2 is at \4, \1\2 \3 \4",
    ),
    (
        (
            rf"^([^.?!;]*\b(?:unless\b|if [^,.;]*? not\b)[^.?!;]*?),? (?:and |but )*if {_ELLIPTIC} (?:is|are|does|has)"
            rf"(?: there| so| in| have (?:one|it))?,? (?:then )?(?={_DEED}\b)"
        ),
        r"\1, otherwise ",
    ),
    (rf"^if ([^.?!;]+?),? tell me[.;,!]+ (?:otherwise|if not),? (?={_DEED}\b)", r"unless \1, "),
    (
        (
            rf"^if ([^.?!;,]+?,? {_DEED}\b[^.?!;]*?)[.;,]+ (?:otherwise|if not|else),? (?:just |please )*"
            r"(?:tell me|let me know|say so)(?: so)?(?=[.!]*$)"
        ),
        r"if \1",
    ),
    (rf"\b(if|unless|when) {_HANDS} (?:free|empty)\b", r"\1 you are not holding anything"),
    (r"\b(if|unless|when) you have (?:a|one|both) (?:free|empty) hands?\b", r"\1 you are not holding anything"),
    (rf"\b(if|unless|when) {_HANDS} (?:full|busy|occupied|in use)\b", r"\1 you are holding anything"),
    (
        r"\b(if|unless|when) you (?:have|are carrying|hold|carry|have got) nothing(?: in your \w+)?\b",
        r"\1 you are not holding anything",
    ),
    (
        r"\bif you are not (?:holding|carrying) (anything|something|a thing)(?: in your \w+)?\b",
        r"unless you are holding anything",
    ),
    (
        (
            r"\b(if|unless) ((?:the|my|his|her|our|that) [\w' ]+?) (?:is|are) (not )?(?:empty|bare|vacant|cleared"
            r"|clear)\b(?! of\b)"
        ),
        r"\1 there is \3nothing at \2",
    ),
    (r"\bif there is not nothing at\b", "unless there is nothing at"),
    (r"^only if (.+?),? (?:should|shall|must|may|can) (?:you|it|they) ", r"if \1, "),
    (r"^only (bring|take|put|give|go|get|fetch|move|carry) ([^,.;]+?) if ", r"\1 \2 if "),
    (
        (
            r"\b(if|unless|whether|provided(?: that)?|in case|as long as|assuming(?: that)?|so long as) (?:we|i"
            r"|you|they)"
            r" (?:still |really |already |actually )*(?:have|have got|own|possess)(?: still| got)? "
        ),
        r"\1 there is ",
    ),
    (
        (
            rf"(?<=[.?!;] )(?:and |but )?if (?:{_ELLIPTIC} {_DOES}(?: (?:there|so|open|one|some|any|true|at home"
            rf"|home))?"
            rf"|there (?:is|are)(?: one| some| any)?|yes|so|that is so)(?:, ?(?:then )?| then | (?={_DEED}\b))"
        ),
        "if so, ",
    ),
    (
        (
            rf"(?<=[.?!;,] )(?:and |but )?if (?:{_ELLIPTIC} {_DOES} not(?: (?:there|so|one|some|any|open))?"
            rf"|there (?:is|are) (?:none|not any|no such thing|nothing)(?: left| there)?)(?:, ?(?:then )?| then |"
            rf" (?={_DEED}\b)| (?=(?:the|a|an) ))"
        ),
        "otherwise ",
    ),
    (
        (
            r"\bif (\w+) (?:has left|is out of|is no longer in|has gone from|has gone out of"
            r"|is away from) (?=(?:the|my)\b)"
        ),
        r"unless \1 is in ",
    ),
    (
        (
            r",? or(?: else)?,? ((?:the|an?|some|my) [\w ]+?) if (?:there (?:is|are) (?:none|no \w+|not any)(?:"
            r" left)?"
            r"|you (?:can not|do not) (?:find|see) (?:it|any|one|them)|(?:it|that|they) (?:is|are) "
            r"(?:gone|not there|missing)"
            r"|not)(?=$|[.!])"
        ),
        r", otherwise \1",
    ),
    (r",? or,? failing that,? (?=\w)", ", otherwise "),
    (r"\b(has|have|holds|contains|got) ([^,.;]+?) (?:in|on|inside) (?:it|them)\b", r"\1 \2"),
    (
        r"\bif you (?:happen to )?(?:see|find|come across|spot|notice|have|discover) (?=(?:an?|any|some|the|one)\b)",
        "if there is ",
    ),
    (
        (
            r"\bif you (?:happen to )?(?:see|find|come across|spot|notice|have|discover) (?!it\b|them\b|him\b"
            r"|her\b)(?=\w)"
        ),
        "if there are ",
    ),
    (
        (
            r"^((?!where|what|which|who|how|is|are|any)(?:the [\w ]+?|\w+)) (in|on|at) ((?:the|my"
            r"|our) [\w' ]+?)\? (?=(?:if|then|in that case)\b)"
        ),
        r"is \1 \2 \3? ",
    ),
    (
        (
            r"\b(if there (?:is|are) (?:still )?(?:an?|any|some) [\w ]+?) (?:left|remaining|over"
            r"|available|to be found|to be had|anywhere)(?=,| (?:bring|take|put|go|get|give|fetch)\b)"
        ),
        r"\1",
    ),
    (
        (
            "^either (.+?),? or,? (?:else,? )?(?:if (?:it|they|that) (?:is|are) (?:gone|missing|not there|lost"
            r"|unavailable|not available),? )(?=\w)"
        ),
        r"\1, otherwise ",
    ),
    (
        (
            r"\b(?:in case|provided|given|assuming|supposing|suppose|on condition|as long as|so long as|only if"
            "|if and only if|if it (?:turns out|happens)|if it is (?:true|the case))(?: that"
            r"| of)?\b(?= (?:there|the|it|a|you|i|any|\w+ (?:is|are)))"
        ),
        "if",
    ),
    (r"\bin the event (?:that|of)\b", "if"),
    (
        (
            r"(^|[.,;] )(?:when|whenever|once) (?=(?:there (?:is|are)|the [\w ]+ (?:is|are) (?:in|on|at|open"
            r"|closed|there)|\w+ is in )\b)"
        ),
        r"\1if ",
    ),
    (r"^should (there|the [\w ]+?|\w+) be (.+?),", r"if \1 is \2,"),
    (
        (
            r"\bif there (?:is|are) (?:still )?(?:any|some|one|a few|such a thing)(?: left| around| there| to be"
            r" had)?"
            r"(?=$|[.!?,]| or else| otherwise)"
        ),
        "",
    ),
    (r"\bgo to (the [\w ]+?) if (\w+|the [\w ]+?) is there\b", r"go to \1 if \2 is in \1"),
    (
        (
            "[,;.]? (?:otherwise|or else|else|if not),? (?:do nothing|nothing|leave it(?: there| alone)?"
            "|do not bother|do not do anything|stay(?: where you are| here| put)?|forget it|just wait)(?=$"
            "|[.!])"
        ),
        "",
    ),
    (r"\b(is|are) (not )?(?:locked|shut)\b", r"\1 \2closed"),
    (
        (
            "^(?:please )?(?:go (?:and )?)?(?:check|see|look|find out|tell me) (?:if|whether) (.+?)(?:[.,;?]"
            "| and)+ (?:and )?(?:if so|if yes|if it is|if they are|if (?:he|she) is|then|in that case"
            "|if there (?:is|are))[,:]? "
        ),
        r"if \1, ",
    ),
    (
        (
            "^(?:please )?(?:go (?:and )?)?(?:check|see|look|find out|tell me) (?:if|whether) (.+?)(?:[.,;?]"
            "| and)+ (?:and )?(?:if not|otherwise|if it is not|if there is none)[,:]? "
        ),
        r"unless \1, ",
    ),
    (r"\bif there (?:is|are) (?:still |some |any |at least one )(?:still |some |any |an? )*", "if there is a "),
    (r"\bif (?:nobody|no one|no person|noone) is (?=(?:in|at)\b)", "if there is no person "),
    (r"\bif (?:anyone|anybody|someone|somebody) is (?=(?:in|at)\b)", "if there is a person "),
    (r"\bif not[,:]? then\b", "otherwise"),
    (
        (
            r"\b(?:but )?if (?:it|that|this|he|she) (?:is not|is not so|does not|are not)(?=,| (?:go|bring|put"
            "|take|come))"
        ),
        "otherwise",
    ),
    (
        (
            r"\b(?:and )?if (?:there is not|there are not|there is none|none|nothing is there|it is not there"
            "|not so|they are not)(?: (?:any|one|there))?(?=,| (?:go|bring|put|take|come))"
        ),
        "otherwise",
    ),
    (r"\? (?:if so|if yes|in that case|then|if it is|if there (?:is|are)|if that is so|when so)[,:]? ", "? if so, "),
    (r"\bif not,? (?=(?:go|bring|put|take|come|get|drive|fetch|return|wait|pick)\b)", "otherwise "),
)
"""In the order in which they are tried."""
