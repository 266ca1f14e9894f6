"""Questions in whatever order of words: *how many books do we own*, *where has Anna left the key*, *who is it with*.

The grammar has few shapes for questions. A question that has none of them is told again in one that it has: words
that only carry the sentence (*do*, *keep*, *left*, *still*) go, and what is asked about stays, every word of it. What
a word is asked about that nobody knows is still there and is not understood; nothing is moved by an answer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from planner.language.lexicon.terminals import ASKING, RELATING, Terminal
from planner.language.sentences.comparison import comparisons

Tokens = Sequence[Terminal]
Parses = Callable[[str, Tokens], bool]

_CARRYING = frozenset({"BE", "DO", "HAVE", "CAN", "WOULD", "CAN_YOU"})
"""What a question is built with, whatever it asks."""
_CARRYING_WORDS = frozenset({"will", "shall", "can", "could", "may", "should", "must", "been", "being", "might"})
_SPEAKING = frozenset({"I", "YOU"})
_NAMING = frozenset(
    {"NOUN", "NAME", "PERSON", "WORD", "IT", "HIM", "ONE", "EVERYTHING", "DOOR", "IDENTIFIER", "ANYTHING", "THAT",
     "POSSESSIVE", "THIS", "ALL", "BOTH"}
)  # fmt: skip
_STAYING = frozenset(
    {"belong", "belongs", "busy", "contain", "contains", "cooking", "doing", "drop", "dropped", "eating", "end",
     "ended", "exist", "exists", "expect", "expected", "find", "finds", "forget", "forgot", "forgotten",
     "found", "get", "go", "goes", "going", "gone", "got", "had", "hang", "hanging", "hangs", "happen",
     "happens", "has", "have", "having", "hidden", "hide", "hides", "hiding", "hold", "holds", "keep",
     "keeping", "keeps", "kept", "know", "laid", "lay", "laying", "leave", "left", "lie", "lies", "live",
     "lives", "living", "locate", "located", "look", "lying", "meet", "own", "owned", "owns", "parked", "place",
     "placed", "play", "playing", "plays", "possess", "put", "reading", "remain", "remains", "rest", "resting",
     "rests", "saw", "see", "seen", "sees", "set", "sit", "sits", "sitting", "situated", "sleep", "sleeping",
     "sleeps", "spend", "spending", "spot", "spotted", "stand", "standing", "stands", "stay", "staying",
     "stays", "store", "stored", "stores", "wait", "waiting", "waits", "wander", "wandered", "work", "working",
     "works"}
)  # fmt: skip
"""Verbs of being, doing or keeping something somewhere, in any form: they add nothing to *where* and *which*."""
_ADDING = frozenset(
    {"about", "actually", "again", "already", "also", "altogether", "anywhere", "around", "available",
     "currently", "days", "else", "even", "ever", "exactly", "finally", "last", "lately", "left", "more",
     "normally", "now", "over", "overall", "please", "precisely", "present", "recently", "remaining",
     "somewhere", "still", "then", "these", "today", "together", "too", "usually", "yet"}
)  # fmt: skip
"""Adverbs that change nothing in a question about the present."""
_ENDING = frozenset({"IN", "ON", "AT", "TO", "UP", "DOWN", "FROM", "INTO", "AND", "COMMA"})
_ARTICLES = frozenset({"THE", "MY", "A", "THIS", "THAT", "HIS", "POSSESSIVE"})

_WHERE, _BE = Terminal("WHERE", "where", "where"), Terminal("BE", "is", "is")
_THERE, _ROOM = Terminal("THERE", "there", "there"), Terminal("NOUN", "room", "room")
_WHICH, _HAVE = Terminal("WHICH", "which", "which"), Terminal("HAVE", "have", "have")
_WHICH_ROOM, _WHETHER = Terminal("WHICH_ROOM", "which room", "which room"), Terminal("WHETHER", "if", "if")
_WHAT, _DO = Terminal("WHAT", "what", "what"), Terminal("DO", "do", "do")


def plainly(tokens: Tokens, parses: Parses) -> list[Terminal]:
    """The same question in a shape of the grammar; empty if there is none, or if it is no question."""
    asked = _without_lead(tokens)
    if not asked or asked[0].type not in ASKING | {"ON", "IN", "NOT"}:
        return []
    return next((shape for shape in _shapes(asked) if shape and parses("question", shape)), [])


def _shapes(tokens: list[Terminal]) -> Iterator[list[Terminal]]:
    first, rest = tokens[0].type, tokens[1:]
    yield from comparisons(tokens)
    if first in ("ON", "IN") and rest and rest[0].type in ("WHAT", "WHICH"):
        yield from _wheres(_WHERE, _past_first_verb(rest))
    elif first in ("WHERE", "WHICH_ROOM", "WHICH_ROOMS"):
        yield from _rooms(rest) if first != "WHERE" else ()
        yield from _wheres(_WHICH_ROOM if first != "WHERE" else _WHERE, rest)
    elif first == "HOW_MANY":
        yield from _counts(tokens[0], rest)
    elif first == "WHO":
        yield from _whos(tokens[0], rest)
    elif first in ("WHAT", "WHICH"):
        yield from _colors(rest)
        yield from _lists(tokens[0], rest)
    elif first in ("BE", "DO", "HAVE", "CAN_YOU", "CAN"):
        yield from _whethers(tokens)


def _without_lead(tokens: Tokens) -> list[Terminal]:
    """Without *tell me*, *do you know* before a question word."""
    asked = list(tokens)
    while asked and asked[0].type in ("TELL", "COMMA", "AND", "WHETHER"):
        asked = asked[1:]
    if len(asked) > 2 and asked[0].type == "CAN_YOU" and asked[1].type == "SEE" and asked[2].type in ASKING:
        asked = asked[2:]
    return asked


def _wheres(word: Terminal, rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """*Where has Anna left the key*, *where is Ben hiding*: what is placed, else who stays."""
    for thing in _things(rest):
        if not all(token.type in _SPEAKING for token in thing):
            yield [word, _BE, *thing]


def _things(rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """What a question about a place may be about: what follows its verb, else what comes before."""
    said = [token for token in rest if _stays(token) or not _adds(token)]
    verb = next((k for k in reversed(range(len(said))) if _stays(said[k])), None)
    if verb is None:
        yield _bare(said)
        return
    subject, placed = said[:verb], _ended(said[verb + 1 :])
    if any(token.type in ("COMMA", "AND", "THEN") for token in subject) and placed:
        return
    if any(token.type in _NAMING for token in placed):
        yield _bare(placed)
    yield _bare(subject) if not placed else []


def _rooms(rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """*Which rooms have a sink in them*, *which room is next to the kitchen*, *which rooms are closed*."""
    said = [token for token in rest if not _adds(token)]
    if said and said[0].type == "HAVE":
        yield [_WHICH_ROOM, _HAVE, *_without_in_it(said[1:])]
    if said and said[0].type == "BE" and len(said) > 1:
        if said[1].type in RELATING:
            yield [_WHICH, _ROOM, *said]
        if said[1].type == "THERE":
            yield [_WHICH_ROOM, _HAVE, *_without_in_it(said[2:])]
        yield [_WHICH, _ROOM, *said]


def _without_in_it(tokens: list[Terminal]) -> list[Terminal]:
    in_it = len(tokens) > 2 and tokens[-2].type in ("IN", "ON") and tokens[-1].type in ("IT", "THERE")
    return tokens[:-2] if in_it else tokens


def _counts(word: Terminal, rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """*How many books do we own on this shelf*: the noun, and where."""
    while rest and rest[0].type == "OF":
        rest = rest[1:]
    end = next((k for k, token in enumerate(rest) if k and (_carries(token) or _stays(token) or _adds(token))), None)
    counted, tail = (rest, []) if end is None else (rest[:end], rest[end:])
    counted = [token for token in counted if token.type not in ("THE", "MY")]
    who, where = _whose_and_where(tail)
    if who is None:
        return
    if where:
        yield [word, *counted, _BE, *where]
    elif who and not any(token.type in _SPEAKING for token in who):
        yield [word, *counted, _DO, *who, _HAVE]
    if not who or any(token.type in _SPEAKING for token in who):
        yield [word, *counted, *([_BE, *where] if where else [])]


def _whose_and_where(tail: list[Terminal]) -> tuple[list[Terminal] | None, list[Terminal]]:
    """Who has what is counted, and where; None for who when there is more to it."""
    said = [token for token in tail if not (_carries(token) or _stays(token) or _adds(token))]
    placed = any(token.type in RELATING - {"THERE"} for token in said)
    said = [token for token in said if token.type != "THERE" or (token is said[-1] and not placed)]
    where = next((k for k, token in enumerate(said) if token.type in RELATING - {"THERE"}), len(said))
    who = said[:where]
    plain = all(token.type in _NAMING | _ARTICLES | _SPEAKING for token in who)
    return (who if plain else None), said[where:]


def _whos(word: Terminal, rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """*Who do I find in the lab*, *who is Anna with*."""
    said = [t for t in rest if not (_carries(t) or _stays(t) or _adds(t) or t.type in _SPEAKING or t.type == "UNABLE")]
    if len(said) > 1 and said[-1].type in ("WITH", "NEAR"):
        said = [said[-1], *said[:-1]]
    yield [word, _BE, *said]


def _colors(rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """*What are the colors of the apples*, *which color has it*."""
    at = next((k for k, token in enumerate(rest) if token.type == "COLOR_WORD"), None)
    if at is None:
        return
    before = [token for token in rest[:at] if not (_carries(token) or token.type == "THE")]
    after = [token for token in rest[at + 1 :] if not (_carries(token) or _adds(token))]
    while after and after[0].type == "OF":
        after = after[1:]
    yield [_WHAT, rest[at], _BE, *before, *after]


def _lists(word: Terminal, rest: list[Terminal]) -> Iterator[list[Terminal]]:
    """*Which book is on the shelf, the green or the red one*, *what else is kept in the box*."""
    alternatives = next((k for k, token in enumerate(rest) if token.type == "COMMA"), None)
    if alternatives is not None and any(token.type == "NOR" for token in rest[alternatives:]):
        rest = rest[:alternatives]
    said = [token for token in rest if not _adds(token)]
    where = next((k for k, token in enumerate(said) if token.type in RELATING - {"THERE", "WITH"}), len(said))
    what = [t for t in said[:where] if not (_carries(t) or _stays(t)) and t.type not in _SPEAKING | {"THERE"}]
    if what and not any(token.type in _NAMING - {"WORD"} for token in what):
        return  # *which year were you born*: nothing that is known is asked about
    if said[where:]:
        yield [word, *what, _BE, *said[where:]]
    elif what:
        yield [word, _BE, *what] if said and said[0].type == "BE" else [_WHICH, *what, _BE, _THERE]


def _whethers(tokens: list[Terminal]) -> Iterator[list[Terminal]]:
    """*Isn't there milk left in the fridge*, *is she in the lab or in the hall*."""
    first, *rest = tokens
    said = [token for k, token in enumerate(rest) if not _adds(token) and not (k == 0 and token.type == "NOT")]
    or_at = next((k for k, token in enumerate(said) if token.type == "NOR"), None)
    if or_at is not None and first.type == "BE":
        where = next((k for k, token in enumerate(said[:or_at]) if token.type in RELATING | {"COMMA"}), None)
        if where:
            yield [_WHERE, _BE, *said[:where]]
        return
    yield [first, *said]
    placed = [token for k, token in enumerate(said) if not (_stays(token) and _leads(said, k))]
    yield [first, *placed]
    if first.type in ("DO", "HAVE") and len(said) > 1:
        have = next((k for k, token in enumerate(said) if _stays(token) or token.type == "HAVE"), None)
        if have and said[0].type in _SPEAKING:
            yield [_BE, _THERE, *said[have + 1 :]]


