"""Who wants to see the robot, and how one looks in on somebody: *Emil would like to see you*, *see how Leo is*."""

from __future__ import annotations

_WHO = r"((?!(?:i|we|it|that|this|what|who|if|when|nobody|someone|somebody)\b)[a-z]+(?: [a-z]+)??)"
_GO = (
    r"(?:[,.;!]+ (?:so |please |can you |could you |and )*(?:go|come|drive|head|pop|run|"
    r"walk)(?: over| on over| along| down| up)*"
    r"(?: (?:to|see|and see|and meet|and join|and find|meet|join|find|visit) (?:him|her|them)| there| over there)"
    r"(?: please)?)"
)
_PLACE = r"((?:in|at|on|by|near|next to) [^,.;!?]+?)"

_WATCH = (
    r"(?:keep (?:an eye|watch) (?:on|over)|look after|watch(?: over)?|mind|man|check(?: on)?|see to|attend to|hold "
    r"the fort"
    r" (?:in|at)|(?:be|stay|go|stand) (?:in|at|by|on duty (?:in|at))|stand guard (?:in|at|by)|wait (?:in|at|by))"
)

VISITING: tuple[tuple[str, str], ...] = (
    (
        (
            r"(?:,|;| and| then|, and|, then|, and then) (?:finally )?(?:finish|end|conclude|wind up"
            r"|stop)(?: off| there)? "
            r"(?=(?:in|at|by|near) (?:the |my |our |room |ward |office |meeting )?\w+(?: \w+)?[.!]*$)"
        ),
        ", then go ",
    ),
    (r"(?<=\byou )(?:(?:kindly|please|just|quickly|possibly|simply|also|maybe|perhaps) )+(?=\w)", ""),
    (
        (
            rf"^(?:some(?:one|body)|you|the robot) (?:has|have|needs?|ought|is supposed|had better|should|must)(?: "
            rf"to)? "
            rf"{_WATCH} "
            rf"([^,.;]+?)"
            r"[,.;]+ (?:so |and |then |that is you, )*(?:off you go|off with you|go|go there|over there with you|you "
            r"go|"
            r"it is you|you do it|go on|get going|(?:can|could|will|would) you(?: go| do it)?)(?: now| then| "
            r"please)?(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            r"\b(wait|stay|stand by|hang around|look out) for (?!me\b|us\b|him\b|her\b|it\b|them\b)(?:(?:the|my|our"
            r"|his|her) "
            r")?\w+(?: \w+)? (?=(?:in|at|by|near|next to|outside) (?:the|my|our|\w+))"
        ),
        r"\1 ",
    ),
    (
        (
            r"\b(?:show|present|install|station|base) (?:yourself|your face|your nose)(?: please| now| quickly)? "
            r"(?=(?:in|at|to|by|near)\b)"
        ),
        "go ",
    ),
    (r"\b(go|come|drive|head|run|walk|get) as far as ", r"\1 to "),
    (
        (
            r"\b(come|get|be|drive|head|go) (?:straight |right )?back(?: here| to me)?(?: and|,|, and) (?:then "
            r")?(?:tell|report(?:"
            r" back)? to|inform|let) (?:me|us)(?: know)?(?: about it| about that| (?:what|who|if|whether|how) "
            r"[^,.;!?]+)?"
            r"(?=[.!]*$)"
        ),
        r"\1 back to me",
    ),
    (
        (
            r"\b(?:go|run|pop|drive|nip|head) (?:over )?(?:and )?(?:see|check|look|find out) (?:whether|if) (\w+) is "
            r"((?:in|at|by|on) (?:the|my|his|her|\w+'s) [\w' ]+?)(?=,| and | then |[.!]*$)(?<!still)"
        ),
        r"go \2",
    ),
    (
        r"^(?:(?:do|make|take) )?(?:a |the |one )?(?:round ?trip|grand tour|quick tour|round|tour|route|itinerary): ",
        "go to ",
    ),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou ))(?:pass|go|come|drive|roll"
            r"|walk|swing|"
            r"stop|drop|pop|call|nip|look)(?: (?:over|round|around|along))? (?:by|past|in on|off at|by at) (?:to )?"
            r"(?=(?:the |my |our )?\w)(?!(?:putting|taking|bringing|going|using)\b)"
        ),
        "go to ",
    ),
    (
        r"\b(?:go|drive|walk|head|travel|come)(?: over| on)? (?:via|through|by way of|past) ([^,.;]+?) to (?=\w)",
        r"go to \1, then go to ",
    ),
    (
        (
            r"\b(?:go|drive|walk|head|travel)(?: over| on)? (?:in)?to ([^,.;]+?),? (?:but )?(?:via|through|by way of|"
            r"past) ([^,.;]+?)(?=[.!]*$)"
        ),
        r"go to \2, then go to \1",
    ),
    (
        (
            rf"^{_WHO} (?:wants|needs|would like|wishes|would love|has) to (?:see|meet|talk to|"
            rf"speak to|speak with|talk with|have)"
            rf" you {_PLACE}{_GO}?(?=[.!]*$)"
        ),
        r"go to \1 \2",
    ),
    (
        (
            rf"^{_WHO} (?:wants|needs|would like|wishes|would love|has) to (?:see|meet|talk to|"
            rf"speak to|speak with|talk with) you"
            rf"{_GO}?(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            rf"^{_WHO} (?:is|has been|keeps) (?:asking|looking|waiting|calling|shouting|hoping|"
            rf"yelling|crying) for you {_PLACE}{_GO}"
            r"(?=[.!]*$)"
        ),
        r"go to \1 \2",
    ),
    (
        (
            rf"^{_WHO} (?:is|has been|keeps) (?:asking|looking|waiting|calling|shouting|hoping|"
            rf"yelling|crying)(?: (?:for|on) you)?"
            rf"{_GO}(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            rf"^{_WHO} (?:wants|needs|expects|would like|requests|is expecting) you {_PLACE}(?: "
            rf"now| right now| please)?(?=[.!]*$)"
        ),
        r"go \2",
    ),
    (
        (
            r"\b(?:go |come |run |pop )?(?:over )?(?:and )?(?:see|check|look|find out|ask) (?:how|"
            r"what|whether|if) (\w+(?: \w+)?) "
            r"(?:is|are) (?:doing|up to|feeling|getting on|ok|okay|all right|alright|well|fine|"
            r"keeping|coming along)(?=[.!?,]*$|,)"
        ),
        r"go to \1",
    ),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease ))(?:move|go|get|come|"
            r"drive|roll) out of (?:here|there|"
            r"this room|the [\w ]+?)(?:,| and)+ (?:then )?(?:go )?(?:over )?(?:in)?to "
        ),
        "go to ",
    ),
    (
        (
            r"\b(?:make|do|take|go on|go for) (?:a|the|your|one) (?:little |quick |short )?(?:round|"
            r"rounds|tour|trip|circuit|lap|"
            r"loop)(?: of| through| past| via)?(?: the rooms?)?[:,]* (?=(?:the |my )?\w+,)"
        ),
        "go to ",
    ),
    (
        (
            r"^((?:the |my )?(?!(?:go|drive|come|bring|take|put|to|into|pop|run|nip|walk|visit|"
            r"please|off|over|out|look|move|head|"
            r"get|fetch|find|see)\b)\w+(?: (?!to\b|into\b|in\b|the\b)\w+){0,2}?),? and (?:then )?(?:straight |right )?"
            r"back (?:here |again )?(?:to me|here|again)(?=[.!]*$)"
        ),
        r"go to \1, then come back to me",
    ),
    (r"(?:,| and|, and)(?: then)? be (?:back )?(?=(?:at|in) (?:the|my|\w+)\b)", " and go "),
    (r"\b(and go (?:at|in) [^,.;]+?) (?:after (?:that|this)|afterwards|then)(?=[.!]*$)", r"\1"),
    (
        (
            rf"^{_WHO} (?:wants|needs|would like|wishes|expects) you to "
            r"(?:come|(?:drop|pop|swing|stop) (?:by|over|round|in))"
            r"(?: (?:by|over|round|around|in|along|up|down))*(?: to (?:see )?(?:him|her|them))?(?: now|"
            r" please)?(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            r"\b(?<!need )(?<!needs )(?<!wants )(?<!is )(?<!are )"
            r"(?:popping|nipping|heading|driving|coming|walking|rolling|moving|running|stepping|swinging|wandering"
            r"|scooting|trundling|hopping|dashing|zipping|strolling|trotting)(?: yourself)?"
            r"(?: (?:over|down|up|along|across|back|through|round|around|out|off|on))* (?:in)?to (?=\w)"
        ),
        "going to ",
    ),
    (
        r"\b(go(?:ing)? to [^,.;!?]+?) for (?:a|one|half a) (?:sec|second|bit|minute|mo|moment|while|tick)(?=[.!?]*$)",
        r"\1",
    ),
    (r"\b((?:over )?here),? (?:to )?where (?:i|we) (?:am|are)(?: now| standing| sitting)?(?=[.!?,]|$)", r"\1"),
    (
        (
            r"\b(?:let us|i want to|i would like to|can i|can we|could i|could we|i will|we will|may i) have you "
            r"(?:over |back |down |up )?(?=(?:in|at|by|near|next to) )"
        ),
        "go ",
    ),
    (
        r"\b(?:follow|take|go down|go along) the (?:hall|hallway|corridor|passage)(?: (?:along|down|up))* to (?=\w)",
        "go to ",
    ),
    (
        (
            r"\b(?:be|wait) ((?:in|at|by) [^,.;!?]+?) (?:when|before|by the time|until) (?:i|we) (?:get|come|arrive|am"
            r"|are|return)(?: there| back| home| in| over)*(?=[.!?]*$)"
        ),
        r"go \1",
    ),
    (
        (
            r"\b(?:move|go|drive|come|get|roll|step|pull|edge) (?:(?:a (?:little |tiny )?bit|a little|much|right|in|up)"
            r" )*(?:closer|nearer|close|up) to (?=\w)"
        ),
        "go to ",
    ),
    (
        (
            r"\b(?:move|go|get|come|step|drive|back|keep) (?:away|off|clear) (?:from|of) [^,.;]+?(?:,| and)+ (?:then )?"
            r"(?:go|come|drive|move|head)(?: over| back)? (?=(?:in)?to )"
        ),
        "go ",
    ),
    (r"\b(?:nav|navig|navigat)\b(?: to)? (?=\w)", "go to "),
    (r"\breport (?:back )?to (\w+(?: \w+)?) (?=(?:in|at) (?:the |my |\w+[.!]*$))", r"go to \1 "),
    (
        (
            r"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou ))(?:scoot|pop|nip"
            r"|hop|roll|trundle"
            r"|head|run|walk|wander|step|swing|shuffle|drive|zip)(?: (?:over|down|up|along|across|back"
            r"|round|around|on))*"
            r" (?=(?:next to|beside|near|by) (?:the|my|\w+'s)\b)"
        ),
        "go ",
    ),
    (
        (
            r"^((?:please |can you |could you |would you |will you |you can |just )*(?:go (?:and )?)?(?:go"
            r"|drive|wait|stay|stand"
            r"|remain|stop|sit|park)\b[^,.;]*?),? (?:until|till) (?:i|we|he|she|they|someone|somebody|(?:the )?\w+ "
            r"(?:is|are|has|comes|calls|needs|wants|gets|arrives|returns))\b[^,.;]*(?=[.!?]*$)"
        ),
        r"\1",
    ),
    (
        (
            r"\bi (?:want|need|would like|would love|expect) you (?:to be )?(?:standing|waiting|sitting"
            r"|parked|stationed"
            r"|positioned|ready|staying|posted)(?: right)? (?=(?:in|at|by|on|near|next|beside|outside)\b)"
        ),
        "go ",
    ),
    (
        (
            r"^(?:hey |oh |sorry |watch out |careful )*you are (?:standing |sitting )?(?:in (?:the|my|our|everyone's) "
            r"(?:way|road|light)|blocking (?:the|my|our) \w+|too close|not (?:needed|wanted) here|under our feet)"
            r"(?: over| right)?(?: there| here| again)*[,.;!]+ (?:so |and |please )*"
            r"(?=(?:go|move|drive|get|come|head|roll|wait|stand|step)\b)"
        ),
        "",
    ),
    (
        (
            r"^(?!(?:i|we|it|that|who|if|they|he|she|you|nobody|someone|somebody)\b)((?:[a-z]+ )?[a-z]+) (?:needs|wants"
            r"|would like to see|wants to see|needs to see|wishes to see|has called for|sent for) you"
            r"(?: now| please| at once| urgently| right away| over)*(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (
        (
            r"^(?:one |an? |your |the |do )*(?:round ?trip|rounds?|tour|route|itinerary|stops|stations)(?: please| for"
            r" you| today| now)*[:,] ([^,.;:]+?), ([^,.;:]+?),? (?:and |then )*([^,.;:]+?)(?=[.!]*$)"
        ),
        r"go to \1, then go to \2, then go to \3",
    ),
    (
        (
            r"^(?:one |an? |your |the |do )*(?:round ?trip|rounds?|tour|route|itinerary|stops|stations)(?: please| for"
            r" you| today| now)*[:,] ([^,.;:]+?)(?:,| and| then)+ ([^,.;:]+?)(?=[.!]*$)"
        ),
        r"go to \1, then go to \2",
    ),
    (
        r"\b(back (?:over |down |up )?to (?:the|my|our) [\w ]+?) again(?=$|[.,!?])",
        r"\1",
    ),
)
"""In the order in which they are tried."""
