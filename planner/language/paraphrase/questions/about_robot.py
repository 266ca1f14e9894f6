"""Questions about the robot itself: who it is, how it is, what it did, what it can do, what it has in its hand."""

from __future__ import annotations

from planner.language.lexicon.verbs import PAST

_NOW = r"(?: (?:now|right now|at the moment|currently|today|yet|already|again|please|then|just now|so far|still))*"
_END = rf"{_NOW}(?=[?.!]*$)"

_ALL_OF_IT = (
    r"(?: (?:(?:the|this|my|our) )?(?:(?:rest|whole|entire|remaining) ?(?:of )?(?:(?:the|this|my|our) )?)?"
    r"(?:house|building|flat|apartment|home|place|rooms|area|surroundings|rest)| everything| everywhere| on| more"
    r"| further)"
)

ABOUT_ROBOT: tuple[tuple[str, str], ...] = (
    (
        (
            rf"^(?:(?:go |go and |start |begin |keep |keep on |continue |go on )?"
            rf"(?:explor(?:e|ing)|mapping|map){_ALL_OF_IT}*"
            rf"|(?:have|did) you (?:already )?(?:explored?|mapped?|seen?){_ALL_OF_IT}+"
            rf"|are you (?:still |done |finished |through )?(?:with )?(?:exploring|mapping){_ALL_OF_IT}*){_END}"
        ),
        "have you explored everything",
    ),
    (
        (
            rf"^(?:what (?:is|are) your (?:purpose|job|role|duty|duties|function|mission|use|business|point|work"
            rf"|profession"
            rf"|talents?|strengths?|tasks?)|what (?:kinds? of |sort of )?(?:work|jobs?|chores?) (?:do|can) you do"
            rf"|how (?:heavy|much|many)(?: [a-z]+)? (?:can|do|could) you (?:lift|carry|hold|take|bear)(?: at once"
            rf"| at a time)?"
            rf"|how (?:fast|strong|big|tall|smart|clever|heavy) (?:are|can) you(?: (?:drive|go|run|move))?"
            rf"|(?:what|which|how many) languages? (?:do|can) you (?:speak|understand|know)"
            rf"|(?:do|can) you (?:understand|speak|know) (?:me|us|english|\w+ish|german|french)"
            rf"|how many (?:arms|hands|legs|wheels|eyes|fingers) (?:do|have) you (?:have|got)"
            rf"|why are you here|what should i know about you|can i (?:trust|rely on|count on) you){_END}"
        ),
        "what can you do",
    ),
    (
        (
            rf"^(?:who (?:built|made|created|programmed|designed|invented|developed|owns|bought) you"
            rf"|when were you (?:built|made|born)|where (?:do|did|are) you (?:come )?from|(?:what|which) (?:model"
            rf"|make|brand|type"
            rf"|version) are you|(?:do|have) you (?:have |got )?(?:any |a |an )?(?:feelings|emotions|heart|soul"
            rf"|brain|parents"
            rf"|family|friends|name|mother|birthday|arms|legs|wheels|eyes|gender)|(?:do|can) you (?:ever "
            rf")?(?:sleep|eat|dream"
            rf"|think|feel|breathe|drink|hear (?:me|us))|are you (?:intelligent|clever|smart|dangerous|safe|male"
            rf"|female|new|old"
            rf"|a (?:he|she|boy|girl)|made of \w+)|what are you made of){_END}"
        ),
        "who are you",
    ),
    (
        (
            rf"^(?:are you (?:happy|sad|angry|stuck|lost|broken|damaged|hurt|bored|confused|in trouble|having "
            rf"trouble|functioning"
            rf"|operational|in good shape|feeling (?:well|ok|okay|good|better))|is (?:something|anything) "
            rf"(?:wrong|the matter|amiss)"
            rf"(?: with you)?|what is (?:wrong|the matter|up) with you|did you sleep well|how is your day(?: going)?"
            rf"|how was your day|are you (?:all right|ok|okay)){_END}"
        ),
        "how are you",
    ),
    (
        (
            rf"^(?:what (?:are you looking at|is (?:in front of|around|before|ahead of) you|do you see|have you "
            rf"got in view)"
            rf"|what (?:things |objects )?(?:can|do) you (?:see|notice|spot)(?: (?:there|around(?: you)?|from "
            rf"(?:there|here|where you are)|right there))?){_END}"
        ),
        "what can you see",
    ),
    (
        (
            rf"^what are you (?:doing|up to|working on)(?: (?:today|tonight|this (?:morning|evening)|these "
            rf"days|there))+{_END}"
        ),
        "what are you doing",
    ),
    (
        (
            rf"^(?:is it time (?:for you )?to (?:re)?charge|(?:do you )?need (?:a |to )?(?:re)?charge|how much (?:power"
            rf"|energy|juice|charge)"
            rf" (?:do you have|is) left|how long (?:can|will) you (?:still )?(?:run|last|go)){_END}"
        ),
        "how is your battery",
    ),
    (r"\b(where|how|who|what) (are|r) (?:ya|yer|yous?)\b", r"\1 are you"),
    (
        (
            rf"^(?:so |hey |and )*(?:where|whereabouts) (?:(?:are )?you (?:at|hanging out|hiding|located|standing"
            rf"|parked|now)"
            rf"|you|have you (?:got to|gone|been hiding)|did you (?:go|get to|end up|disappear to)){_END}"
        ),
        "where are you",
    ),
    (
        (
            rf"^(?:and |so |tell me |do you know )*(?:what|which things?|what (?:all|things|else|stuff|sort of "
            rf"things|kind of things)"
            rf"|how much) (?:(?:do|can) you|you|are you|you are|u|can u|could you|you can)(?: all| even| actually)?"
            rf"(?: (?:know|able|capable|trained|programmed|built|made|designed|learned|learnt))?(?: how)?(?: to| of)?"
            rf"(?: (?:do|doing|help with|handle|manage|be used for))?"
            rf"(?: for (?:me|us|people|someone))?(?: around (?:here|the house))?{_END}(?<=do)(?<!are you do)"
        ),
        "what can you do",
    ),
    (
        (
            rf"^(?:(?:have |do )?you (?:got |have )?|got |is there )?(?:anything|something|any stuff|things|a "
            rf"thing|stuff)"
            rf" (?:in|between) (?:your|the|those|that) (?:\w+ )?(?:hands?|grippers?|arms?|claws?|fingers|grip"
            rf"|pincers?|paws?){_END}"
        ),
        "what are you holding",
    ),
    (
        (
            rf"^(?:(?:are )?you (?:holding|carrying|gripping) (?:anything|something|stuff|things|a thing)"
            rf"|do you (?:carry|hold) anything|what do you (?:hold|carry)|is your (?:hand|gripper) (?:empty|free"
            rf"|full)){_END}"
        ),
        "what are you holding",
    ),
    (
        (
            rf"^(?:what|whatcha|what(?:'ve| have)?) you(?: have)? (?:got|holding|carrying)(?: there| in there| with you"
            rf"| in (?:your|that|those) [\w ]+?)?{_END}"
        ),
        "what are you holding",
    ),
    (
        (
            r"^(?:good (?:job|work|night|robot|boy|bye)|well done|nice (?:work|job|one)|great job|bye(?: bye)?"
            r"|goodbye"
            r"|see you(?: later| soon| tomorrow)?|perfect|excellent|awesome|brilliant|wonderful|great|lovely"
            r"|nice|cool"
            r"|fantastic|that is (?:great|good|perfect|nice|fine|all|it)|i (?:love|like) you|you are (?:great"
            r"|the best"
            r"|awesome|wonderful|a star|welcome))(?:,? (?:robot|thanks|thank you|then|majordomo))*[.! ]*$"
        ),
        "thanks",
    ),
    (
        (
            r"^(?:(?:who|what)(?: exactly| kind of (?:thing|robot|machine))? are you|are you (?:a |the"
            r" )?(?:robot|machine|human"
            r"|person|alive|real|majordomo|computer|man|woman)|(?:please )?introduce yourself|(?:can you |could"
            r" you )?tell me"
            r" (?:something |a (?:bit|little) |more )?about yourself|what (?:kind|sort) of (?:robot|machine"
            r"|thing) are you"
            rf"|do you have a name|what is your name|who do i (?:talk|speak) (?:to|with)|who am i (?:talking"
            rf"|speaking) to){_END}"
        ),
        "who are you",
    ),
    (
        (
            r"^(?:how are you(?: doing| feeling| today)*|are you (?:ok|okay|all right|alright|well|fine|feeling"
            r" well|good)"
            r"|how do you (?:feel|do)|how is (?:it|everything|life) going|is everything (?:ok|okay|fine|all right))"
            rf"{_END}"
        ),
        "how are you",
    ),
    (
        (
            r"^(?:are you (?:free|available|ready|idle|waiting|occupied|working|awake|there|listening)"
            r"|do you have (?:time|anything to do|something to do|a moment)|what (?:are you going to|will you|do"
            r" you plan to|are you"
            r" about to) do(?: next)?|what is (?:next|your next (?:task|step|job))|what comes next|what is on"
            r" your list"
            rf"|do you have (?:any|a) (?:task|job|plan|order)s?(?: left)?){_END}"
        ),
        "what are you doing",
    ),
    (
        (
            r"^(?:are you (?:fully |completely )?(?:charged|charging|low|tired|hungry|exhausted|empty|low on"
            r" (?:power|battery"
            r"|energy|juice))|do you (?:need|have|want)(?: to)? (?:be |get )?(?:charging|charged|charge|recharge"
            r"|recharging"
            r"|a (?:re)?charge|(?:enough )?(?:power|battery|energy|juice)(?: left)?|a break|a rest|rest|sleep"
            r"|refueling)"
            r"|how (?:long|far) (?:will|does|can) (?:your (?:battery|charge|power)|you) (?:last|hold out|go on"
            r"|keep going|get)"
            r"|how many (?:battery|power|energy|juice|charge) (?:is left|do you have(?: left)?|have you got(?:"
            r" left)?|remains)"
            r"|(?:is|are) your (?:battery|batteries) (?:ok|okay|fine|charged|empty|full|low|flat|dead|all right|good)"
            rf"|when (?:do|must|will) you (?:have to |need to )?(?:re)?charge){_END}"
        ),
        "how is your battery",
    ),
    (
        (
            r"^(?:tell me |and |so |say )*(?:what|which things?)(?: are| do| have)? you(?: are| have)?(?: got)?"
            r"(?: currently| now)? (?:holding|carrying|gripping|grasping|hold|carry|have|got)"
            rf"(?: (?:in|with) (?:that|your|the) [\w ]+?)?{_END}"
        ),
        "what are you holding",
    ),
    (
        (
            r"^(?:what (?:have you got|do you have|is that|are you bringing|did you pick up|is)(?: there| with"
            r" you| in there)?"
            r"(?: (?:in|with) your (?:hands?|grippers?|arms?|claws?|fingers))|what have you got(?: there)?|what"
            r" do you have there"
            r"|(?:is|are) your (?:hands?|grippers?|arms?) (?:empty|free|full|busy|occupied)|do you have a free hand"
            rf"|have you got (?:anything|something)(?: in your (?:hands?|grippers?))?|are you empty-?handed){_END}"
        ),
        "what are you holding",
    ),
    (
        (
            r"^(?:are you able to|can you|could you|do you know how to|would you be able to|do you) (?:bring"
            r"|fetch|carry|find|get"
            r"|move|pick up|deliver|transport|take|look for|lift|hold|grab|handle)(?: me| us| up| people)?"
            r" (?:some )?(?:things"
            r"|stuff|something|objects|items|anything|small things|everyday things)"
            rf"(?: (?:around|for me|for us|to people|to me|from other rooms|up|for people))*{_END}"
        ),
        "what can you do",
    ),
    (
        (
            r"^(?:what (?:can|could|may|should|might|do) (?:i|we|one|people) (?:all )?(?:ask|tell|request|say"
            r"|order|have|get|let"
            r"|make)(?: (?:of|to|from))? ?(?:you|a robot)?(?: (?:to do|do|for|about))?(?: for (?:me|us))?"
            r"|(?:what|which) (?:kinds?|sorts?|types?)? ?(?:of )?(?:things|questions|tasks|jobs|requests"
            r"|commands|orders)"
            r" (?:can|could|may|should|do) (?:i|we|one|you) (?:ask|give|understand|answer|do|say|tell|handle"
            r"|perform|follow)(?: to|"
            r" of)?(?: you)?"
            r"(?: to do| for)?|how (?:do|can|could|should) (?:i|we) (?:use|control|command|talk to|work with"
            r"|instruct) you"
            r"|(?:give|show|tell) me (?:an example|some examples|what you can do)|what (?:use|good) are you"
            rf"|what are you (?:here )?for|how can you (?:be of help|help|assist)(?: me| us)?){_END}"
        ),
        "what can you do",
    ),
    (
        (
            r"^(?:(?:do|did) you know (?:what )?my name(?: is)?|what is my name|what am i called|what do you call me"
            rf"|do you (?:know|recognize|remember) (?:me|who i am)|tell me my name){_END}"
        ),
        "who am i",
    ),
    (
        (
            r"^(?:are you (?:done|finished|through)|have you (?:finished|completed|done) ?(?:it|that|with that"
            r"|the job|the task"
            r"|everything|your (?:task|job|work))?|is (?:it|that|the (?:job|task|work)) (?:done|finished"
            r"|complete|over)"
            r"|did (?:you (?:do|finish|manage|make|get) (?:it|that)(?: done)?|it work(?: out)?|that work)|how"
            r" did (?:it|that) go"
            r"|what (?:did you do|happened) before(?: that)?|where (?:were you|have you been)(?: before| until"
            r" now| all this time"
            rf"| earlier)?){_END}"
        ),
        "what did you do",
    ),
    (
        (
            r"^why (?:did|have|do|are|were|could|can|was)(?: not)? (?:you|it|that)(?: not)? (?!reach|go |get "
            r"|drive |enter )"
            r"(?:bring|fetch|take|get|put|move|do|come|go|find|pick|deliver|finish|stop|stopped|brought|done"
            r"|failed|fail|work"
            r"|refuse|wait|stand|standing|give|gave|carry|obey|listen)[^?.!,]*(?=[?.!]*$)"
        ),
        "why did you fail",
    ),
    (
        (
            r"^(?:what (?:did|have) i (?:just |last )*(?:ask(?:ed)?|say|said|tell|told|request(?:ed)?|order(?:ed)?)"
            r"(?: (?:you|for|of you))*(?: to do)?|what was (?:my|the|our) (?:last |previous |latest )?"
            r"(?:request|order|question|task|command|wish)|do you remember what i (?:asked|said|told you|wanted))"
            rf"(?: (?:last|before|just now))?{_END}"
        ),
        "what did i ask",
    ),
    (r"^(?:have|did) you (?:already |ever |just )*(?:been|be|gone|go) (?=(?:in|to|at|into)\b)", "did you go "),
    *(
        (rf"^(?:have|did) you (?:already |ever |just |really |actually |also )*{past} (?=\w)", f"did you {verb} ")
        for past, verb in PAST.items()
        if past not in ("found", "located", "put", "got", "gotten", "picked up")
    ),
    (
        r"^can you see (?:me|us)(?: (?:now|from (?:there|here)))?(?=[?.!]*$)",
        "where am i",
    ),
    (
        (
            r"^(?:how do you know(?: (?:that|this|it))?|are you (?:\w+ )?(?:sure|certain|positive)(?: (?:about"
            r"|of) (?:it|that|this))?"
            r"|is that (?:true|certain|right|correct|really so)|really|how (?:sure|certain) are you|do you"
            r" really know(?: that)?)"
            rf"{_END}"
        ),
        "how do you know",
    ),
)
"""Before the rules of ``ASKING``."""
