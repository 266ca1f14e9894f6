"""Shapes of questions, by what they ask for: *the piano is in which room*, *is the ball blue or red*."""

from __future__ import annotations

_NOW = r"(?: (?:now|right now|at the moment|currently|these days|lately|today|here|exactly|then|please|again|at))*"
_COLOR = r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange|gold|silver|cyan|beige|turquoise)"

SHAPES: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:are|is) there as (?:many|much) ([\w ]+?) (?:in|on|at|under) ([\w' ]+?) as (?:there (?:is|are) )?"
            r"(?:in|on|at|under) ([^?]+?)(?=[?.!]*$)"
        ),
        r"what has more \1, \2 or \3",
    ),
    (
        (
            r"^who (?:has(?! more| fewer| less| most| the most)|is got|has got|took|is holding|is carrying|had) "
            r"([^?]+?)(?= ?[?.!]|$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^(?:and |but |so |well |now )*(?:tell|show|inform|remind|let) (?:me|us|an? [\w ]+?|"
            r"(?:your|my|our) \w+|\w+)(?: know)?,? (?=(?:where|which room|in which)\b)"
        ),
        "tell me ",
    ),
    (
        (
            r"^(?:could|can|would|will) (?:you|anyone|somebody|someone) (?:please |kindly |maybe )*"
            r"(?:tell|show|inform|remind) (?:me|us|an? [\w ]+?|your \w+|\w+),? (?=(?:where|what|which"
            r"|who|how|if|whether|in which)\b)"
        ),
        "tell me ",
    ),
    (
        (
            rf"^(?:tell me )?(?:where|in which room|which room|in what room) (?:(?:can|could|do|might"
            rf"|may|would|should|will) (?:one|i|we|you|someone|a person|anyone|people)|(?:one|i|we|you"
            rf"|someone|people) (?:can|could|might|may|would|should|will))(?: \w+ly)? "
            rf"(?:find|get|see|borrow|grab|pick up|fetch|have|look for|locate|collect|obtain|reach"
            rf"|go for|expect|search for|lay (?:my|your|our) hands on|come across|spot) (?:a pair of "
            rf"|a couple of |some )?([^,.;?!]+?){_NOW}(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            rf"^(?:tell me )?where (?:did|does|do|could|can|might|would|will|has|have) ((?:the|my|our"
            rf"|his|her|that|an?) [^,.;?!]+?) (?:get to|got to|gotten to|go|gone|end up|ended up"
            rf"|come from|vanish to|vanished to|run off to|wander off to|wandered off to|disappear to"
            rf"|live|hide|be hiding|be|stand|lie|sit|hang out|keep){_NOW}(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^((?:the|my|our|his|her|that|those|these) [^,.;?!]+?|\w+) (is|are) (?:in|on|at) (?:which"
            r"|what) (?:room|place|part of [\w ]+?)(?=[?.!]*$)"
        ),
        r"which room is \1 in",
    ),
    (
        (
            r"^((?:the|my|our|his|her|that|those|these) [^,.;?!]+?) (?:is|are) (?:where|whereabouts)"
            r"(?: exactly| now| again)?(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^((?:the|my|our|his|her|that|those|these) [^,.;?!]+?)[,:;]+ where(?: is| are| can i find"
            r"| did (?:i|we|you) put)? ?(?:it|they|that|them)?(?: (?:is|are))?(?: (?:kept|now|at|gone"
            r"|located|stored|exactly))*(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^((?:the|my|our) [^,.;?!]+?)[,:;]+ (?:any idea|do you know|tell me|can you tell me"
            r"|any clue) where(?: (?:it|they|that) (?:is|are|might be))?(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        r"^(?:in |at )?(which|what) (room|place)(?:'s| is|s) ((?:the|my|our) [^,.;?!]+?)(?: in| on| at)?(?=[?.!]*$)",
        r"which \2 is \3",
    ),
    (
        (
            r"^(?:do|did|should) (?:we|you|i|they|people) (?:usually |normally )?(?:keep|store|have|put"
            r"|leave) (the [^,.;?!]+?) (?:in|on|at|under|by) [^?]+? or (?:in |on |at )?[^?]+?(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        rf"^(is|are) (the [^,.;?!]+?) (?:more )?{_COLOR},? or (?:is it |rather )?{_COLOR}(?=[?.!]*$)",
        r"what color is \2",
    ),
    (
        (
            r"^(?:what|which) colou?rs? (?:of )?(?:the )?([\w ]+?) (?:are there|do we have|have we got"
            r"|exist|can (?:i|you) (?:see|find)|are|is there) ?((?:in|on|at) [^?]+?)?(?=[?.!]*$)"
        ),
        r"what color is \1 \2",
    ),
    (
        (
            r"^(?:what|which) colou?rs? (?:do|does|are|is) (?:the |all the |my )?([^?]+?)(?: have"
            r"| come in| available)?(?=[?.!]*$)"
        ),
        r"what color is \1",
    ),
    (
        (
            r"^how many ([\w ]+?) (?:does|do|has|have|did) (\w+) (?:have|got|own|possess)(?: got)? ("
            r"(?:in|on|at) [^?]+?)(?=[?.!]*$)"
        ),
        r"how many \1 are \3",
    ),
    (
        (
            r"^how many ([\w ]+?) (?:has|have|does|do|are in|are there in|in) (?:(?:this|the|our) (?:place"
            r"|house|home|building|flat|apartment)|(?:this|our) (?:school|office|hospital|studio))"
            r"(?: (?:have|got|contain|hold|offer|has))?(?=[?.!]*$)"
        ),
        r"how many \1 are there",
    ),
    (
        (
            r"^(?:please )?(?:count|number(?! of\b)|tally|add up)(?: up)? (?:all )?(?:the |my |our )?"
            r"([^,.;?!]+?)(?: (?:for me|for us|please|up|there are))*(?=[?.!]*$)"
        ),
        r"how many \1 are there",
    ),
    (
        (
            r"^(?:is there )?(?:any|some)thing (?:at all |left |still )?((?:in|on|under|at|inside"
            r"|next to) [^?]+?)(?=[?]+$)"
        ),
        r"what is \1",
    ),
    (
        (
            r"^(?:(?:are|is) there|(?:do|have) (?:we|i|you) (?:have|got)) (?:more|fewer|less|as many) ((?:(?!in "
            r"|on |at )\w+ ?)+?) (?:than|as|or(?: more)?) "
            r"([\w ]+?)( (?:in|on|at|under) [^?]+?)?(?=[?.!]*$)"
        ),
        r"how many \1 are there\3? how many \2 are there\3",
    ),
    (
        r"^(?:which|what) (?:is there|are there|do we have) more of[,:]? ([\w ]+?) or ([\w ]+?)(?=[?.!]*$)",
        r"how many \1 are there? how many \2 are there",
    ),
    (r"^(?:the )?(?:number|count|amount|total)(?: number)? of ([^?]+?)(?: please)?(?=[?.!]*$)", r"how many \1"),
    (
        (
            r"^(?:tell me |and |so |say )*(?:what|which) (?:all )?(?:are you|things are you) (?:able"
            r"|capable|allowed)(?: to do| of| of doing| to help with)?(?: for (?:me|us))?(?=[?.!]*$)"
        ),
        "what can you do",
    ),
    (
        (
            r"^what (?:can|could) (?:you|a robot like you|you robots?) (?:all )?(?:do|help with|offer"
            r"|manage|help me with)(?: for (?:me|us))?(?=[?.!]*$)"
        ),
        "what can you do",
    ),
    (
        r"^where is (?:the |that |our |my )?(?:robot|bot|butler|majordomo)(?: now| right now| at)?(?=[?.!]*$)",
        "where are you",
    ),
    (
        (
            r"^(?:can you |could you |please |will you )*(?:tell me|give me|share|what is|report|say"
            r"|state)? ?(?:about )?your (?:current |present |exact )*(?:location|position|whereabouts"
            r"|place)(?: please| now)?(?=[?.!]*$)"
        ),
        "where are you",
    ),
    (
        (
            r"^where(?: \w+)? in (?:the|this) (?:house|home|building|hospital|school|office|flat|place"
            r"|villa) (?:are|have) you (?:now |right now )?(?:standing|located|at|parked|now|got to"
            r"|ended up|sitting)?(?=[?.!]*$)"
        ),
        "where are you",
    ),
    (
        (
            r"^(?:what|which) room (?:are you|do you (?:happen to )?(?:be|stand)|have you (?:got to"
            r"|ended up)) ?(?:in|standing in|currently in|at)?(?: right now| now| at the moment)?"
            r"(?=[?.!]*$)"
        ),
        "which room are you in",
    ),
    (
        (
            r"^(where|what|who|which|how many)[,:]+ (?:pray|please|tell me|then|may i ask|exactly"
            r"|if i may ask)*,? ?(?=(?:is|are)\b)"
        ),
        r"\1 ",
    ),
)
"""In the order in which they are tried, before all else of ``ASKING``."""
