"""Why, for what occasion and with what remark something is asked: *for dinner*, *do not ask me why*."""

from __future__ import annotations

_MEAL = (
    r"(?:dinner|lunch|breakfast|supper|tea ?time|brunch|dessert|bed ?time|school|work|the (?:party|guests?|visitors?|"
    r"game|trip|journey|meeting|road|night|evening|weekend|meal|show|picnic)|tonight|later|a change|my (?:lunch|dinner|"
    r"breakfast|snack|break)|(?:his|her|their|our) (?:lunch|dinner|breakfast|snack|break)|luck|fun|good|safety)"
)
_DEED = r"(?:bring|take|put|go|get|fetch|give|come|carry|move|find|drop|return|look|hand|pick|place|pass|grab|drive)"

MOTIVES: tuple[tuple[str, str], ...] = (
    (
        (
            r"(?:^|(?<=\w),? )when(?:ever)? you (?:have|get|find|can spare)(?: got)? (?:a|an|some|the) (?:free )?"
            r"(?:minute|moment|second|time|chance|sec|while)(?: to spare)?(?=$|[.!?,]| \w),? ?"
        ),
        "",
    ),
    (r"(?<=\w)[,;.!]+ (?:but |and )?(?:please )?(?:be )?(?:careful|gentle|cautious)\b[^.;!?]*(?=[.!]*$)", ""),
    (rf"(?<=\w),? (?:for|after|before|with|during|in time for) {_MEAL}(?=$|[.,!?;]| (?:and|please|to)\b)", ""),
    (rf"^(?:for|after|before|with|during|in time for) {_MEAL},? (?=\w)", ""),
    (
        (
            r"(?<=\w)[,;.]? (?:and |but )?(?:please )?(?:do not ask(?: me)?(?: why| questions| any questions)?"
            r"|no questions(?: asked)?|trust me|believe me|i promise|you know why|i beg you|i am begging you"
            r"|i (?:do not|can not) know why|god knows why|do not worry(?: about it)?|mind you|no (?:hurry|rush)"
            r"|take your time|there is no (?:hurry|rush)|be (?:careful|gentle|quick)(?: with it| about it)?"
            r"|mind the (?:step|gap|cat|dog))(?=[.!]*$|[.,;!] )"
        ),
        "",
    ),
    (
        (
            r"(?:^|(?<=\w),? )(?:as (?:usual|always|agreed|discussed|promised|before|you "
            r"know|i said|mentioned|planned)|"
            r"like (?:i said|always|last time|yesterday|you always do|every day)|as (?:i|we) (?:said|agreed|told you)|"
            r"for once|for a change|if anything|by any means|at your leisure|in peace|in one piece)(?=$|[.!?,]),?"
        ),
        "",
    ),
    (
        (
            rf"(?:^|(?<=[.;!,] ))(?:make yourself|be) (?:useful|helpful|good|nice|kind|a help|of use)"
            rf"(?: for once| today| now| then)*,? (?:and |, )(?={_DEED}\b)"
        ),
        "",
    ),
    (
        (
            r"\b(i (?:want|need|would like) [^.;!?]+?) (?:when|once|by the time|before) i (?:leave|"
            r"go|go out|get home|come home|"
            r"come back|am back|return|get up|get back|wake up|head off)(?=[.!]*$)"
        ),
        r"\1",
    ),
    (
        (
            r"\b((?:take|bring|carry|move|get) (?:the|my|his|her|that|those|it|them)[\w "
            r"]*?) (?:outside|inside|upstairs|"
            r"downstairs|outdoors|indoors|out|in|over there|away),? and (?:then )?(?:leave|"
            r"put|place|set|drop|lay|stick) "
            r"(?:it|them) "
        ),
        r"\1 and put it ",
    ),
    (
        (
            r"(?<=\w)[,;.]+ (?:but |and )?(?:i am not (?:sure|certain)|i do not (?:know|"
            r"remember|recall)|no idea|not sure|i (?:have )?"
            r"(?:forgot|forgotten)|i have no idea|who knows|god knows|i can not remember)"
            r" (?:exactly )?(?:where|which|on which|"
            r"in which|what|who)\b[^.;!?,]*(?=[.!?]*$|[.;] )"
        ),
        "",
    ),
    (
        (
            rf"^(?:move it|come on|chop chop|hurry up|get moving|get a move on|wake up|look "
            rf"alive|hop to it|snap to it|go go go|"
            rf"quick|attention|hey you|oi|oy|you there|listen up|wakey wakey)[,!. ]+(?:(?:you "
            rf")?(?!{_DEED}\b)[\w ]{{2,20}}?[,!.]+ )?"
            rf"(?:and )?(?=(?:please )?{_DEED}\b)"
        ),
        "",
    ),
    (
        (
            r"^(?:leave|let) ((?:the|my|his|her|that|those) [^,.;]+?) (?:alone|be|in peace|"
            r"there|where (?:it|they) (?:is|are))"
            rf"(?:,| and|;|\.| but)+ (?=(?:please |only |just )*{_DEED}\b)"
        ),
        r"do not move \1, but ",
    ),
    (
        (
            r"^((?:please )?(?:go|drive|come|head|pop|visit|walk|proceed)\b[^,.;]*?),? "
            r"(?:and |but |then )*(?:do not|without) (?:touch|"
            r"touching|take|taking|move|moving|break|breaking|disturb|disturbing|do|doing)"
            r" (?:anything|a thing|any of it|anyone|"
            r"anybody|things|stuff)(?: there| in there)?(?=[.!]*$)"
        ),
        r"\1",
    ),
    (r",? so (?:that )?each (?:is|are|stands|lies) where the other (?:was|is|were)(?=[.!]*$)", ""),
)
"""In the order in which they are tried."""
