"""Ways of sending the robot somewhere, or to find something."""

from __future__ import annotations

_HUNT = (
    r"(?:go |please |can you |could you |and |then |just |do |,)*(?:look|search|have a look"
    r"|take a look|go look|check|hunt|find it|find them|go and look|see)(?: for (?:it|them)"
    r"| around| everywhere)*"
)

FINDING: tuple[tuple[str, str], ...] = (
    (r"\b(?:hunt|track|chase|run) (them|it|the [\w' ]+?|my [\w' ]+?) down(?=$|[?.!,;])", r"find \1"),
    (r"\b(?:have|take) a (?:good |quick |proper )?look (?:around|about|everywhere)(?: here)? for ", "find "),
    (
        r"\b(?:take|have|go for) a (?:little |short |quick )?(?:walk|stroll|trip|drive|spin)(?: over| down| up)? to ",
        "go to ",
    ),
    (
        (
            r"^(\w+|the \w+) (?:wants|would like|would love|needs|has|is dying) to (?:see|read|have|look at|have"
            r" a look at"
            r"|use|try|borrow|taste|hear|play with) (?:it|that|this|them)(?: too| as well| also)?[,;.]+ (?:so "
            r"|please )*"
            r"(?=(?:take|bring|give|carry|hand|deliver|get|pass)\b)"
        ),
        r"\1 is waiting, ",
    ),
    (
        (
            r"^(?:has|have|did) ((?:the|my|our|his|her) [\w' ]+?) (?:turned up|shown up|been found"
            r"|reappeared|appeared|surfaced|turn up|show up)"
            r"(?: yet| again| anywhere)*(?=[?.!]*$)"
        ),
        r"where is \1",
    ),
    (
        (
            r"^(?:is there |are there )?any (?:signs?|trace|luck (?:with|finding)|news of|word on) "
            r"(?:of )?(?=(?:the|my|our|his|her)\b)"
        ),
        "where is ",
    ),
    (
        (
            rf"^(?:.{{0,30}}?\b)?where (?:on earth |the hell |in the world )?(?:did (?:i|we) (?:leave"
            rf"|put|lay|drop)|(?:i|we) (?:left|put|laid|dropped)|is|are) ([\w' ]+?)(?: is| are"
            rf"| gone)?[?.,;!]+ {_HUNT}(?=[.!?]*$)"
        ),
        r"find \1",
    ),
    (
        (
            rf"^((?:the|my|our|his|her) [\w' ]+?)[,.;:!?]+ where(?: on earth| the hell| in the world)?"
            rf"(?: (?:is|are|did) (?:it|they|i|we)(?: leave| put| go)?(?: it| them)?)?[,.;:!?]+ {_HUNT}"
            rf"(?=[.!?]*$)"
        ),
        r"find \1",
    ),
    (
        (
            r"\b(?:is|are|has|have) (?:gone missing|disappeared|vanished|got lost|gone astray"
            r"|been mislaid|nowhere to be (?:found|seen)|gone walkabout|done a runner)\b"
        ),
        "is missing",
    ),
    (
        (
            r"\b(i|we) (have lost|lost|can not find|have misplaced|misplaced) ([\w' ]+?) (?:again"
            r"|once more|yet again|somewhere|somehow|anywhere|now)(?=[.,;!?])"
        ),
        r"\1 \2 \3",
    ),
    (r"^(?:i|we) (?:need|have|want|ought|got) to (?=(?:find|locate|look for|search)\b)", ""),
    ("^(?:go )?(?:and )?see if (?:you can|you are able to) (?:find|locate|spot) ", "find "),
    (
        ("^(?:find out|see|check|figure out|work out|look up|tell me) where (.+?) (?:is|are)(?: at| now)?(?=$|[.!?])"),
        r"where is \1",
    ),
    ("^(find|locate|look for|search for) (.+?) (?:for me|for us)(?=$|[.!?])", r"\1 \2"),
    (
        (
            r"^where is (.+?)\? (?:please )?(?:go|and go|then)? ?(?:and )?(?:look for|find|search for|get"
            "|fetch) (?:it|them|her|him)(?=$|[.!?])"
        ),
        r"find \1",
    ),
    (r"\b(?:find|locate|look for|search for) (?:me|us) (?=(?:the|a|my|some)\b)", "find "),
)
"""In the order in which they are tried."""

