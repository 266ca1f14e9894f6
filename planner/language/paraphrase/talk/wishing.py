"""Idioms of wanting something, and of saying what for: *I could murder an apple*, *I'd like to read it*."""

from __future__ import annotations

_USES = (
    r"(?:have|read|use|eat|drink|see|look at|hold|borrow|try|get|wear|check|drink from|write with|play with|sit with|"
    r"take|enjoy|keep|work with|draw with|study|watch|taste|finish)"
)

_ANYBODY = r"((?!i\b|we\b|you\b|it\b|that\b|this\b|what\b|who\b|which\b|where\b|if\b|nobody\b)[a-z]+(?: [a-z]+)??)"
_SENDING = (
    r"[,.;!]* (?:so |and |please |can you |could you |then |now )*(?:bring|get|give|fetch|hand|pass|grab)(?: me)?"
    r" (?:it|them|that|one)(?: to me| over here| here| over| for me)*(?: please| now)?(?=[.!?]*$)"
)
_INTENDS = (
    r"(?:(?:am|is|are|was|were) (?:just |only |actually )?(?:going|about|meaning|planning|hoping|trying|supposed"
    r"|meant|wanting|intending|due) to"
    r"|(?:have |has |had )?(?:planned|meant|hoped|intended|wanted|decided|promised|wished)(?: to)?"
    r"|would (?:rather|like to|love to|prefer to)|wants? to|needs? to|have to|has to|must|wish(?:es)? to"
    r"|feels? like|fancy|fancies|was about to)"
)

_HANDED = r"(?:handed|brought|given|delivered|carried|passed|taken|fetched|sent|served)"

