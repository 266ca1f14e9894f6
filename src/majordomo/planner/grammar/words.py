"""The closed-class words of a command and the terminal each belongs to; all else is a noun of the graph or unknown.

A word has exactly one terminal; words with several uses (*take*, *one*, *that*) have a terminal of their own, which the
grammar mentions wherever the word may stand. Phrases match before their single words.
"""

from __future__ import annotations

from majordomo.planner.grammar.unable import UNABLE
from majordomo.planner.vocabulary import COLORS

VERBS: dict[str, tuple[str, ...]] = {
    "BRING": ("bring", "fetch", "retrieve", "grab me", "bring over", "bring back", "bring along"),
    "GET": ("get",),
    "TAKE": ("take",),
    "CARRY": ("carry", "deliver", "transport", "transfer", "haul", "ferry"),
    "MOVE": ("move", "relocate", "shift"),
    "RETURN": ("return",),
    "GIVE": ("give", "hand", "pass", "hand over", "serve"),
    "PUT": ("put", "place", "set", "lay", "deposit", "stow", "stick", "put away"),
    "DROP": ("drop", "drop off", "leave", "release", "let go of"),
    "GO": ("go", "drive", "navigate", "walk", "head", "travel", "proceed", "roll", "run", "go over", "go on over"),
    "VISIT": ("visit", "enter", "approach", "go see"),
    "COME": ("come",),
    "FIND": ("find", "locate", "look for", "search for", "seek", "hunt for", "look out for", "go find", "try to find"),
    "SEARCH": ("search", "look through", "look around in", "check"),
    "LOOK": ("look",),
    "PICK": ("pick", "pick up", "grab", "grasp", "lift", "lift up", "collect", "hold", "take hold of", "get hold of"),
    "ENSURE": ("make sure", "make sure that", "ensure", "ensure that", "see to it that"),
    "WANT": ("i want", "i would like", "i need", "i would love", "we need", "we want", "i could use", "can i have",
             "could i have", "may i have", "can i get", "could i get", "i will have", "i will take"),
}  # fmt: skip
"""Verbs the robot can act on."""

NOUNLIKE = frozenset(
    {
        "water", "iron", "book", "light", "brush", "comb", "paint", "plant", "drill", "hammer", "saw", "tape",
        "glue", "screw",
        "watch", "lock", "mop", "dust", "drink", "play", "call", "text", "email", "order", "print", "show", "record",
        "film",
        "park", "ring", "tie", "rake", "shovel", "shower", "charge", "plug", "guide", "lead", "answer", "press",
        "nurse",
        "clean", "dry", "warm", "empty", "open", "switch", "place", "set", "hand", "run", "drive", "walk", "lift",
        "return",
        "pass", "search", "hold", "head", "drop", "pick", "stick", "check", "trim", "dress", "pack", "load",
        "cut",
        "stack", "pile", "share", "race", "ride", "cook", "slice", "roll", "move", "turn", "fold", "wrap", "break",
        "fly",
    }
)  # fmt: skip
"""Verbs that are nouns or adjectives as well; they act as verbs only at the start of a clause, before a noun phrase."""