_ALONG = r"(?: (?:on|off|over|out|down|up|along|across|round|around|back|through|straight|right|quickly|slowly))*"
_MOTION = (
    r"(?:amble|toddle|trundle|stroll|wander|saunter|shuffle|scurry|scamper|scoot|scuttle|skip|hop|zoom|whizz|zip"
    r"|dash|"
    r"dart|race|rush|hurry|hasten|speed|march|stride|pace|plod|trudge|trek|hike|jog|sprint|trot|gallop|bounce|"
    r"creep|crawl|sneak|tiptoe|slip|slide|glide|roll|wheel|cruise|mosey|meander|waddle|waltz|totter|potter"
    r"|pootle|nip|"
    r"pop|bob|swing|drift|float|ride|motor|steer|travel|journey|proceed|advance|venture|repair|betake|retire"
    r"|withdraw|"
    r"retreat|buzz|bomb|leg it|head|drive|walk|run|move|step|wend your way|find your way|make your way|make tracks|"
    r"get going|get moving|get over|get down|get up|get along|push on|press on|carry on|move on|drop)"
)
"""How one moves: verbs of motion, which need no object."""
_CALLING = (
    r"(?:report(?! back)|check in|show up|turn up|present yourself|call in|call round|stop off"
    r"|stop by|pull up|pull in|land|arrive|"
    r"appear|touch base|pay a (?:short |quick |little |brief )?visit|make an appearance|drop in|look in|clock in|"
    r"put in an appearance|come to a (?:stop|halt)|pull over|be off|be on your way|take up (?:position|station))"
)
_START = r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou )|(?<=\bto ))"
_PLACED = (
    r"(?=(?:the|my|our|his|her|\w+'s|where|room|office|ward|classroom|me|us|him|them|meeting|corridor|\w+[.!]*$)\b)"
)

