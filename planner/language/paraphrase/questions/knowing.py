"""Questions as people bend them: *you haven't seen my glasses, have you*, *any milk left*, *enough cups for six*."""

from __future__ import annotations

_NUMBER = r"(?:one|two|three|four|five|six|seven|eight|nine|ten|\d+)"
_THING = r"((?:the|my|our|his|her|that|those|these|\w+'s) [^,.;?!]+?)"

KNOWING: tuple[tuple[str, str], ...] = (
    (r"^whereabouts (?=(?:is|are|do|does|can|did|could)\b)", "where "),
    (
        (
            r"^where (?:tf|the f\w*|the heck|the devil|the blazes|in (?:god|heaven)'s name|in the name of god|on "
            r"this earth"
            r"|the bloody hell) (?=(?:is|are|did|do|have|has)\b)"
        ),
        "where ",
    ),
    (
        (
            r"^(where (?:is|are)|where did i (?:put|leave)|find|have you seen) me (?=(?!a\b|the\b"
            r"|my\b)\w+[?.!]*$)"
        ),
        r"\1 my ",
    ),
    (
        (
            r"^(?:have you (?:got )?|do you have |you have |you got |got |has anyone |(?:does )?anyone have "
            r")?(?:any|an|some|the"
            r"|the slightest|the faintest) (?:idea|clue|inkling|notion|hunch|thought)s?(?: at all)?(?: (?:of"
            r"|about|on|as to))? "
            r"(?=(?:where|what|which|who|how|if|whether)\b)"
        ),
        "tell me ",
    ),
    (
        (
            rf"^(?:have you (?:got )?|do you have )?any (?:idea|clue|information|news|word|thoughts?) (?:about|on"
            rf"|of|as to"
            rf"|regarding) {_THING}(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            rf"^you (?:have not|did not|have never)(?: happen(?:ed)? to)? (?:see|seen|come across|noticed?|spot"
            rf"|spotted)"
            rf" {_THING}(?:,? (?:have|did) you)?(?=[?.!]*$)"
        ),
        r"have you seen \1",
    ),
    (
        (
            rf"^(?:has|did|have) (?:anyone|anybody|someone|somebody) (?:moved?|taken?|took|touch(?:ed)?"
            rf"|use[d]?|hidden|hide"
            rf"|borrow(?:ed)?|steal|stolen|nicked|pinched|swiped|misplaced?) {_THING}(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            rf"^who (?:moved|touched|used|hid|borrowed|stole|nicked|pinched|swiped|misplaced|has taken|has moved"
            rf"|has hidden)"
            rf" {_THING}(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            rf"^(?:is|are) {_THING} (?:still )?where (?:i|we|you) (?:left|put|saw|had|dropped) (?:it"
            rf"|them)(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^(?:is|are) ((?!there\b)[\w ]+?) (?:at home|home|in|around|about|here|here somewhere|in today|on "
            r"site)(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (r"^whose (\w+(?: \w+)?) (is|are) (?=(?:in|on|at|next|under|by|near|that|this|the)\b)", r"which \1 \2 "),
    (
        (
            r"^how many (?:different )?colou?rs(?: of)? ([\w ]+?)(?: (?:do we have|are there|have we got|do you "
            r"(?:see|know)"
            r"|exist|can you see))(?=[?.!]*$)"
        ),
        r"what color is \1",
    ),
    (
        (
            r"^how many (people|persons|men|women|kids|children) (?:live|stay|work|are living|are "
            r"staying)(?: in)? (?:here|there|this house)(?=[?.!]*$)"
        ),
        r"how many \1 are there",
    ),
    (
        (
            r"^(?:what is|tell me|say|give me) the (?:total |overall |exact )*(?:number|amount|count"
            r"|total)(?: number)? of "
        ),
        "how many ",
    ),
    (
        (
            rf"^(?:is|are) there (?:only|just|exactly|merely) {_NUMBER} ((?:\w+ )*?\w+?)s?((?: (?:in|on|at) "
            rf"[^?]+?)?)(?=[?.!]*$)"
        ),
        r"how many \1s are there\2",
    ),
    (
        (
            rf"^(?:is there|are there|do we have|have we got|do you have|have you got) enough ([\w ]+?) for ({_NUMBER})"
            rf"(?: (?:people|persons|guests|of us|kids|children|visitors))?((?: (?:in|on|at) [^?]+?)?)(?=[?.!]*$)"
        ),
        r"is there at least \2 \1\3",
    ),
    (
        (
            r"^(?:what|which things?|is there anything|is there something|anything) (?:is there|can i|can we"
            r"|could i|could we|do"
            r" we have|have we got|do you have)? ?(?:that )?(?:i can |we can )?(?:to )?read(?: here| (in|on|at) "
            r"([^?]+?))?(?=[?.!]*$)"
        ),
        r"which reading matter is there \1 \2",
    ),
    (
        (
            r"^(?:what|which things?) (?:can|could|may) (?:i|we) (?:eat|snack on|have)(?: for \w+)? (?:here|(in|on"
            r"|at) ([^?]+?))(?=[?.!]*$)"
        ),
        r"which food is there \1 \2",
    ),
    (
        r"^(?:what|which things?) (?:can|could|may) (?:i|we) drink (?:here|(in|on|at) ([^?]+?))(?=[?.!]*$)",
        r"which drinks are there \1 \2",
    ),
    (
        (
            r"^(?:what|anything) (?:can|could|do) you (?:tell me|know|say|remember)(?: anything| something| "
            r"more)? about "
            r"(?=(?:the|my|our|this|\w+'s) )"
        ),
        "describe ",
    ),
    (
        (
            r"^(?:tell me|say) (?:something|anything|more|everything|all|a bit|a little)(?: more| you know)* "
            r"about (?=(?:the|my|our|this) )"
        ),
        "describe ",
    ),
    (
        (
            r"^what (?:size|are the dimensions|is the size|is the height|is the width|is the length)(?: of| "
            r"is| are) "
        ),
        "how big is ",
    ),
    (r"^how (?:tall|high|deep|thick|small|huge|broad) (is|are) ", r"how big \1 "),
    (
        (
            rf"^(?:has|does|do|have) ((?:the|my|our) [\w ]+?) (?:have|got|contain|hold)(?: got)? ((?:{_NUMBER}|at "
            rf"least {_NUMBER}"
            rf"|more than {_NUMBER}|no|many) .+?)(?=[?.!]*$)"
        ),
        r"is there \2 in \1",
    ),
    (r"^any ([\w ]+?)(?: left| around| anywhere| remaining| about)+(?=[?.!]*$)", r"is there any \1"),
    (r"^any ((?!of\b|idea\b|one\b|will\b)[\w ]+?)(?=[?]+$)", r"is there any \1"),
    (
        (
            r"^(?:we|you) (?:have |still have )?(?:got|have) (?:any |some )?((?!to\b)[\w ]+?)(?: "
            r"left)?(?=[?]+$)"
        ),
        r"is there any \1",
    ),
)
"""Before the rules of ``INQUIRING``."""