CLOSED: dict[str, tuple[str, ...]] = {
    "THE": ("the",),
    "MY": ("my", "our", "your", "his"),
    "A": ("a", "an", "some", "any"),
    "THIS": ("this", "these"),
    "THAT": ("that", "those"),
    "ALL": ("all", "every", "each", "all of", "every one of", "each of"),
    "EVERYTHING": ("everything", "all things", "all objects", "all items"),
    "BOTH": ("both", "both of"),
    "OF": ("of",),
    "ONE": ("one", "ones"),
    "ME": ("me", "myself", "us"),
    "I": ("i", "we"),
    "YOU": ("you", "yourself"),
    "IT": ("it", "them", "they", "those ones", "these ones"),
    "HIM": ("him", "her"),
    "HERE": ("here", "over here", "in here"),
    "THERE": ("there",),
    "OVER_THERE": ("over there", "in there", "up there", "down there"),
    "BACK": ("back", "home"),
    "UP": ("up",),
    "DOWN": ("down",),
    "TO": ("to", "towards", "toward", "over to", "up to", "back to", "down to"),
    "FOR": ("for",),
    "ON": ("on", "on top of", "atop", "upon"),
    "ONTO": ("onto", "on to", "back on", "back onto"),
    "IN": ("in", "inside", "within", "inside of"),
    "INTO": ("into", "in to", "back in", "back into"),
    "NEAR": ("next to", "beside", "near", "near to", "by", "close to", "alongside", "nearby", "adjacent to", "besides"),
    "FROM": ("from", "off", "off of", "out of", "from off", "from on", "from inside", "from the top of"),
    "AT": ("at",),
    "BESIDE": ("under", "underneath", "below", "beneath", "behind", "in front of", "above", "left of", "right of",
               "to the left of", "to the right of", "over", "between", "against", "across from", "opposite"),
    "AND": ("and", "as well as", "plus", "&"),
    "WHERE": ("where", "whereabouts"),
    "WHAT": ("what",),
    "WHICH": ("which",),
    "WHO": ("who",),
    "HELP": ("help", "help me"),
    "HOW_MANY": ("how many", "what number of", "what is the number of", "what is the count of"),
    "COUNT": ("count",),
    "LIST": ("list",),
    "COLOR_WORD": ("color", "colour"),
    "BE": ("is", "are", "was", "were", "am", "be"),
    "CAN_YOU": ("can you", "could you", "do you", "did you", "have you", "you can", "you have", "you do"),
    "WHICH_ROOM": ("which room", "what room", "in which room", "in what room"),
    "WHICH_ROOMS": ("which rooms", "what rooms"),
    "LIST_ROOMS": ("list rooms", "list the rooms", "list all rooms", "list all the rooms"),
    "DO": ("do", "does", "did"),
    "CAN": ("can", "could", "may", "might"),
    "HAVE": ("have", "has", "had", "got"),
    "SEE": ("see", "seen", "know", "know of", "know about", "remember", "noticed", "notice", "spot", "saw"),
    "HOLDING": ("holding", "carrying", "gripping", "grasping"),
    "IN_HAND": ("in your hand", "in your gripper", "in your hands", "in the hand", "in the gripper", "in hand"),
    "WHATEVER": ("whatever",),
    "ANYTHING": ("anything", "something"),
    "TELL": ("tell me", "let me know", "i want to know", "i would like to know", "say", "show me",
             "i wonder", "find out", "tell us", "remind me"),
    "WHETHER": ("whether", "if"),
    "NEAREST": ("nearest", "closest"),
    "LARGEST": ("largest", "biggest", "tallest", "longest", "widest"),
    "SMALLEST": ("smallest", "littlest", "shortest", "tiniest"),
    "BIG": ("big", "large", "tall", "huge", "long", "bigger", "larger", "taller"),
    "SMALL": ("small", "little", "tiny", "short", "smaller", "shorter"),
    "MEANING": ("not", "no", "never", "except", "except for", "but", "but not", "apart from", "other than", "without",
                "unless", "until", "while", "before", "after", "when", "or", "nor", "either", "neither", "otherwise",
                "else",
                "because", "instead", "instead of", "other", "another", "only", "first", "second", "third", "fourth",
                "last", "next", "again", "twice", "times", "than", "most", "least", "half", "more", "fewer", "less",
                "with",
                "every time", "always", "as", "though", "although", "since", "whenever", "rather", "same", "different",
                "tomorrow", "later", "tonight", "today", "yesterday",
                "minutes", "seconds", "hours", "slowly", "why", "how", "must", "cannot"),
}  # fmt: skip
"""``MEANING`` holds words that change what is asked and that no rule understands: their clause is not understood."""

