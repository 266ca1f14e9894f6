"""The closed-class words of a command and the terminal each belongs to; all else is a noun of the graph or unknown.

A word has exactly one terminal; words with several uses (*take*, *one*, *that*) have a terminal of their own, which the
grammar mentions wherever the word may stand. Phrases match before their single words.
"""

from __future__ import annotations

from planner.language.lexicon.politeness import FILLERS, FRAMES
from planner.language.lexicon.unable import UNABLE
from planner.language.lexicon.verbs import PAST, VERBS, gerund
from planner.language.lexicon.vocabulary import COLORS

CLOSED: dict[str, tuple[str, ...]] = {
    "THE": ("the",),
    "MY": ("my", "our", "your", "kids'", "kid's", "children's", "family's", "everyone's", "everybody's", "whose"),
    "HIS": ("his", "their", "its"),
    "A": ( "a", "a piece of", "one piece of", "a single", "one single", "just one", "an", "some", "any", "any old",
        "either", "either of", "whichever"),
    "THIS": ("this", "these"),
    "THAT": ("that", "those"),
    "ALL": ("all", "every", "each", "all of", "every one of", "each of", "every single", "each and every",
        "every last"),
    "EVERYTHING": ("everything", "all things", "all objects", "all items"),
    "BOTH": ("both", "both of"),
    "HALF": ("half", "half of"),
    "ALL_BUT": ("allbut",),
    "OF": ("of",),
    "ONE": ("one", "ones"),
    "ME": ("me", "myself", "us"),
    "I": ("i", "we"),
    "YOU": ("you", "yourself"),
    "IT": ("it", "them", "they", "those ones", "these ones"),
    "HIM": ("him", "her", "he", "she"),
    "HERE": ("here", "over here", "in here"),
    "THERE": ("there",),
    "OVER_THERE": ("over there", "in there", "up there", "down there", "on there", "from there"),
    "BACK": ("back", "home"),
    "UP": ("up",),
    "DOWN": ("down",),
    "TO": ("to", "towards", "toward", "over to", "up to", "back to", "down to", "through to", "along to", "out to",
        "across to",
           "round to", "around to", "away to", "off to", "back over to", "all the way to", "straight to"),
    "FOR": ("for",),
    "ON": ( "on", "outside on", "out on", "up on", "over on", "down there on", "over there on", "on top of", "atop",
        "upon", "on the top of"),
    "ONTO": ("onto", "over onto", "up onto", "out onto", "right onto", "straight onto", "on to",
             "back on", "back onto", "back on top of", "down on", "down onto"),
    "IN": ("in", "inside", "within", "inside of", "over in", "out in", "up in", "out there in", "over there in"),
    "INTO": ("into", "over into", "right into", "straight into", "out into", "through into", "across into",
             "up into", "away into", "in to", "back in", "back into", "back inside", "down in"),
    "NEAR": ("next to", "beside", "near", "near to", "by", "close to", "alongside", "nearby", "adjacent to",
             "besides", "right next to", "right by", "right beside", "just next to", "around", "at the side of"),
    "FROM": ("from", "out of", "from on", "from inside", "from the top of", "from in", "from within",
        "from on top of"),
    "OFF": ("off", "off of", "from off", "off the top of"),
    "AT": ("at", "over at", "down at", "up at"),
    "BETWEEN": ("between", "in between"),
    "NEITHER": ("neither",),
    "NOR": ("nor", "or"),
    "LIKE": ("looks like", "look like", "resembles" ),
    "LOSES": ( "lost", "has lost", "have lost", "misplaced", "has misplaced", "can not find", "is looking for",
        "is missing",
              "forgot", "has forgotten", "left behind", "mislaid"),
    "FLOOR": ("on the floor", "on the ground", "off the floor", "from the floor", "lying on the floor"),
    "START": ("your starting point",),
    "PART": ( "cover", "lid", "label", "cap", "binding", "spine", "shell", "finish", "paint", "stripe", "stripes",
        "sleeve",
             "front", "exterior", "frame", "frames", "handle", "handles", "rim", "strap", "straps", "trim", "grip"),
    "WITH": ("with", "containing", "that has", "which has", "that contains", "together with", "alongside with"),
    "BESIDE": ("under", "underneath", "below", "beneath", "behind", "in front of", "above", "left of", "right of",
               "to the left of", "to the right of", "over", "against", "across from", "opposite", "on the left of",
               "on the right of",
               "on the left side of", "on the right side of", "to the right side of", "to the left side of",
               "facing"),
    "AND": ("and", "as well as", "plus", "&"),
    "WHERE": ("where", "whereabouts"),
    "WHAT": ("what",),
    "WHICH": ("which",),
    "WHO": ("who",),
    "HELP": ("help", "help me"),
    "HOW_MANY": ("how many", "what number of", "what is the number of", "what is the count of"),
    "COUNT": ("count",),
    "LIST": ("list", "list all", "enumerate"),
    "COLOR_WORD": ("color", "colour", "colors", "colours"),
    "BE": ("is", "are", "was", "were", "am", "be", "stands", "lies", "sits", "rests", "is located", "is lying",
        "is standing",
           "is sitting", "are lying", "are standing", "is kept", "are kept", "is stored", "are stored",
           "is situated"),
    "CAN_YOU": ("can you", "could you", "do you", "did you", "have you", "you can", "you have", "you do",
                "you did", "you could"),
    "WHICH_ROOM": ("which room", "what room", "in which room", "in what room"),
    "ALSO": ("also", "too", "as well"),
    "WHICH_ROOMS": ("which rooms", "what rooms"),
    "LIST_ROOMS": ("list rooms", "list the rooms", "list all rooms", "list all the rooms", "name all rooms",
        "name all the rooms",
                   "name the rooms"),
    "DO": ("do", "does", "did"),
    "CAN": ("can", "could", "may", "might"),
    "HAVE": ("have", "has", "had", "got"),
    "SEE": ("see", "seen", "know", "know of", "know about", "remember", "noticed", "notice", "spot", "saw",
        "recall"),
    "HOLDING": ("holding", "carrying", "gripping", "grasping"),
    "IN_HAND": ("in your hand", "in your gripper", "in your hands", "in the hand", "in the gripper", "in hand"),
    "WHATEVER": ("whatever",),
    "ANYTHING": ("anything", "something", "any thing"),
    "TELL": ("tell me", "let me know", "i want to know", "i would like to know", "say", "show me",
             "i wonder", "find out", "tell us", "remind me", "any idea", "do you have any idea"),
    "WHETHER": ("whether", "if"),
    "NEAREST": ("nearest", "closest", "nearer", "closer"),
    "LARGEST": ("largest", "biggest", "tallest", "longest", "widest"),
    "SMALLEST": ("smallest", "littlest", "shortest", "tiniest"),
    "BIG": ("big", "large", "tall", "huge", "long", "bigger", "larger", "taller"),
    "SMALL": ("small", "little", "tiny", "short", "smaller", "shorter"),
    "SAME_ROOM": ("in the same room as", "from the same room as"),
    "FARTHEST": ("farthest", "furthest", "most distant", "remotest", "farther", "further"),
    "ORDINAL": ("second", "third", "fourth", "fifth", "first", "2nd", "3rd", "4th", "5th", "1st"),
    "OTHER": ("other", "remaining"),
    "STATE": ("closed", "gone", "missing", "lost"),
    "NOT": ("not", "never", "do not ever"),
    "NO": ("no", "not any"),
    "EXCEPT": ("except", "except for", "apart from", "other than", "but not", "excluding", "excepting", "aside from",
               "save for", "without", "instead of", "rather than", "and not", "not including",
               "with the exception of"),
    "IF_SO": ("if so", "if yes", "if that is the case", "in that case", "if that is so", "if that is true"),
    "IF_NOT": ("if not", "if there is none", "if there are none", "if that is not the case", "if that is not so",
               "if that fails", "failing that"),
    "UNLESS": ("unless", "except if"),
    "PROVIDED": ("in case", "provided", "provided that", "as long as", "assuming", "assuming that", "only if",
                 "so long as", "on condition that"),
    "OTHERWISE": ("otherwise", "else", "or else", "or otherwise", "if not then"),
    "BEFORE": ("before", "prior to"),
    "AFTER": ("after", "once", "as soon as"),
    "BUT": ("but", "however", "yet"),
    "BUT_FIRST": ("but first", "but before that", "before that", "but first of all", "but beforehand"),
    "NEXT": ("next",),
    "SHOULD": ("should", "must", "has to", "have to", "needs to", "need to", "ought to", "is to", "are to",
               "is supposed to", "are supposed to", "is meant to"),
    "BELONG": ("belong", "belongs"),
    "WANTS": ("wants", "needs", "would like", "asked for", "is asking for", "would love", "could use", "asks for",
              "is after", "gets", "is waiting for", "has asked for", "keeps asking for", "wanted", "needed",
              "requires",
              "could do with", "is in need of", "should have", "should get", "is to get", "is to have", "requested"),
    "CALLED": ("called", "named", "known as"),
    "CALL": ("call", "rename", "relabel", "label"),
    "MY_NAME": ("my name",),
    "YOUR_NAME": ("what is your name", "what are you called", "what should i call you"),
    "DESCRIBE": ("describe", "tell me about", "what do you know about", "tell me everything about",
        "tell me more about"),
    "HOW_FAR": ("how far", "how far away", "how far off", "what is the distance", "how close"),
    "HOW_BIG": ("how big", "how large", "how wide", "how long"),
    "WAY_TO": ("how do i get to", "how can i get to", "how do i go to", "how to get to", "what is the way to",
               "what is the best way to", "show me the way to", "how do you get to", "directions to",
               "how would i get to",
               "how do we get to", "tell me the way to", "tell me how to get to", "how do i get into",
               "how do i reach",
               "how can i reach", "what is the shortest way to", "what is the route to", "how could i get to",
               "what is the quickest way to", "what is the fastest way to", "how can we get to",
               "how does one get to",
               "how should i get to", "give me directions to", "tell me how i get to", "how do i find my way to"),
    "WAY": ("how do i get", "how can i get", "how do you get", "what is the way", "what is the route", "which way",
            "what is the best way", "what is the shortest way", "how do i go", "how do we get", "how to get"),
    "WHEN": ("when", "how long ago"),
    "LAST": ("last", "the last time", "most recently"),
    "WOULD": ("would", "should i", "might"),
    "LOST": ("i can not find", "i lost", "i have lost", "i am looking for", "we are looking for", "i have misplaced",
             "i misplaced", "we can not find", "i am searching for"),
    "LOCATION": ("location", "the location", "the whereabouts", "what is the location", "what are the whereabouts",
                 "what is the position"),
    "MORE_THAN": ("more than",),
    "LESS_THAN": ("less than", "fewer than"),
    "AT_LEAST": ("at least",),
    "AT_MOST": ("at most", "no more than", "not more than", "up to"),
    "DONE": ("what did you do", "what have you done", "what have you been doing", "what did you get done",
             "what did you do today", "what have you done today", "what have you done so far", "what did you do last",
             "what was the last thing you did", "what were you doing", "what did you do before",
             "tell me what you did", "tell me what you have done", "tell me what you have been doing"),
    "FAILED": ("why did you fail", "what went wrong", "why did it fail", "why did that fail", "why did it not work",
               "why did that not work", "why did you stop", "why did you not do it", "what was the problem",
               "what is the problem", "why did you give up", "what happened", "why could you not do it", "why not",
               "why did you not", "why did you refuse", "tell me why you failed", "tell me what went wrong",
               "why did the last task fail", "why can you not do it", "what failed", "what is wrong"),
    "DOING": ("what are you doing", "what are you up to", "what are you doing right now", "what are you working on",
              "are you busy", "what is your current task", "what is going on", "where are you going",
              "what is your plan",
              "what is your status", "how is it going"),
    "EXPLORED": ("have you explored everything", "are you done exploring", "are you exploring",
                 "are you still exploring",
                 "have you seen everything", "have you seen the whole building", "have you explored the whole building",
                 "is there more to explore", "how much have you explored"),
    "REACH": ("reach", "get to", "access"),
    "WELL_BEING": ("how are you",),
    "ASKED": ("what did i ask",),
    "SOURCE": ("how do you know",),
    "HOW_LONG": ("how long to",),
    "NOTHING": ("nothing",),
    "BATTERY": ("how is your battery", "what is your battery level", "how much battery do you have",
                "how much battery do you have left", "how much battery is left", "battery level", "battery",
                "what is the battery level", "how full is your battery", "what is your battery",
                "is your battery low",
                "is your battery full", "how is the battery", "what is your battery status"),
    "MOST": ("most", "the most", "most of", "the largest number of", "the greatest number of",
             "fullest", "busiest", "most crowded"),
    "FEWEST": ("fewest", "least", "emptiest", "the fewest", "the least", "the smallest number of"),
    "MORE": ("more", "fuller"),
    "FEWER": ("fewer", "less", "emptier"),
    "THAN": ("than",),
    "MEANING": ("never", "until", "while", "when", "because", "instead", "only if not",
                "again", "twice", "times", "few", "several",
                "many", "much", "every time", "always", "as", "though", "although", "since", "whenever", "rather",
                "same",
                "different", "tomorrow", "later", "tonight", "today", "yesterday", "minutes", "seconds", "hours",
                "minute",
                "hour", "day", "slowly", "why", "how", "cannot", "morning", "evening", "noon", "during", "via",
                "quietly"),
}  # fmt: skip
"""``MEANING`` holds words that change what is asked and that no rule understands: their clause is not understood."""

