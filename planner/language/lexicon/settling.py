"""Words of several uses: *water* is a verb at the start of a step, before a noun phrase, and a noun elsewhere."""

from __future__ import annotations

from collections.abc import Sequence

from planner.language.lexicon.lexicon import PHRASES, Lexicon
from planner.language.lexicon.politeness import POLITE_IF_VERB
from planner.language.lexicon.terminals import (
    ACTING,
    ASKED,
    BEFORE_NOUN,
    CLOSED_THAT_STAY,
    END,
    MODIFYING,
    NO_NOUN_BEFORE,
    NOMINAL,
    NP_START,
    RELATING,
    Terminal,
)
from planner.language.lexicon.verbs import NOUNLIKE, VERBS
from planner.language.lexicon.words import LYING

_SHUT = {"open": "open", "opened": "open", "closed": "closed", "shut": "closed"}
_SIDES = {"left": "LEFTMOST", "leftmost": "LEFTMOST", "left-hand": "LEFTMOST", "right": "RIGHTMOST",
          "rightmost": "RIGHTMOST", "right-hand": "RIGHTMOST"}  # fmt: skip
_AHEAD = 8
"""Words that the use of a word depends on."""
_OBJECTS = frozenset({"IT", "ME", "HIM", "THE", "MY", "EVERYTHING"})
"""What begins the object of a verb, and never follows a noun within a noun phrase."""
_NAMED = frozenset({"THE", "THIS", "MY", "POSSESSIVE", "NOUN", "NAME"})
_NAMING_WORDS = (frozenset(VERBS) - {"WANT", "WANTS", "NEEDED", "LET"}) | {"UNABLE", "LIST", "COUNT", "HELP", "SEE"}
"""What else a word of a name may be: *reading list*, *play corner*."""
_LEADING = frozenset({"FRAME", "AFTER", "BEFORE", "WHEN"})
_PRESENT = {phrase: terminal for phrase, (terminal, _) in PHRASES.items() if terminal in VERBS}


def settled_uses(tokens: Sequence[Terminal], lexicon: Lexicon) -> list[Terminal]:
    """Choose among the uses of words that have several, from left to right."""
    settled: list[Terminal] = []
    led = naming = False
    for index, token in enumerate(tokens):
        before = next((t.type for t in reversed(settled) if t.type != "FILLER"), "")
        following = [t for t in tokens[index + 1 : index + 1 + _AHEAD] if t.type != "FILLER"]
        led = led or token.type in _LEADING
        naming = (naming and token.type != "STOP") or _names(tokens, index)
        settled.append(
            (_in_name(token, before, lexicon) if naming else None)
            or _of_past(token, before, following, led=led)
            or _in_phrase(token, before, following, lexicon)
            or _choose(token, before, following, lexicon),
        )
        led = led and token.type != "STOP"
    return settled


def _names(tokens: Sequence[Terminal], index: int) -> bool:
    """Whether a name follows: after *call* and *called*, and after *is* in *the guest room is the sewing room*."""
    kind, after = tokens[index].type, [token.type for token in tokens[index + 1 : index + 2]]
    if kind in ("CALL", "CALLED"):
        return True
    return kind == "BE" and index > 0 and tokens[0].type in _NAMED and after in (["THE"], ["MY"])


def _in_name(token: Terminal, before: str, lexicon: Lexicon) -> Terminal | None:
    """*list* in *reading list*, *children's* in *the children's ward*: words of a name, whatever else they mean."""
    if token.type == "MY" and token.typed.endswith(("'s", "s'")):
        return Terminal("POSSESSIVE", token.typed, token.typed)
    if token.type in _NAMING_WORDS and before not in NO_NOUN_BEFORE and not lexicon.is_noun((token.typed,)):
        return Terminal("WORD", token.typed, token.typed)
    return None


def _of_past(token: Terminal, before: str, following: Sequence[Terminal], *, led: bool) -> Terminal | None:
    """*brought*: the verb after *once you have* or *I'd appreciate it if you*, else something that is told."""
    if token.type != "PAST" or (
        token.typed in LYING and before in NOMINAL and following[:1] and following[0].type in RELATING
    ):
        return None
    kind = _PRESENT[tuple(token.value.split())] if led else "MEANING"
    return Terminal(kind, token.value, token.typed)


