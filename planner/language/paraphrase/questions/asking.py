"""Ways of asking a question: *any idea where the keys have got to*."""

from __future__ import annotations

from planner.language.paraphrase.questions.questions import SHAPES

ASKING: tuple[tuple[str, str], ...] = (
    *SHAPES,
    (
        (
            r"\b(?:in|inside|within|throughout|across|around|of|all over) (?:all of |all )?(?:the|this|our|that|my) "
            r"(?:(?:whole|entire|complete|full|total) (?:of (?:the|this|our) )?(?:building|house|place|home|flat"
            r"|apartment|property|premises)|building|premises|property)(?=$|[?.!,])"
        ),
        "in the house",
    ),
    (r"^(how many .+?) all (?:in all|together|told)(?=[?.!]*$)", r"\1"),
    (r"^((?:how (?:do|can|would|could|should) i|what is the) .+?) from here(?=[?.]*$)", r"\1"),
    (r"^(how many [^?]+?)(?: are there)? (?:in total|in all|altogether|overall|all in all)(?=[?.]*$)", r"\1"),
    (r"^in (?:which|what) room (?:would|might|could|should) (.+?) be(?=$|[?.!])", r"where is \1"),
    (r"\bdo you happen to know\b", "do you know"),
    (r"^(?:what|which) (\w+) have (?:we|you|i) got (?=(?:in|on|at|here)\b)", r"which \1 are there "),
    (r"^(how many [\w ]+?) (?:stand|lie|sit|rest|hang) (?=(?:on|in|at|under|next)\b)", r"\1 are "),
    (r"^(?:is|are) there (?!any\b|some\b|a\b)(?:still )?(\w+) left(?=[?.]*$)", r"is there any \1"),
    (r"^what is there to eat\b", "which food is there"),
    (r"^what is there to drink\b", "which drinks are there"),
    (r"^(?:and |but )?why (?:is|was) that(?=[?.]*$)", "why did it fail"),
    (
        (
            r"^((?:could you |can you |please )*(?:go and )?(?:check|see|look|find out)"
            r" (?:if|whether|where|what|who) .+?)"
            r",? and (?:then )?(?:tell me|let me know)(?=[.!?]*$)"
        ),
        r"\1",
    ),
    (
        (
            "^(?:please )?(?:locate|find) (.+?)(?: for (?:me|us))?,? (?:and )?(?:just |only "
            "|simply )?(?:tell me|let me know|say)(?: where)?(?=[.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            "^(?:who knows|does (?:anyone|anybody|someone) (?:here )?know|(?:anyone|anybody) knows?|do we know"
            "|you know|do you (?:know|remember|recall)|can (?:anyone|anybody) tell me)(?: about)? (?=(?:where"
            r"|what|which|who|how|if|whether)\b)"
        ),
        "tell me ",
    ),
    (
        (
            "^where (is|are) (.+?) (?:kept|stored|gone|hiding|located|placed|hidden|put|found|at|now|right now"
            "|normally|usually|supposed to be|these days)(?=[?.!]*$)"
        ),
        r"where \1 \2",
    ),
    (
        (
            r"^where (?:did|have|do|does|has) (?:i|we|you|he|she|they|\w+) (?:last |just |usually "
            "|normally )?(?:keep|kept|store|stored|leave|left|put|hide) "
        ),
        "where is ",
    ),
    ("^(?:which|what) of (?:the|my|our|these|those) ", "which "),
    ("^(?:you )?(?:got|have) any ", "is there any "),
    (r"^what (?:do|have) (?:we|you|i) (?:have|got)(?: got)?(?: here| left)? to drink\b", "which drinks are there"),
    (
        r"^what (?:do|have) (?:we|you|i) (?:have|got)(?: got)?(?: here| left)? to (?:eat|snack on|nibble)\b",
        "which food is there",
    ),
    (
        (
            r"^(?:does|do|has) ([\w ]+?) (?:have|got|own)(?: got)? (an? .+?|any .+?) (on|in|at) (?:her|his"
            r"|their) (\w+)(?=[?.!]*$)"
        ),
        r"is there \2 \3 \1's \4",
    ),
    ("^(is|are) (.+?) (?:locked|closed|shut) or (?:open|unlocked)(?=[?.!]*$)", r"\1 \2 closed"),
    ("^(is|are) (.+?) (?:open|unlocked) or (?:locked|closed|shut)(?=[?.!]*$)", r"\1 \2 open"),
    (r"^(what|where|which|who|how far|how big) (?:would|might|could|will) be\b", r"\1 is"),
    (
        (
            "^how (?:would|do|can|could|should|might|does) (?:i|we|you|one) (?:best )?(?:walk|go|get|drive"
            r"|travel|come|make it|find my way) (?=(?:to|into|from)\b)"
        ),
        "how do i get ",
    ),
    (r"^what (?:do|can) you (?:have|got) in (?:view|sight)\b", "what do you see"),
    ("^who else ", "who "),
    (
        (
            "^(?:can|could) you (?:get (?:in)?to|enter|reach|go (?:in)?to|drive (?:in)?to"
            r"|get inside) (.+?)\?(?= if (?:so|not|yes|no)\b)"
        ),
        r"can you reach \1?",
    ),
    (
        (
            "^(?:any (?:idea|clue)|do you have (?:any idea|a clue)|i (?:forgot|wonder|need to know"
            "|have forgotten|have no idea)|can you (?:tell me|say|remember|check)|could you (?:tell me|say"
            "|check)|please tell me|do you (?:happen to )?(?:know|remember))(?: about)? (?=(?:where|what|which"
            r"|who|how|if|whether)\b)"
        ),
        "tell me ",
    ),
    (
        (
            r"^where (?:did|have) (?:i|we|you|he|she|they|\w+) (?:last |just )?(?:leave|left|put|place|placed"
            "|drop|dropped|lay|store|stored|hide|hidden|set down|keep|kept)(?: down)? "
        ),
        "where is ",
    ),
    (
        (
            "^where (?:could|might|may|can|should|would) (.+?) (?:be|have gone|have got to"
            "|be found)(?: found)?(?: now)?(?=$|[.!?])"
        ),
        r"where is \1",
    ),
    ("^where(?: on earth| in the world| exactly| the hell|abouts) ", "where "),
    (
        (
            "^(?:what|which) (?:shelf|table|desk|surface|place|furniture|spot|part of the (?:house"
            "|building)) (?:is|are) (.+?) (?:on|in|at)(?=$|[.!?])"
        ),
        r"where is \1",
    ),
    (r"(?<=\w) (?:lately|recently|by any chance)(?=$|[.!?])", ""),
    (
        (
            "^(?:have|has|did) (?:anyone|anybody) (?:see|seen|spot|spotted|come across"
            "|noticed?)(?: where)? (.+?)(?: is| are| lately| recently| today)?(?=$|[.!?])"
        ),
        r"where is \1",
    ),
    (
        (
            "^(?:i|we) (?:can not|could not|do not|am unable to|are unable to) (?:find|see|locate"
            "|seem to find) (.+?)(?: anywhere)?(?:[,.;] (?:do you know where (?:it|they) (?:is|are)"
            "|where (?:is|are) (?:it|they)|help)|)(?=$|[?!.]$)"
        ),
        r"where is \1",
    ),
    (
        (
            "^(?:what|which) (?:things?|stuff|items?|objects?) (?:is|are|do you see|can you see|lies?|stands?"
            r"|can i find)(?: there)? (?=(?:in|on|at|next|under|behind|inside)\b)"
        ),
        "what is ",
    ),
    (
        (
            "^what(?: all)? (?:do (?:we|you|i) have|have (?:we|you) got|can (?:you|i) (?:find|see|get)"
            "|do you see|lies|stands|sits|can be found|is there|are there|is kept"
            r"|is stored)(?: there)? (?=(?:in|on|at|next|inside)\b)"
        ),
        "what is ",
    ),
    ("^what does (.+?) (?:contain|hold|have in it)(?=$|[.!?])", r"what is in \1"),
    (r"^what(?: kind of| sort of)? color (?:does|do) (.+?) have\b", r"what color is \1"),
    ("^(?:which|what) color has ", "what color is "),
    ("^what is the color of ", "what color is "),
    ("^tell me the color of ", "what color is "),
    (
        (
            "^(?:how much|what (?:number|amount|quantity) of|what is the (?:number|amount|total) of"
            "|tell me how many|the number of) "
        ),
        "how many ",
    ),
    ("^how many (?:the|all the|of the|all|my|our) ", "how many "),
    (
        (
            "^how many (.+?) (?:do|can|did|have) (?:we|you|i) (?:have|see|got|own|find|count)(?: here| now"
            r"| left)?(?=$|[.!?]| (?:in|on)\b)"
        ),
        r"how many \1 are there",
    ),
    (
        "^how many (.+?) (?:exist|remain|are left|are around|are here|are there here)(?=$|[.!?])",
        r"how many \1 are there",
    ),
    ("^(?:do|have) (?:we|i|you) (?:still )?(?:have|got|own)(?: got)? ", "is there "),
    (r"^(?:has|does) (the [\w ]+?) (?:have|got|contain|hold) ((?:an?|any|some) .+?)(?=[?.!]*$)", r"is there \2 in \1"),
    ("^(?:are|is) (.+?) (?:available|around|left|present)(?=$|[.!?])", r"is there \1"),
    (r"^is there (?:anything|something) (?:to (?:eat|nibble)|edible)\b", "is there food"),
    (r"^is there (?:anything|something) to drink\b", "is there a drink"),
    (r"\b(?:something|anything) to drink\b", "a drink"),
    (r"\b(?:something|anything|some food) to (?:eat|nibble|snack on)\b", "a snack"),
    (r"\b(?:something|anything) to write with\b", "a writing tool"),
    (r"\b(?:something|anything) to read\b", "a reading matter"),
    (r"^who is (?:there )?(?:currently )?(?:staying |sitting |standing |working )?(?=in\b)", "who is "),
    (r"^is (?:anyone|anybody|someone|somebody) (?=(?:in|at)\b)", "who is "),
    (r"^(?:is|are) there (?:anyone|anybody|someone|somebody|people|any people) (?=in\b)", "who is "),
    (r"^(?:what|which) (?:people|persons) are (?:there )?(?=in\b)", "who is "),
    ("^what (?:place|room) are (?:we|you) in(?: now| right now| currently)?", "where are you"),
    ("^(?:where|in which room|which room) are we(?: now| at| in)?(?=$|[.!?])", "where are you"),
    ("^(?:tell me )?where you are(?: now| right now| at)?(?=$|[.!?])", "where are you"),
    (
        (
            "^(?:what are you (?:able|capable)(?: to do| of doing| of)|what are your (?:abilities|skills"
            "|capabilities|functions)|how can you help(?: me)?|what do you do|what are you good (?:at|for)"
            "|how do you work|what can i ask you(?: to do)?)(?: for (?:me|us))?(?=$|[.!?])"
        ),
        "what can you do",
    ),
    (
        r"^how (?:do|can|would|could|does one) (?:i|we|you|one)?\s?(?:get|go|come|walk|drive) from (.+?) to ",
        r"what is the way from \1 to ",
    ),
    (r"\bfrom (?:here|where i am) to\b", "to"),
    (r"^what is the way (?=to\b)", "how do i get "),
    (
        ("^(?:what|where) (?:did|have) you (?:get|got|found|find|took|take|fetch(?:ed)?) (?:it|that|this|them) from"),
        "what did you do",
    ),
    (
        (
            "^(?:what (?:did|have) you (?:just |last )*(?:do|done|move|moved|bring|brought)(?: just now| last"
            "| before| so far| today)?|what was (?:that|your last (?:task|action|job))"
            "|tell me what you (?:just )?did)(?=$|[.!?])"
        ),
        "what did you do",
    ),
    (r"^(?:which way|how far away|how far) is it to\b", "how far is it to"),
    (r"^how (?:far|long) is (?:it|the way) (?:from here )?to\b", "how far is it to"),
)
"""In the order in which they are tried."""
