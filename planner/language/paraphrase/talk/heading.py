"""Requests in note form: a label and a colon, a thing and a full stop, a place and *go*."""

from __future__ import annotations

_JOB = (
    r"(?:errand|task|job|mission|request|order|instruction|favou?r|duty|assignment|chore|to-?do|plan|message|command)"
)
_COLOR = (
    r"(?:red|green|blue|yellow|black|white|brown|pink|purple|gray|grey|orange|gold|silver|clear|small|big|large|little)"
)
_NO_PLACE = (
    r"(?:go|drive|please|if|when|unless|once|after|before|should|in case|provided|as|where|"
    r"is|then|and|bring|take|put)\b"
)
_THING = r"(?:(?:the|my|a|an|that|this|his|her|some|one|our|both|all|two|three) )?[\w' ]+?"
_SPOT = (
    r"(?:room|kitchen|hall|office|bathroom|bedroom|garage|pantry|library|terrace|laundry|lab|gym|storage|table"
    r"|desk|shelf"
    r"|counter|cabinet|drawer|fridge|refrigerator|bench|couch|sofa|bed|nightstand|dresser|windowsill|sink|basket|box)"
)

HEADING: tuple[tuple[str, str], ...] = (
    (rf"\b(\w+) \(({_COLOR})(?: one)?\)", r"\2 \1"),
    (r"\s*\((?:the )?([^()]{1,40})\)", r", the \1,"),
    (
        (
            rf"^(?:please )?(?:run|do|take|carry out|here is|here are|i have|there is|perform|complete)?"
            rf" ?(?:(?:this|your|my|the|a|an|new|next|first|one|small|little|quick|following|another|urgent|today's|"
            rf"some|these|few) )*{_JOB}s?(?: for (?:you|me|us|today))?(?: please)? ?(?::| [–-]) (?=\w)"
        ),
        "",
    ),
    (r"^(?:fetch|bring|get)(?: me)?: (?=(?:the|my|an?|some|two|three|both|all|his|her|that|one|any)\b)", "bring me "),
    (r"^(?:fetch|bring|get)(?: me)?: (?=\w)", "bring me the "),
    (r"^(?:go|drive|head)(?: to)?: (?=\w)", "go to "),
    (r"^(?:position|destination|target|next stop|stop|where to|new position): (?=\w)", "go to "),
    (rf"^({_THING}): ([\w ]+?) ?(?:-+>|=+>|→) ?(?=\w)", r"the \1 from \2 to "),
    (
        rf"^(?:the )?(\w+(?: \w+)?)[.:] (?:from )?((?:\w+ )?{_SPOT}) to (?=(?:\w+ )?{_SPOT}\b)",
        r"the \1 from \2 to ",
    ),
    (
        rf"^(take|bring|move|carry|get) ([\w ]+?) ?, ?((?:the )?(?:\w+ )?{_SPOT}) ?, ?(?=(?:to|into|onto) )",
        r"\1 \2 from \3 ",
    ),
    (r"^the (?=(?:the|my|an?|some|all|both|his|her) )", ""),
    (rf"^({_THING}): (?=(?:should|must|needs? to|has to|have to|goes|belongs?|can go|to be)\b)", r"the \1 "),
    (
        (
            rf"(?:(?<=^)|(?<=[.;] ))(?!{_NO_PLACE}|[^,:;.!]*\b(?:is|are|was|has|have|had|came|will|wants|needs"
            rf"|if)\b)((?:the "
            rf"|my )?[\w' ]+?)[,:;.!]+ (?:go|drive|head|off you go)(?: there| here)?(?: now)"
            rf"?"
            r"(?=[.!]*$)(?<!please go)"
        ),
        r"go to \1",
    ),
    (
        (
            rf"^(?![^.!]* (?:to|into|onto) )({_THING})[.!]+ (?:here|to me|over here|bring|fetch|give"
            rf"|now)(?:[.!,]+ (?:now|here|"
            rf"quick|please|at once|"
            r"immediately|to me|chop chop))*(?=[.!]*$)"
        ),
        r"bring me \1",
    ),
    (rf"^({_THING})[.!,]+ (?:now|quick|quickly|at once|immediately|asap|hurry)(?=[.!]*$)", r"\1"),
    (r"(?:(?<=^)|(?<=[.!?,;] ))(give|bring|hand|pass|fetch|get) (me|us)(?: please| now)?(?=[.!]*$)", r"\1 \2 it"),
    (
        (
            r"^(?![^.!]*\b(?:is|are|was|were|has|have)\b|.*\bwith (?:it|them|that|those)\b)((?:the|my|an?|that|this|his"
            r"|her|both|all) [^.;:!?,]+?)[.!]+ (?=(?:to|into|onto|in|on|for) [\w' ]+[.!]*$)"
        ),
        r"\1 ",
    ),
    (
        (
            r"(?<=\w)(?:[.!;] (?:just )?go|[.!;,] (?:just )?(?:do it|do so|make it so|off you go|now|quick))"
            r"(?: please| now)?(?=[.!]*$)"
        ),
        "",
    ),
)
"""In the order in which they are tried."""
