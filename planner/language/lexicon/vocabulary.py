"""Words for things: synonyms, plurals, colors, sizes and kinds, so that a person's word finds the graph's label.

Labels are data. Whatever label the camera or a person brings in is matched literally; this table only adds other words.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

SYNONYMS: tuple[tuple[str, ...], ...] = (
    ("cup", "mug", "teacup", "coffee cup", "coffee mug", "tea cup", "beaker", "tumbler"),
    ("wine glass", "glass", "drinking glass", "wineglass", "goblet"),
    ("bottle", "water bottle", "flask"),
    ("can", "tin", "soda can", "tin can", "beverage can"),
    ("bicycle", "bike", "cycle"),
    ("flashlight", "torch"),
    ("hairbrush", "brush"),
    ("envelope", "letter"),
    ("folder", "binder", "file"),
    ("notebook", "notepad", "exercise book"),
    ("wrench", "spanner"),
    ("bandage", "plaster", "band-aid"),
    ("tape", "sticky tape", "adhesive tape"),
    ("umbrella", "brolly"),
    ("cookie", "biscuit"),
    ("chips", "crisps"),
    ("photo", "picture", "photograph"),
    ("puzzle", "jigsaw"),
    ("marker", "felt pen", "felt tip"),
    ("badge", "name tag", "name badge"),
    ("washing machine", "washer"),
    ("basket", "hamper"),
    ("statue", "sculpture"),
    ("toy car", "car"),
    ("syringe", "needle"),
    ("drill", "power drill"),
    ("yogurt", "yoghurt"),
    ("kettle", "tea kettle"),
    ("screwdriver", "screw driver"),
    ("bathtub", "tub"),
    ("couch", "sofa", "settee", "loveseat"),
    ("fridge", "refrigerator", "freezer", "icebox"),
    ("tv", "television", "telly", "tv set", "tv monitor"),
    ("monitor", "screen", "computer monitor", "computer screen", "display"),
    ("phone", "cell phone", "mobile phone", "smartphone", "cellphone", "telephone", "mobile", "handset"),
    ("remote", "remote control", "tv remote", "clicker"),
    ("laptop", "notebook computer", "laptop computer"),
    ("computer", "pc"),
    ("plant", "potted plant", "houseplant", "flower pot", "plant pot", "flowers"),
    ("table", "dining table", "table-merged"),
    ("desk", "desk-stuff", "writing desk", "work desk"),
    ("counter", "countertop", "worktop", "kitchen counter", "work surface"),
    ("cabinet", "cupboard", "cabinet-merged", "closet"),
    ("shelf", "bookshelf", "bookcase", "shelves", "rack"),
    ("bed", "cot"),
    ("chair", "seat"),
    ("armchair", "easy chair", "recliner"),
    ("stool", "barstool", "bar stool"),
    (
        "trash can",
        "bin",
        "waste bin",
        "garbage can",
        "trash bin",
        "dustbin",
        "wastebasket",
        "rubbish bin",
        "trash",
        "garbage",
        "rubbish",
    ),
    ("box", "carton", "cardboard box", "package", "parcel"),
    ("teddy bear", "teddy", "stuffed bear", "plush bear"),
    ("ball", "sports ball"),
    ("backpack", "rucksack", "knapsack"),
    ("bag", "handbag", "purse"),
    ("suitcase", "luggage"),
    ("toilet", "loo"),
    ("sink", "washbasin", "basin"),
    ("stove", "cooker", "hob"),
    ("oven", "range"),
    ("microwave", "microwave oven"),
    ("keyboard", "computer keyboard"),
    ("mouse", "computer mouse"),
    ("jar", "pot of jam"),
    ("pan", "frying pan", "skillet", "saucepan"),
    ("plate", "dish", "saucer"),
    ("book", "novel", "textbook"),
    ("magazine", "journal"),
    ("newspaper", "paper"),
    ("pen", "ballpoint", "biro"),
    ("scissors", "shears"),
    ("glasses", "eyeglasses", "spectacles", "reading glasses", "specs"),
    ("key", "keys"),
    ("medicine", "pill bottle", "medication", "pills"),
    ("towel", "tea towel", "dish towel"),
    ("pillow", "cushion"),
    ("rug", "carpet", "mat"),
    ("lamp", "light", "table lamp", "floor lamp"),
    ("nightstand", "bedside table", "night table"),
    ("dresser", "chest of drawers"),
    ("side table", "end table"),
    ("soda", "soft drink", "coke"),
    ("donut", "doughnut"),
    ("person", "human", "man", "woman", "guy", "lady", "someone", "somebody"),
    ("living room", "lounge", "sitting room", "livingroom", "family room", "parlor"),
    ("bedroom", "bed room", "sleeping room"),
    ("bathroom", "restroom", "bath", "washroom", "toilet room"),
    ("hall", "hallway", "corridor", "entrance hall", "entryway", "foyer"),
    ("office", "study", "workroom", "home office"),
    ("dining room", "diningroom"),
    ("kitchen", "kitchenette", "galley"),
    ("pantry", "larder"),
    ("storage", "storage room", "storeroom", "store room", "utility room"),
    ("laundry", "laundry room"),
    ("garage", "carport"),
    ("library", "reading room"),
    ("workshop", "studio"),
    ("lobby", "reception", "vestibule"),
    ("meeting room", "conference room", "boardroom"),
    ("attic", "loft"),
    ("basement", "cellar"),
    ("lab", "laboratory"),
    ("nursery", "playroom", "kids room", "children's room"),
    ("gym", "fitness room"),
    ("balcony", "terrace"),
    ("stairs", "staircase", "stairwell"),
    ("ward", "patient room"),
    ("canteen", "cafeteria", "break room"),
)
"""Groups of words for one thing; the first is only the name of the group, any of them may be a graph's label."""