def _leads(tokens: list[Terminal], index: int) -> bool:
    """Whether a place, or nothing, follows: *standing on the table*."""
    return index + 1 == len(tokens) or tokens[index + 1].type in RELATING


def _past_first_verb(tokens: list[Terminal]) -> list[Terminal]:
    """What follows the first verb: *on which shelf is the book lying*."""
    verb = next((k for k, token in enumerate(tokens) if _carries(token)), None)
    return tokens[verb:] if verb is not None else []


def _bare(tokens: list[Terminal]) -> list[Terminal]:
    """Without what only carries the question, at both ends."""
    start = 0
    while start < len(tokens) and (_carries(tokens[start]) or tokens[start].type == "ALL"):
        start += 1
    return _ended([token for token in tokens[start:] if not _carries(token)])


def _ended(tokens: list[Terminal]) -> list[Terminal]:
    end = len(tokens)
    while end and tokens[end - 1].type in _ENDING:
        end -= 1
    return tokens[:end]


def _carries(token: Terminal) -> bool:
    return token.type in _CARRYING or token.typed in _CARRYING_WORDS


def _stays(token: Terminal) -> bool:
    return token.type not in ("NOUN", "NAME") and token.typed.split()[0] in _STAYING


def _adds(token: Terminal) -> bool:
    return token.type not in ("NOUN", "NAME", "NEAR") and token.typed in _ADDING