WISHING: tuple[tuple[str, str], ...] = (
    (
        r"\b(to|for) [^,.;]+?, (?:and )?(?:which|that|who|this) (?:is|would be) me(?=[.!]*$)",
        r"\1 me",
    ),
    (
        (
            r"(?<=\w)[,.;]* (?:and |but )*(?:no,? )?(?:they|it|these|those|that|this) (?:are|is) not (?:all )?for "
            r"(?:me|us)(?=[.!]*$)"
        ),
        "",
    ),
    (
        (r"(?<=\w)[.,;!]+ (?:so |and )?you know (?:what to do|the drill|how it goes|the rest|what i mean)(?=[.!]*$)"),
        "",
    ),
    (
        (
            r"^(?:the )?[\w' ]+? (?:in|at|on) ([\w ]+?) (?:asks|wants|would like|needs|wishes|asked|requests)(?: you)?"
            r"(?: to have)? ((?:the|an?|some|his|her|both|all) [^,.;]+?) from there(?: to be)? "
            rf"{_HANDED} to (?!him\b|her\b|them\b)([^,.;]+?)(?=[.!]*$)"
        ),
        r"bring \2 from \1 to \3",
    ),
    (
        (
            r"^(?:the )?[\w' ]+? (?:asks|wants|would like|needs|wishes|asked|requests)(?: you)?(?: to have)? "
            r"((?:the|an?|some|both|all) [^,.;]+?)(?: to be)? "
            rf"{_HANDED} to (?!him\b|her\b|them\b|me\b|us\b)([^,.;]+?)(?=[.!]*$)"
        ),
        r"bring \1 to \2",
    ),
    (
        (
            r"\b((?:wants|needs|would like|would love|asks for|asked for|wishes|expects)(?: to have)? (?:the"
            r"|an?|some|his"
            rf"|her|my|two|both|all) [^,.;]+?) {_HANDED}(?: over| up| down| along)?(?: to (?:him|her|them))?(?=[.!]*$)"
        ),
        r"\1",
    ),
    (
        (
            r"^the (?:man|woman|person|guy|lady|boy|girl|one|patient|visitor|guest|kid|child|gentleman)"
            r" ((?:in|at|on|by) "
            r"(?:the |my |our )?[\w ]+?) (?:would like|wants|needs|asks for|asked for|would love|is waiting"
            r" for|could use"
            r"|requests|could do with|ordered) (?:his|her|their|the) ([^,.;]+?)(?=[.!]*$)"
        ),
        r"bring the \2 to the person \1",
    ),
    (
        (
            r"^((?:[a-z]+ )?[a-z]+) (?:is missing|has lost|lost|needs|wants|can not find|is looking for|forgot"
            r"|has forgotten|could use) ((?:the|his|her|an?|some) [^,.;]+?)[,.;]+ (?:so |please |and )*(?:take|bring"
            r"|carry|give|get) (?:those|the ones?|them|it|that one|one) ((?:from|in|on|at|out of) [^,.;]+?) to "
            r"(?:her|him|them)(?=[.!]*$)"
        ),
        r"bring \2 \3 to \1",
    ),
    (
        (
            r"^((?:any|one|either|an?|some)(?: one)?(?: of (?:the|my|those|these))? [^,.;?]+?) (?:would|will|should) do"
            r"(?: nicely| just fine| fine)?(?: for me| for now| please| now)*(?=[.!]*$)"
        ),
        r"i want \1",
    ),
    (
        (
            r"\b(i (?:want|need|would like|would love) (?:one|two|three|all|both|the|an?|my|some|his|her)"
            r" [^,.;]+?) (?:laid"
            r"|put|placed|stood|stored|stowed|moved|dropped|deposited|set down|laid out)(?: down| over)? "
            r"(?=(?:on|in|at|by|next to|into|onto|to|near) )"
        ),
        r"\1 ",
    ),
    (
        r"\bhere (?:with|beside|next to|by) (?:me|us)\b",
        "here",
    ),
    (
        (
            r"^(?:please )?show (?!me\b|us\b)((?:[a-z]+ )??[a-z]+) ((?:the|my|his|her|an?) [^,.;]+?)(?:[,.;]| and)+ "
            r"(?:please |so |and )*(?:take|bring|carry) (?:it|them) to (?:her|him|them)(?=[.!]*$)"
        ),
        r"take \2 to \1",
    ),
    (
        (
            r"^it would be (?:\w+ )?(?:lovely|nice|great|good|wonderful|perfect|kind|splendid) to have (?=(?:the|my"
            r"|an?|some|two"
            r"|that)\b)"
        ),
        "i want ",
    ),
    (
        (
            r"\b(?:i|we) (?:could (?:really |just |so )?(?:murder|eat|drink|go for|do with|use|kill for|handle|manage)|"
            r"(?:am|are) (?:gasping|dying|longing|desperate|craving|itching|yearning|keen)(?: for| on| to have)?|"
            r"would not (?:say no to|mind|object to|refuse)|feel like(?: having)?|(?:am|are) in "
            r"(?:the mood|need) (?:for|of)|"
            r"would (?:really |just )?(?:kill|die) for|have a craving for|(?:really |just |only )+(?:want|need|fancy))"
            r" (?=(?:an?|the|some|one|my|that|two|another)\b)"
        ),
        "i want ",
    ),
    (
        (
            rf"\b(?:i|we) (?:would (?:like|love)|want|need|wish|am going|are going|am about"
            rf"|have) to {_USES} (it|them|that|those)\b"
        ),
        r"bring me \1",
    ),
    (
        (
            r"^(?:please )?(?:i|we) (?:would (?:like|love|prefer)|want|wish|am going|feel like|am keen) (?:to )?"
            r"(?:(?:have|take) a (?:\w+ )?look at|have|read|use|eat|drink|look at|hold|borrow|try|reading|eating|"
            r"drinking|using|see|inspect|taste|wear) "
            r"((?:the|my|our|an?|some|that|this) (?!way\b|room\b|time\b)[^,.;!?]+?)(?: now| please| a bit| for a "
            r"while)*(?=[.!]*$)"
        ),
        r"bring me \1",
    ),
    (
        (
            rf"^(the [^.;!?]+?)[,;] (?:could|can|may|might) (?:i|we) (?:please )?{_USES} (?:it|them)"
            rf"(?: please)?(?=[.!?]*$)"
        ),
        r"bring me \1",
    ),
    (rf"\b(?:could|can|may|might) (?:i|we) (?:please )?{_USES} (it|them)(?: please)?(?=$|[.!?,])", r"bring me \1"),
    (r"\b(\w+) (?:fancies|craves|desires|requests|demands|is (?:gasping|dying|craving|desperate) for) ", r"\1 wants "),
    (r"\b(\w+) (?:has been|is|was) (?:asking|begging|longing|clamou?ring) for (?!you\b|me\b|us\b)", r"\1 wants "),
    (
        (
            r"\b(?:a|an|the|one|some|two|another) ([^,.;!?]+?) (?:would be (?:splendid|great|lovely"
            r"|nice|perfect|good|super|"
            r"wonderful|fantastic|much appreciated|welcome|appreciated|awesome|ideal|brilliant|just the thing)"
            r"|would (?:hit the spot|go down (?:well|a treat)|do nicely|not go amiss))(?:[,]? (?:now"
            r"|please|thanks))*(?=$|[.!?])"
        ),
        r"i want a \1",
    ),
    (
        (
            r"^(?!nobody|noone|who|what|never|not|if|when)(?:mum|mom|dad|mother|father|granny|grandma"
            r"|grandpa|\w+) (?:says|said|asks|wants|told me"
            r"|tells me)(?: that| to tell you)?"
            r"(?: you)?(?: should| must| are| need| have)?(?: please)?(?: to)?:? (?=(?:bring|take|put"
            r"|go|fetch|get|carry|move|give|find|come|pick)\b)"
        ),
        "",
    ),
    (
        (
            rf"^(?:i|we) (?:would )?{_INTENDS} "
            rf"[a-z]+(?: (?:with|at|on|from|in|for))? ((?:the|my|an?|some|our|that) [^,.;!?]+?){_SENDING}"
        ),
        r"bring me \1",
    ),
    (
        (
            rf"^(?:i|we|he|she|they|somebody|someone) (?:would )?{_INTENDS} [a-z]+(?: (?:with|at|on|from|in|for))? "
            r"((?:the|my|our|that) [^,.;!?]+?)[,.;!]+ (?:so |and |please |can you |could you |then |now )*"
            r"(?=(?:put|take|bring|carry|move|leave|return|place|get|give|fetch|hand)\b[^,.;!?]* (?:it|them|that)\b)"
        ),
        r"\1, ",
    ),
    (
        (
            rf"^{_ANYBODY} (?:can not|could not|will not|never) [a-z]+(?: [a-z]+)? (?:without|unless "
            rf"(?:he|she) (?:has|gets)) "
            rf"(?=(?:the|his|her|an?|some|their|that)\b)"
        ),
        r"\1 wants ",
    ),
    (
        r"^(?:i|we) (?:can not|could not|will not|never) [a-z]+(?: [a-z]+)? without (?=(?:the|my|our|an?|some)\b)",
        "i want ",
    ),
    (
        (
            rf"\b{_ANYBODY} (?:would|will|could) (?:really |so |very much |certainly |also )*(?:appreciate|"
            rf"enjoy|welcome|fancy|"
            rf"be (?:happy|glad|grateful|pleased|delighted|thankful) (?:about|with|of|for|to (?:have|"
            rf"get))|benefit from|do with) "
        ),
        r"\1 wants ",
    ),
    (
        rf"\b{_ANYBODY} (?:says|said|tells me|told me)(?: that)? (?:he|she) (?:wants|needs|would like|wanted|needed) ",
        r"\1 wants ",
    ),
    (
        r"\b(?:might|may|could|can) (?:i|we) (?:please )?(?:trouble|bother|ask|pester|beg|bug) you for ",
        "can i have ",
    ),
    (r"^(?:is there )?any chance (?:of|for)(?: getting| having)? (?=(?:an?|the|some|my)\b)", "can i have "),
    (r"^(?:has )?any ?(?:one|body) (?:got|have|has) (?=(?:an?|the|some|my)\b)", "is there "),
    (r"\b(?:how about|what about) (?:bringing|fetching|getting|giving) ", "bring "),
    (r"\b(?:how about|what about) (?:taking|putting|moving|carrying) ", "put "),
)
"""In the order in which they are tried."""
