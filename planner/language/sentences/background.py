"""What is only told around a request: *the art room's a mess, put the glue away*; *a kid was playing with it*.

A statement asks for nothing. It is kept out of what is to be done if it says neither what is wanted nor what is not,
and what it speaks of is what *it* and *him* in the request mean.
"""

from __future__ import annotations

from collections.abc import Sequence

from planner.language.lexicon.terminals import ACTING, Terminal

Tokens = Sequence[Terminal]

_SUBJECTS = frozenset({"LOST", "I", "IT", "HIM", "THIS", "THAT", "THERE", "EVERYTHING", "ANYTHING", "HERE"})
_VERBS_OF_BEING = frozenset({"BE", "HAVE", "LOSES", "BELONG"})
_AUXILIARY = frozenset({"CAN", "DO", "SHOULD"})
_SAID = frozenset(
    {"looks", "look", "seems", "seem", "smells", "sounds", "feels", "got", "went", "came", "left", "made",
     "broke", "keeps", "dropped", "forgot", "found", "bought", "put", "saw", "loves", "likes", "lives", "works",
     "said", "says", "gets", "becomes", "fell", "spilled", "finished", "called", "started", "stopped", "asked",
     "cooked", "ate", "drank", "belongs", "comes", "goes", "just", "thought", "knew", "slept", "caught", "cut",
     "felt", "hurt", "hurts", "lost", "kept", "met", "ran", "sat", "stood", "told", "took", "woke", "wrote",
     "rang", "rings", "heard", "knocked", "arrived", "gave", "sent"},
)  # fmt: skip
"""Finite verbs of a statement, beside *is* and *has* and those that their ending tells."""
_PLAIN = frozenset(
    {"know", "think", "feel", "live", "work", "sleep", "like", "love", "play", "eat", "drink", "read", "cook",
     "sit", "stay", "stand", "lie", "keep", "use", "remember", "forgot", "look", "hurt", "come", "go", "leave",
     "start", "hear", "hope", "guess", "expect", "wonder", "seem", "smell", "hate", "fear", "hurts", "wash", "write",
     "draw", "paint", "watch", "wait", "run", "walk", "get", "study", "train", "practice", "practise", "see", "meet"},
)  # fmt: skip
"""Verbs in the plain form that make a statement of what follows *I*, *we* and *they*."""
_ASKING_FOR = frozenset(
    {"YOU", "WANT", "WANTS", "ENSURE", "NEEDED", "EXCEPT", "WHETHER", "UNLESS", "PROVIDED", "IF_SO", "IF_NOT",
     "BEFORE", "AFTER", "OTHERWISE", "CALLED", "CALL", "MY_NAME", "ONE", "SHOULD", "LET", "SUPPLY", "CAN_YOU",
     "WHEN", "BUT_FIRST"},
)  # fmt: skip
"""What asks for something, or makes it depend on something: nothing like that is left aside."""
_DENYING = frozenset({"NOT", "NO", "NEITHER", "NOR"})
_UNABLE_TO = frozenset(
    {"reach", "get", "get to", "see", "find", "read", "sleep", "write", "work", "walk", "move", "hear", "wait", "cook",
     "concentrate", "leave", "come", "go", "breathe", "stop", "remember", "know", "carry", "lift", "bend", "stand up",
     "get up", "draw", "study", "play", "open", "fall asleep", "know of", "manage", "start", "begin", "have"},
)  # fmt: skip
"""What somebody cannot do, does not do or has not: why something is asked for, and not which."""
_CHOOSING = frozenset(
    {"COLOR", "ORANGE", "LARGEST", "SMALLEST", "NEAREST", "FARTHEST", "ORDINAL", "LEFTMOST", "RIGHTMOST", "OTHER"},
)
_WILLING = frozenset(
    {"want", "wants", "wanted", "need", "needs", "prefer", "prefers", "hate", "hates", "must", "allergic", "only",
     "rather", "wish", "wishes", "better", "best", "favorite", "favourite", "forbidden", "allowed", "instead",
     "never", "nobody", "none", "until", "while", "because", "dislike", "dislikes", "mean",
     "means", "meant", "say", "why", "how", "what", "which", "who", "later", "minutes", "every",
     "whenever", "please"},
)  # fmt: skip
_REPORTING = frozenset({"asked", "told", "said", "says", "ordered", "begged", "reminded", "wanted", "expects", "asks"})
"""Verbs after which *to* and a verb say what is to be done."""
_LANDMARK = frozenset({"ON", "IN", "NEAR", "AT", "FROM", "BESIDE", "BETWEEN", "INTO", "ONTO", "OFF", "TO", "WITH"})
_IN_PHRASE = frozenset(
    {"THE", "MY", "A", "THIS", "THAT", "POSSESSIVE", "HIS", "ALL", "BOTH", "NUMBER", "COLOR", "ORANGE", "BIG", "SMALL",
     "STATE", "OTHER", "BACK"},
)  # fmt: skip
_NAMES = frozenset({"NOUN", "NAME", "PERSON", "WORD", "IDENTIFIER", "DOOR"})
_ANYBODY = frozenset({"somebody", "someone", "anybody", "anyone", "everybody", "everyone", "people"})
BODILY = frozenset(
    {"hand", "hands", "hair", "face", "foot", "feet", "leg", "legs", "arm", "arms", "knee", "finger", "fingers",
     "tooth", "teeth", "eyes", "eye", "nose", "ear", "ears", "back", "stomach", "belly", "throat", "head", "headache",
     "toothache", "stomachache", "fever", "cold", "cough", "flu", "pain", "cramp", "cramps", "thirst", "hunger",
     "appetite", "nap", "bath", "shower", "meeting", "lesson", "class", "appointment", "exam", "homework", "guests",
     "visitors", "company", "visitor", "guest", "day", "morning", "time", "idea", "problem", "minute", "moment",
     "date", "party", "game"},
)  # fmt: skip
"""Words of what people have, feel and do that is no thing to be carried: no *it* stands for these."""
MAX_SUBJECT = 10
MAX_PHRASES = 4