GOING: tuple[tuple[str, str], ...] = (
    (
        (
            r"^do not (?:go|drive|come|walk|head) (?:to|into) [^,.;]+[,.;]+ (?:but |just |instead |please |rather )*"
            r"(?=(?:go|come|drive|walk|head)\b)"
        ),
        "",
    ),
    (r"\b(to|at|in) wherever ([^,.;]+? (?:is|are))\b", r"\1 where \2"),
    (
        (
            r"^(\w+) (?:wants|needs|would like|wishes) (?:a word|a chat|to (?:talk|speak|see|meet|chat)"
            r"|to have a (?:word|chat))"
            r"(?: with| to)? you(?: now)?(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (r"\b(?:go (?:and )?)?keep (\w+) company(?: for a (?:bit|while|moment))?(?=$|[.!,])", r"go to \1"),
    (
        (
            r"\b(?:go (?:and )?)(?:sit|stay|be|stand|hang out|wait|spend (?:some )?time) with (\w+)"
            r"(?: for a (?:bit|while|moment))?(?=$|[.!,])"
        ),
        r"go to \1",
    ),
    (
        (
            r"^(.+?) is where you (?:should|ought to|need to|must|have to|are supposed to)(?: be| go"
            r"| wait| stand)(?: now)?(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            r"\b(?:stop|swing|pop|drop|call|nip|run|go)(?: over| down| up| back)? (?:by|in|into|to|at) (the [\w ]+?) "
            r"for ((?:the|an?|some|my) [\w ]+?)(?=,? and |,|$|[.!])"
        ),
        r"get \2 from \1",
    ),
    (r"\bmake it (?:over |across |down |up |back )*(?:to|into) (?=\w)", "go to "),
    (r"\byou have been (?:to|in|into|at) (?=\w)", "you went to "),
    (rf"{_START}{_MOTION}(?: yourself)?{_ALONG} (?:to|into|towards?) (?!bed\b)(?=\w)", "go to "),
    (
        (
            rf"{_START}{_CALLING}{_ALONG} (?:to|at|in|with|by|on|into|near|outside|for) (?=the |my |our "
            rf"|\w+'s |(?:\w+ )?\w+(?:[.!]*$|,| and | then )|\w+ \d)"
        ),
        "go to ",
    ),
    (
        (
            r"\b(?:haul|drag|shift|move|get|take|bring|carry|wheel|roll|steer|propel|transport|lug"
            r"|heave|plant|install|post|"
            r"place|put|position|park|station|make) (?:yourself|your (?:\w+ )??(?:self|butt|body|wheels"
            r"|tracks|chassis|bottom|"
            r"backside|metal|ass|arse|bum|carcass|circuits))"
            rf"{_ALONG} (?=(?:to|into|in|at|by|near|next|beside|over|outside) )"
        ),
        "go ",
    ),
    (
        (
            r"^(?:and |now |then |ok |okay |right |so |please |,)*(?:(?:off|away|on|out|over|back|down"
            r"|up|along|straight|go) )*"
            r"(?:you (?:go|pop|trot|run|toddle|hop|get|nip) )?(?:to|into|over to|down to|up to|in) ([^,.;!?]+?)"
            r"(?: with you(?: now| then)?|,? you go)(?=[.!]*$|,)"
        ),
        r"go to \1",
    ),
    (
        (
            r"^(?:and |now |then |ok |so |please |,)*(?:off|away|out|over|back|down|up|along|on)(?: "
            r"(?:off|over|down|up|along))* "
            r"you (?:go|pop|trot|run|toddle|hop|get|nip|head|trundle|scoot|roll|march|come)(?: off| over| along)* "
            r"(?:to|into|towards) (?=\w)"
        ),
        "go to ",
    ),
    (
        (
            r"^(\w+)(?:'s| is| has been) (?:asking|looking|waiting|calling) for you[,.;!]+ (?:so "
            r"|please )*(?:go|come)(?: and)? (?:see|meet|join|find|visit) (?:him|her|them)"
            r"(?: (?:in|at) ([\w ]+?))?(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            r"\bgo(?: and)? (?:stand|wait|sit|be|position yourself|park|stop) (?:right )?(?:in front of"
            r"|opposite|across from|facing) "
        ),
        "go to ",
    ),
    (
        (
            r"\b(?:stand|wait|stop|park|stay|sit) (?:yourself )?(?:right |just )?(?:in front of|opposite|across from"
            r"|facing|outside) "
        ),
        "go to ",
    ),
    (r"\bcome in(?:to)? (?=(?:the|my|our)\b)", "go to "),
    (r"\bafter(?: that| this| wards)?(?=[.!]*$)", "afterwards"),
    (
        (
            r"\b(go|come|drive|head|get|return|run) back(?: again)? to where (?:you|we) (?:are|were"
            r"|started|began|came from|set off|left)(?: from)?"
            r"(?: now| right now| before| out| at)?"
        ),
        r"go to your starting point",
    ),
    (
        (
            r"\b(?:return|back(?: again)?) to (?:where (?:you|we) (?:are|were|started|began|came from"
            r"|set off|left)(?: from)?(?: now| right now| before| out| at)?"
            r"|your (?:start|starting (?:place|spot|position|point)|current (?:place|spot|position)"
            r"|original (?:place|spot|position)))"
        ),
        "go to your starting point",
    ),
    (r"\b(?:come|go|head|get|drive) (?:back )?home to (?=(?:the|my)\b)", "go to "),
    (
        (
            r"^(?:they|he|she|everyone|everybody|(?!i\b|we\b)\w+) (?:wants?|needs?|expects?) you (?:(?:down|up|over"
            r"|back|out"
            r"|round|along|to be|to come|to go|now) )*(?=(?:in|at|by|near|next to)\b)"
        ),
        "go ",
    ),
    (
        (
            r"((?:\band|\bthen|,) )(?:stay|wait|stand|remain|stop|hang|stick|sit)(?: (?:put|still"
            r"|around|tight|by|right))+(?= there| here| for (?:me|us)|$|[.!?,;])"
        ),
        r"\1stay",
    ),
    (r"((?:\band|\bthen|,) )(?:stop|hang around|sit)(?=(?: right)? (?:there|here)(?:$|[.!?,;]))", r"\1stay"),
    (r"\bcome(?: and)? see me\b", "come to me"),
    (r"\bturn (?:a)?round and (?=(?:come|go|drive|head)\b)", ""),
    (r"(?:,| and|, and) then home to (?=the\b)", ", then go to "),
    (
        (
            "^(?:please )?(?:make |take |do )?(?:a |one )?(?:quick |short |little |brief )?(?:trip|tour|visit"
            "|run|detour|round|outing) to (.+?) and back(?: again)?(?=[.!]*$)"
        ),
        r"go to \1, then go to your starting point",
    ),
    (
        "^(.+?) is where (?:i|we) (?:want|need|would like|expect) you(?: to (?:be|go|wait|stand|come))?(?=[.!]*$)",
        r"go to \1",
    ),
    ("^(?:off|away|on|out) (?:you go )?to (.+?)(?: with you)?(?=[.!]*$)", r"go to \1"),
    (
        (
            "^(?:please )?(?:make |take |do )?(?:a |one )?(?:quick |short |little |brief )?(?:trip|tour|visit"
            "|run|detour|round|outing) to "
        ),
        "go to ",
    ),
    (
        (
            r"\b(?:go (?:and )?)?(?:take|have|grab|get) a (?:quick |little |brief |short )?(?:peek|look|glance"
            "|peep|gander) (?:in|into|inside|around|round|at) "
        ),
        "go to ",
    ),
    (r"\b(?:right|straight|directly|immediately) back\b", "back"),
    (
        (
            r"\b(?:go|come|run|drive|head|pop)(?: over)? and (?:see|check|look|find out) (?:whether"
            r"|if) (\w+) is (?:in|there|around|home|at home|awake|ok|okay|alright)\b"
        ),
        r"go to \1",
    ),
    (r"(?:,? and|,? then|,)+ (?:on|off|over|along) to (?=(?:the|my)\b)", ", then go to "),
    (r"\b(?:and|then) return(?=$|[.!?,])", "then come back"),
    (r"\b(?:be|get yourself|show up|turn up|report) (?=(?:in|at|by) the\b)", "go "),
    (r"\b(?:go|drive|head|move) (?:back )?home\b", "come back"),
    (
        (
            r"\b(?:and|then) (?:get|come|head|drive|go|walk|run|be) back(?: here| again| to (?:me|us)"
            "| afterwards)*(?=$|[.!?,])"
        ),
        "then come back",
    ),
    (r"\b(?:and|then) back(?: again| here)*(?=$|[.!?,])", "then come back"),
    (r"\b(?:and|then) (?:report|return|go|come) back(?: to me| here)?(?=$|[.!?,])", "then come back"),
    (
        (
            r"\b(?:go )?(?:and )?(?:have a (?:quick )?look|take a (?:quick )?look|peek|peep|pop|look in|nip"
            "|dash|hop) (?=(?:in|into|at|round|over) )"
        ),
        "go ",
    ),
    (r"\bgo (?:in|into|at|round|over) (?=(?:the|my) )", "go to "),
    (r"\bgo (?:and )?(?:check|inspect|check on|check out|see) (?=the [\w ]+?(?:$| and| then|,))", "go to "),
    (r"^(?:please )?check (?:on |out )?(?=the [\w ]+?(?:$| and| then|,))", "go to "),
    (r"\b(go to [^,.;!?]+?) with you(?: now| then| please)?(?=[.!]*$|,)", r"\1"),
)
"""In the order in which they are tried."""
