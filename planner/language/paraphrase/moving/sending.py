"""Who sends the robot where without a *go*: *Anna is calling you*, *I'll meet you in the hall*, *out on the "
"terrace*.
"""

from __future__ import annotations

_WHO = r"((?!(?:i|we|it|that|this|what|who|if|when|nobody|someone|somebody|they|he|she|you)\b)[a-z]+(?: [a-z]+)??)"
_ANYONE = r"(?:they|he|she|everyone|everybody|people|(?!(?:i|it|that|this|what|who|you|robot)\b)[a-z]+(?: [a-z]+)??)"
_WAY = r"(?:(?:over|up|down|out|back|across|round|along|through|there) )*"
_AT = r"(?=(?:in|at|by|near|on|next to|beside|outside) (?:the|my|our|his|her|room|ward|office|classroom|\w+))"
_START = r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou ))"
_SOON = (
    r"(?: in (?:a (?:sec|second|minute|moment|bit|while|jiffy|flash|few minutes)|no time|(?:one|two|five|ten) minutes)"
    r"| soon| shortly| quickly| later| today| tonight| now| then)*"
)

SENDING: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:i|we) (?:need|want|could (?:use|do with)|would like) your (?:help|assistance|company|presence"
            r"|support)"
            r"(?: over| down| up| here)* (?=(?:in|at|by|on|near) )"
        ),
        "go ",
    ),
    (
        (
            r"^(?:everyone|everybody|we|they|the others|the (?:kids|children|guests)) (?:is|are) (?:all |already "
            r"|waiting )*"
            r"((?:in|at|on|by) [^,.;]+?)[,.;]+ (?:so |and |please )*(?:go (?:and )?)?(?:join (?:them|us)|come(?: too"
            r"| along| over)?"
            r"|go there|go too)(?=[.!]*$)"
        ),
        r"go \1",
    ),
    (
        (
            r"^i (?:heard|saw|noticed|smell|smelled) (?:an?|some) (?:\w+ )?(?:noise|sound|bang|crash|voice|voices"
            r"|light|smoke|shadow)"
            r" (?:coming )?(?:from|in|at|on|by|near) ([^,.;]+?)[,.;]+ (?:so |and |please |can you )*(?:go "
            r"(?:and )?)?(?:have a"
            r" look|take a look|check|look|see)(?: there| what it is| please)*(?=[.!?]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            r"^(?:what is (?=\w+ (?:up|do))|how is (?=\w+ ?[a-z]*\?)|where is (?=\w+\? go (?:to|and see|and "
            r"meet)))(\w+)(?: up to"
            r"| doing| getting on)?[?,.;]+ (?:please )?(?:go (?:and )?|can you )(?:check|see|look|find out)(?: "
            r"please)?(?=[.!?]*$)"
        ),
        r"go to \1",
    ),
    (r"^(?:it is )?(?:lunch|dinner|supper|breakfast|tea|bed|play|break|story|party) ?time[,.!:;]+ (?=\w)", ""),
    (
        (
            r"^(?:an? |there is an? )?(?:emergency|accident|alarm|problem|fire|trouble) (?=(?:in|at|on|by) "
            r")([^,.;!]+?)[,.;!]+ "
            r"(?:so |please )*(?:go|hurry|quick|quickly|run|go there|get there)(?: now| quickly)?(?=[.!]*$)"
        ),
        r"go \1",
    ),
    (
        (
            r"\b([^\W\d]+)'s (?=(?:lonely|waiting|expecting|hoping|sad|bored|scared|alone|crying|upset|happy|afraid"
            r"|cold|hot|late|hurt|awake"
            r"|up|back"
            r"|poorly|unwell|feeling|starving|freezing|exhausted|worried|nervous)\b)"
        ),
        r"\1 is ",
    ),
    (
        (
            r"^there (?:is|are) (?:someone|somebody|people|an? (?:\w+ )?(?:visitor|guest|man|woman|child|kid"
            r"|customer|patient|stranger"
            r"|person)|(?:visitors|guests|kids|children|customers|patients)) (?=(?:in|at|by|on|near"
            r"|outside)\b)([^,.;]+?)[,.;]+ (?:so "
            r"|and |please |can you |could you )*(?:go|drive|head|pop|run)(?: over| on over)? (?:there|to (?:him|her"
            r"|them)|and (?:see"
            r"|meet|greet|help|welcome)[^,.;]*|see[^,.;]*)(?=[.!?]*$)"
        ),
        r"go \1",
    ),
    (rf"{_START}get (?:yourself )?{_WAY}(?:in)?to (?=(?:the|my|our|\w+'s|room|ward|office|classroom)\b)", "go to "),
    (rf"{_START}park(?: yourself| up)? (?=(?:next to|beside|by|near|at|in(?! front)) )", "go "),
    (
        (
            r"(?<=\w)[,;.!]+ (?:because )?you are (?:in (?:the|my|our|his|her) way|standing in (?:the|my|our) way|late"
            r"|blocking [\w' ]+|not needed (?:here|there)|needed there|too close|too slow)(?=[.!]*$)"
        ),
        "",
    ),
    (
        (
            rf"^(?:i|we|[a-z]+) (?:will|shall|would like to|want to|am going to|are going to) (?:meet|see|join|find"
            rf"|catch) you {_WAY}{_AT}([^,.;!?]+?){_SOON}(?=[.!]*$)"
        ),
        r"go \1",
    ),
    (
        (
            rf"^{_WHO} (?:is|are|keeps|has been) (?:calling|shouting|yelling|looking|asking|waiting|crying|hoping)"
            r"(?: out)?(?: for)? you(?: again| now| please)*(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            rf"^{_WHO} (?:would (?:like|love|enjoy)|wants|needs|could (?:do with|use)) (?:some |a bit of |your )?"
            r"company(?: now| please| tonight)*(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            rf"^{_ANYONE} (?:is|are) (?:expecting|waiting for|looking for|asking for|awaiting) you {_WAY}{_AT}"
            rf"([^,.;!?]+?){_SOON}(?=[.!]*$)"
        ),
        r"go \1",
    ),
    (
        (
            r"^there (?:is|are) (?:someone|somebody|people|a (?:visitor|guest|man|woman|child|kid|customer|patient"
            r"|stranger)"
            r"|(?:visitors|guests|kids|children|customers|patients))\b[^,.;]*[,.;]+ (?:so |and |please |can you )*"
            r"(?=(?:go|come|drive|bring|take|head|get|put|fetch|give|find)\b)"
        ),
        "",
    ),
    (rf"^(?:and |now |then |just )*(?:over|up|down|out|across) {_AT}(?![^.]* with )(?=[^,.;!?]+[.!]*$)", "go "),
    (r"\btake (?:up )?(?:a |your )(?:position|post|stand|station) (?=(?:beside|next to|by|near|at|in)\b)", "wait "),
    (
        (
            rf"^(?:i|we) (?:need|want|would (?:like|love)|expect) you {_WAY}(?:to be |to come |to go |to wait )?{_WAY}"
            r"(?=(?:in|at|by|near|next to|on|outside) )"
        ),
        "go ",
    ),
    (rf"{_START}(go|come|drive|head|move|get|run) {_WAY}(?:to )?where (?!you\b|we\b|it\b|they\b)", r"\1 to where "),
    (r"\b(head|make) (?:straight|right|directly|quickly|now|off|out|over) for (?=\w)", r"\1 for "),
    (
        (
            r"(?<=\w)(?:,| and|, and) (?:have a |take a )?(?:quick |good )?look (?:a)?round(?: there| a bit| for a "
            r"bit| quickly"
            r"| briefly| for a moment)*(?=(?:,| and|, and| then)+ (?:then )?(?:come|go|get|drive|return|head|back"
            r"|be)\b)"
        ),
        "",
    ),
    (r"\bpay (\w+|(?:the|my|our) [\w ]+?) a (?:short |quick |little |brief |flying )?(?:visit|call)\b", r"visit \1"),
    (
        (
            r"\b(?:go |drive |run )?(?:and )?(?:see|check|look) (?:if|whether|how|that) (\w+(?: \w+)?) (?:is|are) "
            r"(?:ok|okay|fine"
            r"|well|alright|all right|doing|getting on|feeling|safe|awake|comfortable)(?: (?:and|or) \w+)?"
            r"(?=,? (?:and|then) (?:then )?(?:come|go|return|be|get)\b)"
        ),
        r"go to \1",
    ),
    (
        (
            r"(?:,| and|, and| then)+ (?:then )?(?:be|get|hurry) (?:right |straight )?back(?: here| with me| to me| "
            r"home)?"
            rf"{_SOON}(?: before [^,.;]+)?(?=[.!]*$)"
        ),
        ", then come back",
    ),
    (
        (
            r"\b(?:make|take|do) (?:a|your|one|the) (?:\w+ )?(?:detour|swing|run|trip|tour|loop|lap|round) "
            r"(?:through|via|past|by way "
            r"of|round) "
        ),
        "go to ",
    ),
    (
        (
            r"(?<=\w)[,;.!]+ (?:and )?(?:hurry|be quick|make it quick|quickly|off you go|quick march|do hurry)"
            r"(?: up| now| please| about it)*(?=[.!]*$)"
        ),
        "",
    ),
    (
        (
            r"^(?:i would (?:rather|prefer it if|like it if|love it if)|i wish|it would be (?:better|best|nice|good) "
            r"if) you (?:were|went"
            rf"|stayed|waited|stood|would be|would go) {_WAY}{_AT}"
        ),
        "go ",
    ),
    (
        (
            r"\b(?:leave|get out of|exit|quit|vacate) (?:this (?:room|place)|here|the [\w ]+?)(?:,| and|, and|,? "
            r"then)+ (?:then )?"
            r"(?=(?:go|come|drive|head|move)\b)"
        ),
        "",
    ),
    (r"\bcome (?:along |over )?with (?:me|us) (?:over |down |up )?(?:in)?to (?=\w)", "go to "),
    (
        (
            r"\b(?:take|have|go for) a (?:\w+ )?(?:wander|potter|amble|ramble|roam|saunter)(?: over| down| up| "
            r"along)* (?:in)?to "
        ),
        "go to ",
    ),
    (r"\b(?:how|what) about (?:you )?(?:going|heading|driving|moving|coming) (?=\w)", "go "),
    (
        (
            r"^why (?:do not you|do you not|not) (?=(?:go|come|drive|head|bring|take|put|get|fetch|give|carry|move"
            r"|return)\b)"
        ),
        "",
    ),
    (
        (
            r"^you (?:might|may|could|had better|would better|ought to|are to|will|shall)(?: perhaps| maybe)? "
            r"(?:want to |wish to "
            r"|like to |have to |now )*(?=(?:go|come|drive|head|bring|take|put|get|fetch|give|carry|move|return"
            r"|report|proceed)\b)"
        ),
        "",
    ),
    (
        (
            rf"^{_WHO} (?:is|has been) (?:asking|looking|waiting|calling|hoping)(?: for you)?,? ((?:in|at|by|on) "
            rf"(?:the|my|\w+'s|room|ward"
            rf"|office) ?[\w' ]*?)"
            r"(?:[,.;!]+ (?:so )?(?:off you go|go|hurry))?(?=[.!]*$)"
        ),
        r"go to \1 \2",
    ),
    (rf"^(?:please )?(?:go (?:and )?)?(?:meet|join|catch) (?!me\b|us\b)(\w+) {_AT}", r"go to \1 "),
    (rf"^{_WHO} (?:expects|awaits|is expecting|is awaiting) you(?: now| soon)?(?=[.!]*$)", r"go to \1"),
    (
        (
            rf"^{_WHO} (?:needs|wants|could use|would like|requests|requires|is asking for|asks for) your "
            rf"(?:presence|company|help"
            r"|assistance|attention)(?: now| please)?( (?:in|at|by|on) [^,.;]+?)?(?=[.!]*$)"
        ),
        r"go to \1\2",
    ),
    (
        (
            r"\b(?:go |run |drive |pop )?(?:and |over )?(?:see|check|look|find out) (?:how|what) (\w+) is (?:doing"
            r"|up to|getting on|at)"
            r"(?=,? (?:and|then) (?:then )?(?:come|go|return|be|get)\b)"
        ),
        r"go to \1",
    ),
    (
        (
            r"^first(?: of all)?,? (?:to )?((?:the |my )?(?!go\b|come\b|the\b)\w+(?: room| office| \d+)?),? (?:and "
            r")?then "
            r"(?=(?:come|go|return|back|drive)\b)"
        ),
        r"go to \1, then ",
    ),
    (
        (
            r"(?:,| and|, and| then)+ (?:wait|stay|stop|pause|linger|rest)(?: there)?(?: for)? (?:a (?:\w+ "
            r")?(?:moment|minute|second"
            r"|bit|while|sec)|\w+ (?:seconds|minutes))(?: there)?(?=(?:,| and|, and| then)+ (?:then )?(?:come|go"
            r"|return|back|drive|get)\b)"
        ),
        ", wait there",
    ),
    (
        (
            r"\b(come|get|be|drive|head|go) (?:straight |right )?back(?: here)? to (?:tell|inform|report to|let) "
            r"(?:me|us)(?: know)?"
            r"(?: about (?:it|that)| (?:what|who|if|whether|how) [^,.;!?]+)?(?=[.!]*$)"
        ),
        r"\1 back to me",
    ),
    (r"\bcheck (?:on |out |up on )?(?=(?:room|ward|office|classroom|meeting room) \w+)", "go to "),
    (r"\b(go|drive|head|move|come) (?:over |up |down )?there,? to (?=(?:the|my|our)\b)", r"\1 to "),
    (
        (
            r"\bgo (?:and )?(?:hang (?:out|around|about)|sit(?: down)?|lounge|rest|chill|relax) (?=(?:in|at|by|near"
            r"|next to|on"
            r"|beside) )"
        ),
        "go ",
    ),
    (r"^(?:and |now )*(?:back|away|off)(?: (?:off|over|down|up|you go|with you))+ (?:in)?to (?=\w)", "go to "),
    (r"^you are (?:supposed|meant|expected|required|requested|asked) to (?=\w)", ""),
    (
        r"^(?:the )?([\w' ]+?) is where you are (?:needed|wanted|expected|required|supposed to be)(?: now)?(?=[.!]*$)",
        r"go to the \1",
    ),
    (r",? without (?:any )?(?:further )?(?:delay|ado|hesitation|hesitating|dawdling)\b,?", ""),
    (
        (r"\btake the (?:route|way|path|road) (?:through|via|past|by way of) ([\w' ]+?) to (?=\w)"),
        r"go to \1, then go to ",
    ),
    (r"^see (?:if|whether) you can (?:get|make it|go|drive|come|make your way) (?:in)?to ", "go to "),
    (r"\bpick ((?:the|my|his|her|that) [\w ]+?) up (?:off|from|out of) (?=\w)", r"pick up \1 from "),
    (r"^first things first[:,.!]* (?=\w)", ""),
    (
        (
            r"(?:,| and|, and| then)+ (?:then )?(?:come|get|return|be) (?:straight |right )?back(?: here| to me)? with "
            r"((?:the|my|some|an?|his|her) [\w' ]+?)(?=[.!]*$)"
        ),
        r", then bring me \1",
    ),
    (
        (
            r"(?:,|\.|;)?(?: and)? (?:tell|let|inform) me(?: know)?,? (?:when|once|if|after|as soon as) (?:you are "
            r"(?:done|finished"
            r"|there|back|ready)|(?:it|that) is done|you have (?:done|finished)(?: it| that)?|everything is "
            r"done)(?=[.!]*$)"
        ),
        "",
    ),
)
"""In the order in which they are tried."""