def is_told(clause: Tokens) -> bool:
    """Whether a clause states something and asks for nothing: a subject, a finite verb, no wish, rule or condition."""
    if len(clause) > 1 and clause[0].typed in _SUBORDINATE:
        clause = clause[1:]
    kinds = [token.type for token in clause]
    words = {token.typed for token in clause}
    if _is_own_plan(kinds):
        return True
    if kinds[-2:-1] == ["BE"] and kinds[-1] in _LANDMARK - {"BESIDE"}:  # *the room Anna is in* goes on after what it is
        return False
    if kinds[-2:-1] == ["CAN"] and kinds[-1] in _SUBJECTS:  # *the letter, could that* goes on with a verb
        return False
    verb = _verb(clause)
    asking = _ASKING_FOR - {"SHOULD"} if _is_misplaced(clause, verb) else _ASKING_FOR
    asking -= {"SHOULD"} if _is_wished(clause) else set()
    asking -= {"WANTS"} if kinds[:2] == ["IT", "WANTS"] else set()  # *it gets cold*
    if verb is None or asking & set(kinds) or _WILLING & words or words & {"n't"}:
        return False
    if any(kind in ACTING for kind in kinds) and not _is_going_on(clause, verb):
        return False
    if "nothing" in words and not ("HAVE" in kinds or "THERE" in kinds):
        return False
    denied = bool(_DENYING & set(kinds)) and not _is_misplaced(clause, verb)
    named = _CHOOSING if _is_inability(clause, verb) else _CHOOSING | {"NOUN"}
    return not (denied and named & set(kinds))


def names_nothing(clause: Tokens) -> bool:
    """Whether a clause speaks of no thing that is known: *I have a headache*."""
    return not any(token.type in ("NOUN", "IDENTIFIER", "DOOR", "ONE") for token in clause)


def is_bodily(clause: Tokens) -> bool:
    """*I have washed my hands*: of nothing that *it* in a request after it could be."""
    return names_nothing(clause) and any(token.typed in BODILY for token in clause)


def _is_own_plan(kinds: Sequence[str]) -> bool:
    """*I want to lie down*, *she needs to sign something*: what somebody else is going to do, with no thing named."""
    start = 1 if kinds[:1] == ["WANT"] else 2 if kinds[1:2] == ["WANTS"] and kinds[0] in ("NAME", "HIM") else 0
    does = bool(start) and kinds[start : start + 1] == ["TO"] and kinds[start + 1 : start + 2] in (["WORD"], ["UNABLE"])
    return does and not (set(kinds[start + 2 :]) & (_NAMES - {"WORD"} | ACTING | _ASKING_FOR | _CHOOSING | _DENYING))


_SUBORDINATE = frozenset({"as", "since", "because", "while"})


def _is_misplaced(clause: Tokens, verb: int | None) -> bool:
    """*The knife should not lie there*: why it is to be moved."""
    rest = [token.type for token in clause[verb:]] if verb is not None else []
    return rest[:2] == ["SHOULD", "NOT"] and rest[-1] in ("THERE", "HERE", "OVER_THERE")


def _is_wished(clause: Tokens) -> bool:
    """*The juice should be cold*: how something should be, and nothing to be done with it."""
    kinds = [token.type for token in clause[-3:]]
    return (
        kinds == ["SHOULD", "BE", "WORD"] and clause[-3].typed == "should" and clause[-1].typed[-2:] not in ("ed", "en")
    )


def _is_inability(clause: Tokens, verb: int) -> bool:
    """*I can not reach it*, *she does not know it*, *he has no spoon*: no choice is denied by it."""
    kind, rest = clause[verb].type, clause[verb + 1 :]
    if kind == "HAVE":
        return True
    after = [token for token in rest if token.type != "NOT"]
    return kind in _AUXILIARY and bool(after) and after[0].typed in _UNABLE_TO


