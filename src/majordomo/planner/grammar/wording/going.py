"""Ways of sending the robot somewhere, or to find something."""

from __future__ import annotations

FINDING: tuple[tuple[str, str], ...] = (
    (r"^(?:i|we) (?:need|have|want|ought|got) to (?=(?:find|locate|look for|search)\b)", ""),
    (
        (
            r"^((?:the|my|our|his|her) [\w ]+?) (?:has|have) (?:gone missing|disappeared|vanished|got lost|gone astray)"
            r"[,.;]+ (?:so |please |can you |could you )*(?:go )?(?:and )?(?:look|search) for (?:it|them)(?=[.!?]*$)"
        ),
        r"find \1",
    ),
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

GOING: tuple[tuple[str, str], ...] = (
    (
        (
            r"^(?:please )?(?:roll|wander|stroll|trundle|zoom|wheel|mosey|scoot|trot|be)(?: on| off| over| out| down"
            r"| up| along| across)+ (?=(?:to|into) )"
        ),
        "go ",
    ),
    (
        r"^(?:they|he|she|everyone|everybody|(?!i\b|we\b)\w+) (?:wants?|needs?) you (?=(?:in|at|by|near|next to)\b)",
        "go ",
    ),
    (
        (
            r"(?<=\w),? and (?:then )?(?:stop|stay|wait|remain|stand)(?: put| still)?(?: right)?(?: there)?"
            r"(?: for me)?(?=[.!?]*$)"
        ),
        "",
    ),
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
    (r"\bgo off to (.+?) with you(?=[.!]*$)", r"go to \1"),
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
    (r"\bback to where you are(?: now| right now)?\b", "to your starting point"),
    (r"^(?:i|we) (?:need|want|would like) you (?:over |to be |to come )?(?=(?:in|at|by|near|next to)\b)", "go "),
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
)
"""In the order in which they are tried."""
