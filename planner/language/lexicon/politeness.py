"""Words that carry courtesy, not meaning; they are dropped."""

from __future__ import annotations

FILLERS: tuple[str, ...] = (
    "please", "pls", "run and", "hurry and", "hurry up and", "rush and", "dash and", "run over and", "head over and",
    "go over and", "go ahead and", "be quick and", "kindly", "just", "now", "right now", "right away", "quickly",
        "quick", "carefully",
    "immediately",
    "thanks", "thank you", "thank you very much", "many thanks", "ok", "okay", "hey", "hello", "hi", "robot",
    "majordomo",
    "butler", "jeeves", "dear", "if you can", "if you could", "if possible", "if you please", "if you do not mind",
    "if you would", "if it is not too much trouble", "as soon as possible", "asap", "well", "so", "um", "uh", "er",
    "hmm",
    "really", "actually", "straight", "directly", "gently", "go ahead and", "do me a favor and", "do me a favour and",
    "be so kind and", "be so kind as to", "be a dear and", "would you mind", "do you mind", "would you", "will you",
    "i want you to", "i would like you to", "i need you to", "i would love you to", "you should", "you must",
    "you need to",
    "you have to", "your task is to", "your job is to", "let us", "lets", "good morning", "good evening",
    "good afternoon",
    "excuse me", "sorry", "for a second", "for a moment", "real quick", "try to", "help me to", "help me and",
    "alright",
    "all right", "go and", "come and", "sir", "mate", "buddy", "kind sir", "my friend",
    "when you get a chance", "when you have time", "when you can", "i was wondering if you could",
    "could you possibly",
    "do you think", "any chance", "is there any chance", "is there a chance", "is it possible",
    "is it possible for you to",
    "is it ok if", "i was hoping", "i was wondering", "i was wondering if", "i am hoping", "i wonder if you could",
    "would you be able to", "are you able to", "would you be willing to", "would you be so kind as to",
    "would you be so kind", "so kind as to", "mind", "if you would not mind", "if you would be so kind",
    "i need someone to",
    "when you have a minute", "when you have a moment", "when you get a minute", "when you get a moment",
    "when you have a second", "when you are free", "when you are ready", "whenever you can", "whenever you have time",
    "if you have time", "if you have a moment", "if you have a minute", "if you get a chance", "when convenient",
    "if that is ok", "if that is okay", "if it is not too much bother", "if it is no trouble", "at your convenience",
    "i would like for you to", "i would love for you to", "i would appreciate you", "i am asking you to",
    "i would ask you to",
    "can i ask you to", "could i ask you to", "may i ask you to", "could i trouble you to", "can i trouble you to",
    "to begin with", "to start with", "to start", "for starters", "do the following", "from now on",
    "remember that", "note that", "here is what i want", "listen", "be a love and", "be a pal and",
    "be a good robot and",
    "there is a good robot", "good robot", "cheers", "ta", "much appreciated", "thank you so much", "thanks a lot",
    "thanks so much", "thanks in advance", "thx", "ty", "plz", "there you go", "ok then", "well then", "right then",
    "next up", "your next task is to", "i have a task for you", "here is a task", "one more thing", "that is all",
    "nothing but", "only", "would you please", "could you please", "can you please",
    "for a sec", "a sec", "at once", "hurry", "hurry up",
    "quick as you can", "as quickly as you can", "as fast as you can", "as soon as you can", "when you are at it",
    "while you are at it", "while you are there", "while you are here", "while there", "for a change", "by the way",
    "i think", "i guess", "i suppose", "i believe", "you know", "you see", "that you saw", "you saw", "you have seen",
    "that you have seen", "which you saw", "that you know of", "you know of", "you found", "that you found",
    "need you to", "want you to", "would like you to", "make sure to", "be sure to", "do not forget to",
    "remember to",
    "start by", "begin by", "go ahead", "in order to", "perhaps", "maybe", "yo", "dude", "possibly", "currently",
)  # fmt: skip
"""Words that carry courtesy, not meaning; dropped."""

POLITE_IF_VERB = frozenset(
    {"can you", "could you", "do you", "go", "come", "you", "to", "you can", "you could", "you have", "you would"}
)
"""Dropped when an action verb follows: *can you bring*, *go get*; kept in *can you see*."""

FRAMES: tuple[str, ...] = tuple(
    f"{opening} {link}"
    for opening in (
        "it would be great", "it would be nice", "it would be lovely", "it would be good", "it would be wonderful",
        "it would be helpful", "it would help", "it would be fantastic", "it would be really great",
        "it would be kind",
        "i would appreciate it", "i would be grateful", "i would be happy", "i would be glad", "i would be pleased",
        "i would be thankful", "i would be delighted", "i would like it", "i would love it", "would it be possible",
        "would it be ok", "would it be okay", "would it be alright", "it is time", "i would be much obliged",
        "would you mind", "do you mind", "i was wondering", "i would be obliged", "i wonder", "i would prefer it",
        "see",
    )
    for link in ("if you", "if you could", "if you can", "if you would", "that you")
)  # fmt: skip
"""Courtesy that leads up to a verb, which may stand in the past: *I'd appreciate it if you brought …*."""

ADVERBS = frozenset(
    {"really", "just", "together", "uh", "err", "um", "er", "erm", "hm", "hmm", "ah", "oh", "kindly", "please",
        "pls", "plz", "possibly", "maybe", "perhaps", "actually", "simply",
    "exactly",
     "exact", "somehow", "basically", "quite", "honestly", "anyway", "immediately", "quickly"}
)  # fmt: skip
"""Dropped wherever they stand, before anything else is read."""