def _is_going_on(clause: Tokens, verb: int) -> bool:
    """*A kid was playing with it*, *I am done washing*: what people do, not what the robot is asked for."""
    auxiliary = clause[verb].type in _AUXILIARY | {"HAVE"}
    reported = any(token.typed in _REPORTING for token in clause)
    for index, token in enumerate(clause):
        if token.type not in ACTING or index == verb:
            continue
        going_on = index > verb and token.typed.split()[0].endswith("ing")
        helped = auxiliary and index <= verb + 2 and clause[index - 1].type in _AUXILIARY | {"NOT", "HAVE"}
        purpose = index > verb and clause[index - 1].type == "TO" and token.type == "UNABLE" and not reported
        planned = token.type == "UNABLE" and clause[index - 1].typed == "going"  # *I was going to read it*
        if not (going_on or helped or purpose or planned):
            return False
    return True


def _verb(clause: Tokens) -> int | None:
    """Where the finite verb is: after a pronoun or a noun phrase that begins the clause."""
    for index, token in enumerate(clause[: MAX_SUBJECT + 1]):
        if token.type == "LOST":
            return index
        if index and (token.type in _VERBS_OF_BEING | _AUXILIARY or token.typed in _SAID or _is_inflected(token)):
            return index
        if index and _is_finite(token, clause[:index]):
            return index
        if index == 0 and token.type in _SUBJECTS:
            continue
        if token.type not in _IN_PHRASE | _NAMES | {"AND", "OF"} | _SUBJECTS | (_LANDMARK if index else frozenset()):
            return None
    return None


def _is_finite(token: Terminal, subject: Tokens) -> bool:
    """*attracts* after *it*, *drinks* after a name, *sleep* after *we*: a verb by its place and its ending."""
    last = subject[-1].type
    if subject[-1].typed in ("these", "those"):  # *staple these sheets*
        return token.typed in _PLAIN
    if token.type in ("WORD", "UNABLE", "MEANING") and last in ("IT", "HIM", "NAME", "THAT", "THIS"):
        return (token.typed.endswith("s") and len(token.typed) > 3) or token.typed in _PLAIN
    if token.type == "NOUN" and last == "NAME":
        return token.typed in _PLURALS_OF_PLAIN
    if len(subject) == 1 and last == "I":
        return token.typed in _PLAIN
    return token.type in ("WORD", "UNABLE") and last in _NAMES and token.typed in _PLURALS_OF_PLAIN


_PLURALS_OF_PLAIN = frozenset(f"{verb}s" for verb in _PLAIN)


def _is_inflected(token: Terminal) -> bool:
    return token.type in ("WORD", "PAST", "MEANING") and token.typed.endswith("ed") and len(token.typed) > 4


def _tells_how(clause: Tokens, start: int, end: int) -> bool:
    """*Clutter* in *they are clutter*, *mess* in *it is a mess*: what is said of a thing, and no other thing."""
    return start > 0 and clause[start - 1].type == "BE" and (start == end or clause[start].type == "A")


def spoken_of(clause: Tokens) -> list[tuple[bool, list[Terminal]]]:
    """The noun phrases of a statement as spans up to its end, each with whether it only tells of a place."""
    found: list[tuple[bool, list[Terminal]]] = []
    verb = _verb(clause) or 0
    index = 0
    while index < len(clause) and len(found) < MAX_PHRASES:
        head = _past(clause, index, _IN_PHRASE)
        fruit = head > index and clause[head - 1].type == "ORANGE" and not _is_named(clause, head)
        head -= fruit
        names = (fruit or _is_named(clause, head)) and not (index <= verb <= head and verb)
        end = _past(clause, head + fruit, _NAMES, verb) if names else index + 1
        if names and clause[end - 1].typed not in _ANYBODY | BODILY and not _tells_how(clause, index, head):
            before = clause[index - 1].type if index else ""
            found.append((before in _LANDMARK, list(clause[index : verb if index < verb else None])))
            while before not in _LANDMARK and end + 1 < len(clause) and clause[end].type in ("AND", "COMMA"):
                end = _past(clause, _past(clause, end + 1, _IN_PHRASE), _NAMES, verb)
        index = max(end, index + 1)
    return found


def _is_named(clause: Tokens, index: int) -> bool:
    return index < len(clause) and clause[index].type in _NAMES


def _past(clause: Tokens, index: int, kinds: frozenset[str], stop: int = 0) -> int:
    """Where the terminals of ``kinds`` that begin at ``index`` end; ``stop`` is never passed, if it lies ahead."""
    end = index
    while end < len(clause) and clause[end].type in kinds and (end != stop or not stop):
        end += 1
    return end
