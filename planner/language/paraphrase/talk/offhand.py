"""The curt, the small and the rude: *hey tin can, remote*, *banana. Tom. go.*, *my doll wants to come to me*."""

from __future__ import annotations

_INSULT = (
    r"(?:tin (?:can|man|head)|rust ?bucket|bucket of bolts|scrap ?heap|heap of (?:junk|scrap)|toaster|clanker"
    r"|metal ?head|blockhead|dumbo|dummy|dumb ?ass|dimwit|stupid|idiot|moron|fool|slow ?poke|lazy "
    r"?bones|silly(?: billy)?"
    r"|machine|robot|bot|thing|contraption|gizmo|lump|servant|slave|jerk|numpty|muppet|doofus|goofball|blockhead)"
)
_ADJECTIVE = (
    r"(?:useless|stupid|dumb|silly|lazy|slow|rusty|old|bloody|damn|damned|blasted|worthless|good for nothing|wretched"
    r"|daft|clumsy|big|fat|little|lousy|pathetic|darn|clever|smart|cute|metal)"
)
_SHORT = r"[a-z']+(?: [a-z']+)?(?: [a-z']+)?"
_BARE = (
    r"(?!(?:bring|take|put|go|get|fetch|give|come|carry|move|find|drop|return|look|hand|pick|place|pass|grab|drive|stop"
    r"|wait|stay|no|yes|yeah|ok|okay|hey|yo|hi|oi|turn|is|are|what|where|who|which|how|i|you|it|not|do)\b)"
    r"[a-z']+(?: [a-z']+){0,2}"
)
_HURRY = r"(?:go|go go(?: go)?|now|move|move it|quick|quickly|hurry(?: up)?|chop chop|pronto|asap|fast|come on)"
_BRING = r"(?:bring|give|get|fetch|hand|pass|take|carry|deliver)"
_NP = r"(?:the|my|that|this|his|her|our|an?) [\w' ]+?"
_PLAIN_NP = (
    r"(?:the|my|that|this|his|her|our)"
    r"(?: (?!(?:is|are|was|were|has|have|had|will|does|did|fell|broke|smells|looks|belongs|goes)\b)[\w']+)+?"
)
_KIN = (
    r"(?:(?:my |the |our )?(?:mum|mom|mummy|mommy|mama|dad|daddy|papa|grandma|granny|grandpa|teacher|nurse|doctor|boss"
    r"|sister|brother|wife|husband|everyone|everybody)|she|he|they|[a-z]+)"
)

SCOLDING: tuple[tuple[str, str], ...] = (
    (rf"^(?:(?:hey|oi|oy|yo|hi|ok|well|now|listen),? )?you (?:{_ADJECTIVE},? )*{_INSULT}[,!.:]+ (?=\w)", ""),
    (rf"^(?:hey|oi|oy|yo),? (?:{_ADJECTIVE},? )*{_INSULT}[,!.:]+ (?=\w)", ""),
    (rf"(?<=\w), (?:you )?(?:{_ADJECTIVE},? )*{_INSULT}(?=[.!?,]|$)(?<!thing)(?<!can)(?<!toaster)", ""),
    (r"(?<=\w),? (?:pretty|pwetty|pretty pretty|oh) (?:please|pwease|pleeease)(?: with .*?)?(?=[.!?]*$)", ""),
)
"""Names that robots are called, before greetings are dropped."""

OFFHAND: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:(?:i|we) (?:was|were|am|are) (?:just )?(?:(?!to\b|not\b)[\w']+ ){1,5}(?:and|when) "
            r"(?:then )?)?(?:i|we) "
            r"(?:just )?(?:noticed|realized|realised|notice|realize|realise|see|saw|found)(?: out)?(?: that)? "
            r"(?=(?:i|we|there|my|the) (?:[\w']+ )?(?:do not|have no|is no|is gone|is missing|can not"
            r"|lost|have lost|forgot)\b)"
        ),
        "",
    ),
    (
        (
            rf"^(?:i|we) (?:do not|did not) (?:have|see|find) ({_NP})(?: (?:here|with me|any ?more|on "
            rf"me))?,? (?:so |and |but )*(?:please |can you |could you "
            rf"|will you )*(?:bring|get|fetch|give|hand)(?: me)? (?:it|them|that)(?: to me| here| over| me"
            rf"| please)*(?=[?.!]*$)"
        ),
        r"bring me \1",
    ),
    (
        (
            rf"^({_NP}) (?:is|are) (?:gone|missing|lost|nowhere(?: to be (?:found|seen))?|not (?:there"
            rf"|here|in (?:its|his|their) place)(?: any ?more)?"
            rf"|no longer (?:there|here|(?:on|in|at) [\w' ]+?)|not (?:on|in|at|next to) [\w' ]+? any "
            rf"?more)[,.;!]* (?:so |and )*(?:please |can you |could you |will you |go |and )*"
            rf"(?:find|look(?: around| about)? for|search for|seek|look where) (?:it|them)(?: is| are)?(?: "
            rf"for me| please)*(?=[?.!]*$)"
        ),
        r"find \1",
    ),
    (
        (
            rf"^(?:check (?:on|up on)|look in on|look after) ({_NP}),? (?:and )?(?:go|drive|head|move) "
            rf"(?:over )?there(?=[.!]*$)"
        ),
        r"go to \1",
    ),
    (r"^(?:it is |this is )?(?:only |just )?me again[,.! ]*(?=\w)", ""),
    (
        rf"^({_PLAIN_NP}),? (can|could|may|might|should|would) (?:it|that|they|those|this|these) (?=(?:go|be|come)\b)",
        r"\2 \1 ",
    ),
    (r"(?<=[,.;] )(?:can|could|may|might) (it|they|that|those) go (?=(?:on|in|into|onto|to|next)\b)", r"put \1 "),
    (r"\b([a-z]+)(?:'s| is) the one (?:who|that) (wants|needs|asked for|ordered|would like|gets|likes)\b", r"\1 \2"),
    (r"^((?:my|the|his|her) [\w' ]+?) (?:wants|would like) to (?:come|be brought|go) to (?=\w)", r"bring \1 to "),
    (
        (
            rf"^{_KIN} (?:says|said|thinks|insists|told me|tells me|reckons)(?: that)? (?={_NP} (?:should"
            rf"|must|has to|have to|needs? to|goes|belongs?|ought to)\b)"
        ),
        "",
    ),
    (
        rf"^(?:the |my )?({_BARE})[.!] ({_SHORT})[.!] (?:to )?(?:here|me|over here)(?:[.!,]+ {_HURRY})*[.!]*$",
        r"bring me the \1 from \2",
    ),
    (rf"^({_BARE})[.!] (?!here\b|me\b)({_SHORT})(?:[.!,]+ {_HURRY})+[.!]*$", r"\1. \2."),
    (rf"^((?:the |my |that |an? )?{_BARE}),? (?:over|right over|right) here(?:[.!,]+ {_HURRY})*[.!]*$", r"bring me \1"),
    (
        (
            rf"^(?:can|could|may) (?:i|we) (?:play with|read|eat|drink|use|borrow|look at|wear|try|draw "
            rf"with|write with) "
            rf"({_NP})[?.,!]+ (?:please |then |so )*(?:can you |could you )?{_BRING}(?: me)?(?: it)?(?: to "
            rf"me| here| over| me)?(?=[?.!]*$)"
        ),
        r"bring me \1",
    ),
)
"""In the order in which they are tried."""