SEPARATORS: tuple[str, ...] = (
    "then", "and then", "after that", "and after that", "afterwards", "and afterwards", "subsequently", "followed by",
    "and finally", "finally", "first of all", "lastly", "and also", "also", "firstly", "secondly", "thirdly",
    "next and",
    "once you are done", "once done", "when you are done", "when done", "and next",
)  # fmt: skip
"""Words that separate the steps of a request."""

FILLERS: tuple[str, ...] = (
    "please", "pls", "kindly", "just", "now", "right now", "right away", "quickly", "quick", "carefully", "immediately",
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
    "when you get a chance", "when you have time", "when you can", "i was wondering if you could", "could you possibly",
    "start by", "begin by", "go ahead", "in order to", "perhaps", "maybe", "yo", "dude", "possibly", "currently",
)  # fmt: skip
"""Words that carry courtesy, not meaning; dropped."""

POLITE_IF_VERB = frozenset({"can you", "could you", "do you", "go", "come", "you", "to"})
"""Dropped when an action verb follows: *can you bring*, *go get*; kept in *can you see*."""

CONTRACTIONS: dict[str, str] = {
    "what's": "what is", "whats": "what is", "where's": "where is", "wheres": "where is", "who's": "who is",
    "there's": "there is", "it's": "it is", "that's": "that is", "i'd": "i would", "i'm": "i am", "i'll": "i will",
    "don't": "do not", "dont": "do not", "can't": "can not", "cannot": "can not", "isn't": "is not",
    "aren't": "are not",
    "won't": "will not", "didn't": "do not", "let's": "let us", "you're": "you are", "they're": "they are",
    "how's": "how is", "which's": "which is", "gimme": "give me", "i've": "i have", "you've": "you have",
    "u": "you",
    "where're": "where are", "what're": "what are", "wanna": "want to", "lemme": "let me", "doesn't": "does not",
}  # fmt: skip

NUMBERS: dict[str, int] = {
    **{
        w: i
        for i, w in enumerate(
            ["two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"], start=2
        )
    },
    "a couple of": 2,
    "a pair of": 2,
    "a dozen": 12,
}


def gerund(verb: str) -> str:
    """*bring* becomes *bringing*, *take* becomes *taking*, *put* becomes *putting*; of a phrase, its first word."""
    first, space, rest = verb.partition(" ")
    if first.endswith("e") and not first.endswith("ee"):
        stem = first[:-1]
    elif len(first) == 3 and first[-1] in "tgnp" and first[1] in "aeiou":
        stem = first + first[-1]
    elif first == "drop":
        stem = "dropp"
    else:
        stem = first
    return f"{stem}ing{space}{rest}"


def phrase_table() -> dict[tuple[str, ...], tuple[str, str]]:
    """Every closed-class phrase, as its words, with its terminal and canonical form."""
    table: dict[tuple[str, ...], tuple[str, str]] = {}

    def add(phrase: str, terminal: str, canonical: str | None = None) -> None:
        table.setdefault(tuple(phrase.split()), (terminal, canonical or phrase))

    for terminal, phrases in (*CLOSED.items(), *VERBS.items()):
        for phrase in phrases:
            add(phrase, terminal)
    for terminal, phrases in VERBS.items():
        for phrase in phrases:
            add(gerund(phrase), terminal, phrase)
    for color, name in COLORS.items():
        add(color, "ORANGE" if color == "orange" else "COLOR", name)
        for shade in ("light", "dark", "bright", "pale"):
            add(f"{shade} {color}", "COLOR", name)
    for phrase in SEPARATORS:
        add(phrase, "THEN")
    for phrase in FILLERS:
        add(phrase, "FILLER")
    for verb in UNABLE:
        add(verb, "UNABLE")
        add(gerund(verb), "UNABLE", verb)
    for word, value in NUMBERS.items():
        add(word, "NUMBER", str(value))
    return table