def _in_phrase(token: Terminal, before: str, following: Sequence[Terminal], lexicon: Lexicon) -> Terminal | None:
    """What a word is within a noun phrase, or right after one; None where it is no part of one."""
    after = following[0].type if following else ""
    kind, value = token.type, token.value
    if token.typed in _SHUT and _is_adjective(before, after):
        kind, value = "STATE", _SHUT[token.typed]
    elif token.typed in _SIDES and before in ("THE", "MY", "THAT") and after not in END:
        kind = _SIDES[token.typed]
    elif token.typed == "lost" and before in ("BE", "NOT"):
        kind, value = "STATE", "lost"
    elif token.typed == "her" and _is_possessive(before, following):
        kind = "HIS"
    elif token.typed in LYING and before in NOMINAL | {"BE"} and after in RELATING:
        kind = "FILLER"
    elif kind == "UNABLE" and before in BEFORE_NOUN and after == "NOUN":
        kind, value = "FILLER", token.typed
    elif kind not in CLOSED_THAT_STAY and before in BEFORE_NOUN and lexicon.is_noun((token.typed,)):
        kind, value = "NOUN", token.typed
    else:
        return None
    return Terminal(kind, value, token.typed)


def _choose(token: Terminal, before: str, following: Sequence[Terminal], lexicon: Lexicon) -> Terminal:
    after = following[0].type if following else ""
    kind, value = token.type, token.value
    if token.typed in ("check", "see", "look", "find", "find out") and after in ASKED - {"IN"} and before != "CAN_YOU":
        kind = "TELL"
    elif kind == "TELL" and after not in ASKED:
        return Terminal("UNABLE", token.typed.split()[0], token.typed)
    elif kind == "UNABLE" and token.typed in lexicon.verbs:
        kind = "OPERATE"
    elif token.typed == "first" and before in NOMINAL | {"THERE", "HERE", "OVER_THERE"} and after in END:
        kind = "FILLER"
    elif token.typed == "first" and (before in ("", "THEN", "STOP", "AND", "COMMA")):
        kind = "THEN"
    elif kind == "SEE" and before in NO_NOUN_BEFORE and after in ("NAME", "PERSON"):
        kind = "VISIT"
    elif kind == "NEXT":
        kind = "THEN" if before in NO_NOUN_BEFORE else "FILLER" if after in END else "MEANING"
    elif kind == "BUT":
        kind = "EXCEPT" if after in NP_START else "AND"
    elif token.typed in POLITE_IF_VERB and _is_polite(token.typed, following):
        kind = "THEN" if token.typed == "to" and before in NOMINAL else "FILLER"
    elif token.typed == "return" and before == "AND":
        kind = "RETURN"
    elif (
        kind in ACTING
        and (token.typed in NOUNLIKE or (kind == "UNABLE" and (token.typed,) in lexicon.nouns))
        and (_is_thing_here(token, before, after, lexicon) or not _is_verb_here(before, after))
    ):
        kind = "NOUN"
    return Terminal(kind, token.typed if kind == "NOUN" else value, token.typed)


def _is_possessive(before: str, following: Sequence[Terminal]) -> bool:
    """*her cup*, but not *bring her the cup* or *bring her cups*."""
    owned = bool(following) and following[0].type in NOMINAL | MODIFYING
    receives = before in ("BRING", "GIVE", "GET", "TAKE")
    return owned and (not receives or any(token.type in ("TO", "ON", "IN", "INTO", "ONTO") for token in following))


def _is_adjective(before: str, after: str) -> bool:
    """Whether *open* or *closed* says how a door is: *is it open*, *the open door*, *the door is not open*."""
    if before in ("BE", "NOT", "DOOR"):
        return True
    return before not in NO_NOUN_BEFORE and (after == "DOOR" or (after in END and before in NOMINAL))


def _is_polite(words: str, following: Sequence[Terminal]) -> bool:
    after = following[0].type if following else ""
    if words == "to":
        return after in ACTING and _is_phrase(following[1:])
    return after in ACTING or after == "PAST" or (after == "TELL" and words.endswith("you"))


def _is_phrase(following: Sequence[Terminal]) -> bool:
    return bool(following) and following[0].type in NP_START


def _is_thing_here(token: Terminal, before: str, after: str, lexicon: Lexicon) -> bool:
    """*markers and glue in the cabinet*, *tape to me*: a thing of the graph, before what tells where."""
    where = after in RELATING | {"TO", "INTO", "ONTO", "FROM"}
    if (
        token.type == "UNABLE"
        and (token.typed,) in lexicon.nouns
        and (where or (after in END and before in NO_NOUN_BEFORE))
    ):
        return True
    return lexicon.is_noun((token.typed,)) and before in ("AND", "COMMA") and where


def _is_verb_here(before: str, after: str) -> bool:
    """A verb that is a noun as well starts a step, and something follows it, unless it is the whole request.

    After a noun it is one as well, if its object follows: *on my counter hand it to Ben*.
    """
    if before in NOMINAL and after in _OBJECTS:
        return True
    if before == "NOT":
        return after in NP_START
    return before in NO_NOUN_BEFORE and (after not in END or before in ("", "THEN", "STOP"))
