"""Slips of the keyboard, courtesy and motives: what is typed around a request."""

from __future__ import annotations

SLIPS: tuple[tuple[str, str], ...] = (
    (r"\b(?:teh|hte|th)\b", "the"),
    (r"\b(?:adn|nad|n)\b(?= )", "and"),
    (r"\bgoto\b", "go to"),
    (r"\b(?:form)\b(?= the\b)", "from"),
    (r"\b(go|goes|come|drive|head|back|walk|move) (?:too|ot|2)(?= )", r"\1 to"),
    (r"\b(?:u+m+|e+r+m+|u+h+m*|h+m+|pleas|plase|pleese|pls+|plz+|plox|thx|tnx|thanx)\b(?=.)", "please"),
    (r"\byuo\b", "you"),
    (r"^(?:wher|whre|were)(?= (?:is|are)\b)", "where"),
    (r"\b(?:fo|4|fro)(?= (?:me|you|her|him)\b)", "for"),
    (r"\bhw many\b", "how many"),
)
"""Words that are no English, and what was meant."""

COURTESY: tuple[tuple[str, str], ...] = (
    (
        (
            "^(?:so,? )?(?:i was (?:just )?(?:thinking|wondering|hoping)|i have been thinking)[,.]* (?=it|can"
            "|could|would)"
        ),
        "",
    ),
    (
        (
            "^(?:i am|we are|he is|she is) (?:so |really |very |a bit |a little |quite |feeling )*(?:thirsty"
            "|hungry|cold|tired|bored|busy|sick|late|hot|in a hurry|starving|freezing)[,.!;:]*(?: and"
            r"| so)? (?=\w)"
        ),
        "",
    ),
    (
        (
            r",? (?:because|cause|cuz) (?:i|we|he|she|it|they|my|the \w+|\w+) (?:am|is|are|was|have|has|need"
            r"|needs|want|wants|would|will|can not|feel|feels|forgot)\b[^.;!?]*(?=$|[.;!?])"
        ),
        "",
    ),
    (
        (
            ",? so (?:that )?(?:i|we|he|she|they|it) (?:can|could|will|may|do not|does not|is|are"
            r"|am)\b[^.;!?]*(?=$|[.;!?])"
        ),
        "",
    ),
    (
        (
            "^(?:hey|hi|ok|okay|oh|well|so|and|now|right|alright|listen|hello|yo|good|great|thanks|thank you"
            "|cool|perfect)[,!.]+ "
        ),
        "",
    ),
    ("^i(?: would|) (?:need|want|like|love|prefer)(?: for)? you to ", ""),
    (r"\b(?:for|to) the (?:moment|time being)\b", ""),
)
"""Openings, moods and reasons; they change nothing in what is asked."""

UNDOING: tuple[tuple[str, str], ...] = (
    (
        "^(?:please )?(?:undo|reverse|revert) (?:that|it|this|the last (?:one|step|thing|move|task))[.! ]*$",
        "put it back where it was",
    ),
    (
        (
            "^(?:please )?(?:never mind|nevermind|forget it|stop|wait|no)[,.;:!]+ (?=(?:put|take|return"
            r"|bring) (?:it|them|that|the \w+) back\b)"
        ),
        "",
    ),
    (r"^(?:please )?(?:never mind|nevermind|forget it)[,.;:]* (?=(?:put|take|return|bring)\b)", ""),
    (
        (
            r"\b(?:i|you|we|he|she|they|someone|somebody) (?:have |had |just )*(?:left|put|placed|dropped|forgot"
            "|laid|set|saw)(?: lying| standing| down)? (?=(?:on|in|at|next|by|near) )"
        ),
        "that is ",
    ),
)
"""Taking back, in a word."""
