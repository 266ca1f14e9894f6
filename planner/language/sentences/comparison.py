"""Questions that compare, in a shape of the grammar: *where are most of the books*, *is the red cup bigger than it*."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planner.language.lexicon.terminals import Terminal

Tokens = Sequence[Terminal]

_MOST, _MORE = frozenset({"MOST", "FEWEST"}), frozenset({"MORE", "FEWER"})
_SCALES = frozenset({"BIG", "SMALL", "NEAREST", "FARTHEST"})
_PLACING = frozenset({"BE", "HAVE", "DO", "CAN", "I", "YOU", "THERE", "SEE", "CAN_YOU", "FIND", "IN", "ON", "COMMA"})
_LEFT = frozenset({"left", "kept", "stored", "inside", "live", "lie"})
_WHICH, _HAVE = Terminal("WHICH", "which", "which"), Terminal("HAVE", "have", "have")
_IS, _THAN = Terminal("BE", "is", "is"), frozenset({"THAN"})
_ROOM, _THINGS = Terminal("NOUN", "room", "room"), Terminal("NOUN", "things", "things")
_COMMA, _OR = Terminal("COMMA", ",", ","), Terminal("NOR", "or", "or")


def comparisons(tokens: list[Terminal]) -> Iterator[list[Terminal]]:
    """Shapes that a question which compares may have; none of another question."""
    kinds = [token.type for token in tokens]
    if _MOST & set(kinds):
        yield from _mosts(tokens, next(k for k, kind in enumerate(kinds) if kind in _MOST))
    elif _MORE & set(kinds):
        yield from _mores(tokens, next(k for k, kind in enumerate(kinds) if kind in _MORE))
    elif kinds[0] in ("WHICH", "WHAT", "WHO", "BE") and {"NOR", "THAN"} & set(kinds):
        yield from _scales(tokens)


def _mosts(tokens: list[Terminal], at: int) -> Iterator[list[Terminal]]:
    """*Which shelf has the most books on it*, *in which room do we have most books*, *which room is fullest*."""
    place = [token for token in tokens[1:at] if token.type not in _PLACING | {"THE"}]
    if tokens[0].type in ("WHERE", "WHICH_ROOM", "WHICH_ROOMS"):
        place = [_ROOM, *place]
    counted = _counted(tokens[at + 1 :])
    if tokens[0].type in ("WHERE", "WHICH_ROOM", "WHICH_ROOMS", "WHICH", "WHAT") and place:
        yield [_WHICH, *place, _HAVE, tokens[at], *(counted or [_THINGS])]


def _mores(tokens: list[Terminal], at: int) -> Iterator[list[Terminal]]:
    """*What has more cups on it, the table or the desk*, *does the table have more cups than the desk*."""
    before = [t for t in tokens[:at] if t.type not in _PLACING | {"WHICH", "WHAT", "WHICH_ROOM", "WITH", "ONE"}]
    after = tokens[at + 1 :]
    if not {"THAN", "NOR"} & {token.type for token in after}:
        superlative = Terminal("MOST" if tokens[at].type == "MORE" else "FEWEST", "most", tokens[at].typed)
        yield from _mosts([*tokens[:at], superlative, *after], at)
        return
    counted = _counted(after)
    sides = [token for token in after[len(counted) :] if token.type not in _PLACING and token.typed not in _LEFT]
    sides = [*before, *(_OR if token.type == "THAN" else token for token in sides if token.type != "IT")]
    asked = _IS if tokens[0].type in ("BE", "DO", "HAVE") and _THAN & {token.type for token in after} else _WHICH
    yield [asked, _HAVE, tokens[at], *(counted or [_THINGS]), _COMMA, *sides]


def _counted(tokens: list[Terminal]) -> list[Terminal]:
    """The noun that is counted, without *of the* before and *on it* after."""
    start = 0
    while start < len(tokens) and tokens[start].type in ("OF", "THE", "MY"):
        start += 1
    ending = _PLACING | {"THAN", "NOR"}
    end = next((k for k in range(start, len(tokens)) if tokens[k].type in ending or tokens[k].typed in _LEFT), None)
    return tokens[start:end]


def _scales(tokens: list[Terminal]) -> Iterator[list[Terminal]]:
    """*Which one is bigger, the red ball or the blue one*, *is the hall bigger than the kitchen*."""
    first, *rest = tokens
    scale = next((k for k, token in enumerate(rest) if token.type in _SCALES and _compares(rest, k)), None)
    if scale is None:
        return
    after = rest[scale + 1 :]
    if after[:1] and after[0].type == "TO" and len(after) > 1 and after[1].type in ("ME", "YOU", "HERE"):
        after = after[2:]
    asked = [token for token in rest[:scale] if token.type not in ("ONE", "OF", "IT", "COMMA")]
    if first.type == "BE" and after and after[0].type == "THAN":
        yield [first, rest[scale], _COMMA, *asked, _OR, *after[1:]]
    elif first.type != "BE" and all(token.type == "BE" for token in asked) and after:
        yield [_WHICH, rest[scale], _COMMA, *(after[1:] if after[0].type == "COMMA" else after)]


def _compares(tokens: list[Terminal], index: int) -> bool:
    """Whether a word of size ends what is said of something: *is bigger*, not *the big ball*."""
    ending = ("THAN", "COMMA", "THE", "MY", "A", "THIS", "TO", "NAME")
    return index + 1 < len(tokens) and tokens[index + 1].type in ending
