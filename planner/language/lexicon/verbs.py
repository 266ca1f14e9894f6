"""Verbs that the robot can act on, by the terminal that each belongs to, and their other forms."""

from __future__ import annotations

VERBS: dict[str, tuple[str, ...]] = {
    "BRING": ("bring", "fetch", "retrieve", "grab me", "bring over", "bring back", "bring along",
              "go get", "go fetch", "go and get", "go and fetch"),
    "GET": ("get", "bring out"),
    "TAKE": ("take",),
    "CARRY": ("carry", "deliver", "transport", "transfer", "haul", "ferry"),
    "MOVE": ("move", "relocate", "shift"),
    "RETURN": ("return", "restore"),
    "GIVE": ("give", "hand", "pass", "hand over", "serve", "lend", "loan", "offer", "pass over", "slip"),
    "SUPPLY": ("supply", "surprise", "treat", "delight", "reward", "provide", "furnish", "equip", "present"),
    "PUT": ("put", "place", "set", "lay", "deposit", "stow", "stick", "put away", "pop", "store", "tidy", "tidy away",
            "plonk", "position", "gather", "gather up", "bung", "plop"),
    "DROP": ("drop", "drop off", "leave", "release", "let go of"),
    "LET": ("let",),
    "NEEDED": ("your presence is requested", "your presence is required", "your presence is needed",
               "you are requested",
               "you are required", "you are expected", "you are needed", "you are wanted", "your help is needed"),
    "GO": ("go", "drive", "navigate", "walk", "head", "travel", "proceed", "roll", "run", "go over", "go on over",
           "make your way", "get over", "move over", "get yourself", "take yourself", "continue", "continue on",
           "move on",
           "head on", "end up", "finish up", "finish", "start", "start out", "start off", "begin", "head out",
           "set off", "find your way",
           "drop in",
           "drop by", "swing by", "stop by", "go off", "wander", "journey"),
    "STAND": ("stand", "go stand", "go and stand", "go and wait", "go wait", "wait", "stop", "station yourself",
              "position yourself", "find yourself a place", "go and find yourself a place",
              "go find yourself a place", "go and find a place",
              "go and find yourself a spot", "find yourself a spot", "find a place", "find a spot", "find a seat",
              "take a place", "take your place", "take up position", "plant yourself", "park yourself",
              "place yourself", "stay", "remain"),
    "VISIT": ("visit", "enter", "approach", "join", "head for", "make for", "call on", "look in on", "go see",
        "check in on", "check in with", "pop in on", "drop in on", "call in on", "stop in on", "pass through",
              "explore", "pass by", "go past", "check out", "go and see", "inspect", "check on",
        "check up on"),
    "COME": ("come", "come over", "come on over", "come closer", "come along"),
    "FIND": ("find", "locate", "look for", "search for", "seek", "hunt for", "look out for", "go find",
        "try to find", "track down", "look around for", "look everywhere for", "search around for",
        "go look around for", "scout for", "hunt out",
        "go look for", "go and look for", "go and find", "help me find",
             "help me to find", "help me look for", "have a look for", "take a look for", "keep an eye out for",
             "go search for", "hunt down"),
    "SEARCH": ("search", "look through", "look around in", "check"),
    "LOOK": ("look", "have a look", "take a look", "go look", "go and look", "go have a look", "go and have a look",
             "look around", "look inside"),
    "PICK": ("pick", "pick up", "grab", "grasp", "lift", "lift up", "collect", "hold", "take hold of", "get hold of"),
    "ENSURE": ("make sure", "make sure that", "ensure", "ensure that", "see to it that", "see that", "check that",
               "see to it"),
    "WANT": ("i want", "i would like", "i need", "i would love", "we need", "we want", "i could use", "can i have",
             "could i have", "may i have", "can i get", "could i get", "i will have", "i will take",
             "i want to have", "i would like to have", "i could do with", "i am after",
             "i am in need of", "let me have", "may i get", "may we have", "can we have", "could we have",
             "we would like", "i would appreciate", "i would be grateful for", "i would be happy with",
             "i would not mind",
             "i would be glad of", "i fancy", "i require", "i could go for", "i crave", "i wish for",
             "i would rather have",
             "i wish i had",
             "i would prefer", "i am craving", "i am in the mood for", "i would kill for", "can you spare me",
             "i will need", "we will need", "we are going to need", "i will want", "we will want", "we could use",
             "we could do with",
             "i am going to need", "i really need"),
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

PAST: dict[str, str] = {
    "brought": "bring", "fetched": "fetch", "retrieved": "retrieve", "got": "get", "gotten": "get", "took": "take",
    "taken": "take", "carried": "carry", "delivered": "deliver", "moved": "move", "returned": "return",
    "gave": "give",
    "given": "give", "handed": "hand", "passed": "pass", "put": "put", "placed": "place", "dropped": "drop",
    "went": "go", "gone": "go", "driven": "drive", "drove": "drive", "visited": "visit", "came": "come",
    "found": "find",
    "located": "locate", "searched": "search", "looked": "look", "picked": "pick", "picked up": "pick up",
    "grabbed": "grab", "collected": "collect", "checked": "check",
}  # fmt: skip
"""Past forms of the verbs; verbs only after such courtesy, *after* or *before*, else what somebody tells."""


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