ROOM_LABELS = frozenset(
    {"living room", "bedroom", "bathroom", "hall", "office", "dining room", "kitchen", "pantry", "storage", "laundry"}
    | {
        "garage",
        "library",
        "workshop",
        "lobby",
        "meeting room",
        "conference room",
        "attic",
        "basement",
        "cellar",
        "lab",
    }
    | {"nursery", "playroom", "gym", "balcony", "stairs", "ward", "classroom", "canteen", "break room", "reception"}
)
"""Groups of ``SYNONYMS`` that name rooms, by their first word."""

KINDS: dict[str, tuple[str, ...]] = {
    "fruit": ("apple", "banana", "orange", "pear", "lemon", "grape", "mango", "peach"),
    "drink": ("bottle", "can", "juice", "soda", "water", "milk"),
    "tool": ("hammer", "screwdriver", "drill", "pliers", "wrench", "saw"),
    "toy": ("teddy bear", "ball", "doll", "kite", "frisbee"),
    "snack": ("chips", "cookie", "cracker", "chocolate", "candy", "donut"),
    "vegetable": ("carrot", "broccoli", "tomato", "cucumber", "pepper"),
    "cutlery": ("fork", "knife", "spoon"),
    "dishes": ("plate", "bowl", "cup"),
    "reading matter": ("book", "magazine", "newspaper"),
    "writing tool": ("pen", "pencil", "marker"),
    "food": ("apple", "banana", "orange", "sandwich", "pizza", "cake", "hot dog", "donut", "carrot", "broccoli"),
}
"""Words for a kind of thing, and labels that belong to it; an object's own ``categories`` count as well."""

COARSER: dict[str, tuple[str, ...]] = {
    "table": ("coffee table", "side table", "dinner table", "tea table"),
    "chair": ("armchair",),
    "cabinet": ("dresser", "sideboard", "commode"),
    "wardrobe": ("closet", "armoire"),
    "stove": ("oven",),
    "tv stand": ("tv bench", "tv console", "media console"),
    "vase": ("vessel",),
}
"""What a camera that tells few kinds apart calls things for which people have words of their own, and those words:
where nothing is called so, they mean what is called by the coarser name.
"""

ANYTHING = frozenset({"thing", "object", "item", "stuff", "one", "everything"})
"""Words that fit any object that can be carried."""

FURNITURE = frozenset({"furniture"})
OPEN_AIR = frozenset({"terrace", "balcony", "patio", "porch", "deck", "veranda", "landing"})
"""Rooms that one is *on* and not *in*."""
ROOM_WORDS = frozenset({"room", "place"})
PERSON = "person"
PERSON_WORDS = frozenset(
    {"person", "human", "man", "woman", "guy", "lady", "someone", "somebody", "people", "user", "everyone", "anyone"}
    | {"everybody", "anybody"}
)

