"""Speech that a machine has typed: spoken punctuation, words to gain time, things said twice."""

from __future__ import annotations

_LEAD = (
    r"(?:(?:hey|hi|hello) (?:there|again|you)|hey|hi|hiya|hello|ok|okay|okey dokey|yeah|"
    r"yes|yep|so|well|right|alright|all right|like|um+|uh+|er+m?|robot|"
    r"now|then|please|listen|listen up|you know|i mean|basically|anyway|actually|right then|now then|ok then|hm+|ah|"
    r"oh|let me (?:think|see)(?: now| again| for a (?:second|moment))?|what was it(?: again|"
    r" now)?|how do i say(?: this)?)"
)
_NP = r"(?:the|an?|my|that|his|her|some) (?:\w+ )?\w+"
_NP_LONG = (
    r"(?:the|my|that|this|his|her|our|those|these)"
    r"(?: (?!(?:is|are|was|were|has|have|had|will|does|did|fell|broke|smells|looks|belongs|goes)\b)[\w']+)+?"
)
_MARK = r"(?:question mark|comma|period|full stop|exclamation (?:mark|point))"
_DEED = r"(?:bring|take|put|go|get|fetch|give|come|carry|move|find|drop|return|look|hand|pick|place|pass|grab|drive)"

DICTATING: tuple[tuple[str, str], ...] = (
    (rf"\b{_MARK},? (?:no|oops|sorry|i mean|wait)(?:,? (?:no|sorry|i mean))*,? (?={_MARK}\b)", ""),
    (
        (
            rf"^(?:(?!,).)*?\b(?:the|an?|my|some|to|in|on|from|his|her|with)(?:\.{{2,}}|…| ?[—–]| -)+ "
            rf"?(?:no,? |sorry,? "
            rf"|wait,? |i mean,? )*(?={_DEED}\b)"
        ),
        "",
    ),
    (
        r"\b(?:the|my|that) (\w+) (?:the|my|that) (\w+ \1),? the one (?=(?:in|on|at|under|from|with|next to|that)\b)",
        r"the \2 ",
    ),
    (r"\b((?:the|my|that) (?:\w+ )?\w+),? the one (?=(?:in|on|at|under|from|with|next to) (?:the|my)\b)", r"\1 "),
    (
        (
            rf"^({_NP_LONG}),? (?:i|we) (?:really |just )?(want|need|would like) (?:it|that|them|those|him"
            rf"|her)(?: now| please)*(?=[.!]*$)"
        ),
        r"i \2 \1",
    ),
    (r"\b((?:the|my|that) [\w' ]+?),? (?:and |but )?not (?:the|any)(?: of the)? others?(?: ones?)?(?=[.!,]|$)", r"\1"),
    (
        (
            r"\b(?:two|three|four|a few|a couple of|several|some|these|the following)(?: two| three)? "
            r"(?:things|items)[,:;.]* "
            r"(?=(?:the|my|an?|his|her) [\w' ]+ and )"
        ),
        "",
    ),
    (r"\b([a-z]+ [a-z]+(?: [a-z]+)?),? \1\b", r"\1"),
    (
        (
            r"\b(me|him|her|us|then|and|just|maybe|could you|can you|would you|please),? like,? "
            r"(?=(?:the|an?|my|bring|take|put|go|get|come|fetch|give)\b)(?<!would you like )"
        ),
        r"\1 ",
    ),
    (r"^(?:the thing is|here is the thing|fact is|truth is|point is)[,:]? (?:that )?(?=\w)", ""),
    (
        (
            r"^(?:i (?:need|want|would like) you to|can you|could you|please)? ?do (?:something|me a favou?r"
            r"|one thing|me one)(?: for (?:me|us))?[,.:;!?]* (?=(?:bring|take|put|go|get|come|fetch|give"
            r"|find)\b)"
        ),
        "",
    ),
    (r"^(?:(?:hey|ok|okay|hi|hello),? )?(?:alexa|siri|google|jarvis|cortana)[,!.]* (?=\w)(?!me\b|it\b)", ""),
    (
        (
            r"\b(the|my|a|an|that) (?:(?:uh|um|er),? )?(\w+)(?: (?:thing|thingy|thingummy|whatsit"
            r"|whatchamacallit))?,? (?:(?:uh|um|er|i mean|well),? )*"
            r"(?:the|my) ((?:\w+ )?\2)\b(?! (?:is|are|on|in)\b)"
        ),
        r"\1 \3",
    ),
    (r" ?\bcomma\b,?", ","),
    (r" ?\b(?:full stop|period)(?=$|[.\s])(?! of)", "."),
    (r" ?\b(?:question mark|exclamation (?:mark|point))\b", "."),
    (r"\b(?:new line|new paragraph|next line)\b", "."),
    (rf"^(?:{_LEAD}[,.!;:]* )+(?=\w)(?!do\b|that is\b)(?=\S+ \S)", ""),
    (
        (
            r"(?<=\w),? (?:let me (?:think|see)|what was it|how do you (?:call|say) (?:it|that)|what is it called|"
            r"what do you call it|you know what i mean|you know which one|what is the word)(?: again| now)?,? (?=\w)"
        ),
        " ",
    ),
    (
        (
            r"^(?!.*\b(?:bring|take|put)\b.*never ?mind).{1,40}?(?:\.{2,}|…|[,.;-])\s*(?:(?:ah|"
            r"oh|uh|um|well|no)[,.]? )*"
            r"(?:never ?mind|forget (?:it|that)|scrap that|doesn't matter|does not matter)"
            r"[,.!;]+ (?:just |please |so |and )*(?=(?:"
            r"bring|take|put|get|fetch|give|go|come|find|drive)\b)"
        ),
        "",
    ),
    (r",(?:\s*,)+", ","),
    (rf"\b({_NP}),? (?:yes|yeah|right|exactly|i said|that is right|ok|okay),? \1\b", r"\1"),
    (
        r"^(?:so |and )?(?:what|all) (?:that )?(?:i|we) (?:really )?(?:want|need|would like)(?: now)? is (?=\w)",
        "i want ",
    ),
    (
        r"(?<=\w) (?:okay|ok|yeah|right),? (?=(?:bring|take|put|go|get|fetch|give|come|can you|could you|please)\b)",
        ", ",
    ),
    (
        (
            r"(?<=\w),? (?:and )?(?:that is (?:it|all)|that will be all|over and out|end of "
            r"message)(?=[.!]*$)(?<! is over)"
        ),
        "",
    ),
)
"""In the order in which they are tried."""