SEPARATORS: tuple[str, ...] = (
    "then", "and then", "only then", "and only then", "and after that one", "once that is done", "when that is done",
    "after which", "before finally", "after that", "and after that", "afterwards", "and afterwards", "subsequently",
        "followed by",
    "and finally", "finally", "first of all", "lastly", "and also", "also", "firstly", "secondly", "thirdly",
    "next and",
    "once you are done", "once done", "when you are done", "when done", "and next",
)  # fmt: skip
"""Words that separate the steps of a request."""

CONTRACTIONS: dict[str, str] = {
    "another": "an other",
    "what's": "what is", "whats": "what is", "where's": "where is", "wheres": "where is", "who's": "who is",
    "there's": "there is", "it's": "it is", "that's": "that is", "i'd": "i would", "i'm": "i am", "i'll": "i will",
    "don't": "do not", "dont": "do not", "can't": "can not", "cannot": "can not", "isn't": "is not",
    "aren't": "are not",
    "won't": "will not", "didn't": "did not", "let's": "let us", "you're": "you are", "they're": "they are",
    "how's": "how is", "which's": "which is", "gimme": "give me", "i've": "i have", "you've": "you have",
    "you'd": "you would", "we're": "we are", "we've": "we have", "they've": "they have", "she's": "she is",
    "he's": "he is", "hasn't": "has not", "haven't": "have not", "wasn't": "was not", "weren't": "was not",
    "shouldn't": "should not", "wouldn't": "would not", "couldn't": "could not", "here's": "here is", "im": "i am",
    "id": "i would", "ive": "i have", "isnt": "is not", "cant": "can not", "didnt": "did not", "doesnt": "does not",
    "arent": "are not", "thats": "that is", "theres": "there is", "hes": "he is", "youre": "you are",
    "we'd": "we would",
    "when's": "when is", "why's": "why is", "r": "are", "ur": "your", "gotta": "have to", "gonna": "going to",
    "pc's": "pc", "hows": "how is", "whos": "who is", "c'mon": "come on", "kindof": "",
    "u": "you",
    "where're": "where are", "where'd": "where did", "who'd": "who would", "what'd": "what did", "how'd": "how did",
    "that'll": "that will", "it'll": "it will", "you'll": "you will", "we'll": "we will", "ain't": "is not",
        "y'all": "you",
    "that'd": "that would", "it'd": "it would", "what're": "what are", "wanna": "want to", "lemme": "let me",
        "doesn't": "does not",
}  # fmt: skip