COLORS: dict[str, str] = {
    **{c: c for c in ("red", "green", "blue", "yellow", "black", "white", "brown", "pink", "purple", "gray", "orange")},
    **{c: c for c in ("cyan", "beige", "silver", "gold", "turquoise")},
    "grey": "gray",
    "violet": "purple",
    "transparent": "clear",
    "crimson": "red",
    "scarlet": "red",
    "navy": "blue",
    "golden": "gold",
}
"""Color words and the name the graph uses."""

_IRREGULAR = {
    "people": "person",
    "men": "man",
    "women": "woman",
    "knives": "knife",
    "shelves": "shelf",
    "bookshelves": "bookshelf",
    "mice": "mouse",
    "loaves": "loaf",
    "leaves": "leaf",
    "boxes": "box",
    "potatoes": "potato",
    "tomatoes": "tomato",
    "mangoes": "mango",
    "children": "child",
}
ALWAYS_PLURAL = frozenset({"scissors", "glasses", "keys", "headphones", "pliers", "shears", "dishes", "chips"})
_NOT_PLURAL = ("ss", "us", "is")


@lru_cache(maxsize=4096)
def singular(word: str) -> str:
    """The singular of an English noun phrase; only its last word changes."""
    head, space, last = word.rpartition(" ")
    return head + space + _singular(last)


def _singular(word: str) -> str:
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if len(word) <= 3 or not word.endswith("s") or word.endswith(_NOT_PLURAL):
        return word
    if word.endswith("ies") and len(word) > 4 and word not in ("cookies", "movies"):
        return word[:-3] + "y"
    if word.endswith(("ches", "shes", "sses", "xes", "zes")):
        return word[:-2]
    return word[:-1]


@lru_cache(maxsize=4096)
def is_plural(word: str) -> bool:
    """Whether an English noun phrase is written in the plural."""
    return singular(word) != word and word not in ALWAYS_PLURAL


@lru_cache(maxsize=8192)
def words_for(word: str) -> frozenset[str]:
    """``word`` in the singular and every synonym of it, lower case."""
    base = normal(word)
    forms = {base, singular(base)}
    return frozenset(forms.union(*(_GROUPS.get(form, frozenset()) for form in forms)))


def kind_labels(word: str) -> frozenset[str]:
    """Labels that ``word`` names as a kind, empty when it is not a kind."""
    return frozenset(KINDS.get(singular(normal(word)), ()))


@lru_cache(maxsize=8192)
def coarser_labels(word: str) -> frozenset[str]:
    """Labels under which a camera may know what ``word`` names, other than its own: *table* for *coffee table*."""
    words = words_for(word)
    labels = (label for label, finer in COARSER.items() if not words.isdisjoint(finer))
    return frozenset().union(*(words_for(label) for label in labels)) - words


@lru_cache(maxsize=8192)
def normal(label: str) -> str:
    """A label as words: lower case, underscores as spaces."""
    return " ".join(label.lower().replace("_", " ").split())


NO_KIND_OF_THEIRS = frozenset({"trash can", "garbage can", "watering can", "hot dog", "light bulb", "ping pong table"})
"""Compounds that are no kind of what their last word says: a trash can is no can."""


def is_room_label(word: str) -> bool:
    """Whether ``word`` names a kind of room."""
    return normal(word).rpartition(" ")[2] == "room" or bool(_ROOM_LABELS & words_for(word))


def is_known(word: str) -> bool:
    """Whether ``word`` is a noun of this table."""
    base = normal(word)
    return bool({base, singular(base)} & _NOUNS) or is_room_label(word)


def known_nouns() -> Iterable[str]:
    """Every noun of this table, for recognizing multi-word names."""
    for group in SYNONYMS:
        yield from group
    for kind, labels in (*KINDS.items(), *COARSER.items()):
        yield kind
        yield from labels
    yield from ANYTHING | FURNITURE | ROOM_WORDS | PERSON_WORDS


def _groups() -> dict[str, frozenset[str]]:
    groups: dict[str, set[str]] = {}
    for synonyms in SYNONYMS:
        for word in synonyms:
            groups.setdefault(word, set()).update(synonyms)
    return {word: frozenset(group) for word, group in groups.items()}


_GROUPS = _groups()
_NOUNS = frozenset(known_nouns())
_ROOM_LABELS = frozenset(word for group in SYNONYMS if group[0] in ROOM_LABELS for word in group)