NUMBERS: dict[str, int] = {
    **{
        w: i
        for i, w in enumerate(
            ["two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"],
            start=2,
        )
    },
    "a couple of": 2,
    "a pair of": 2,
    "a dozen": 12,
    "a dozen of": 12,
    "half a dozen": 6,
    "half a dozen of": 6,
    "a half dozen": 6,
    "a pair": 2,
    "a couple": 2,
}

_NUMERALS = (
    "one two three four five six seven eight nine ten eleven twelve thirteen fourteen "
    "fifteen sixteen seventeen eighteen "
    "nineteen twenty"
)
NUMERALS: dict[str, str] = {word: str(value) for value, word in enumerate(_NUMERALS.split(), start=1)}
"""Numbers in words, as they are spoken after *ward* or *office*."""

LYING = frozenset(
    {"lying", "standing", "sitting", "located", "placed", "situated", "found", "kept", "stored", "resting", "laying",
     "left", "put", "currently", "somewhere", "right", "just", "anywhere", "at present", "still", "also", "now",
     "hanging"},
)  # fmt: skip
"""Say nothing new between a noun and *on*, *in* or *next to*; dropped there."""


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
    for phrase in FRAMES:
        add(phrase, "FRAME")
    for past, verb in PAST.items():
        add(past, "PAST", verb)
    for verb in UNABLE:
        add(verb, "UNABLE")
        add(gerund(verb), "UNABLE", verb)
    for word, value in NUMBERS.items():
        add(word, "NUMBER", str(value))
    return table
