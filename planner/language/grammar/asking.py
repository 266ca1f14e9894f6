"""From parse trees to questions: ``where``, ``count``, ``exists`` and the like of ``commands.lark``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from planner.language.grammar.children import Children, tokens_of, values_of
from planner.language.grammar.references import ORDINALS, SUPERLATIVE, PhraseReader
from planner.language.grammar.syntax import Ask, NounPhrase, Pronoun, Quantity, Reference, Restriction
from planner.plan import QueryKind

_COMPARED = {"BIG": "bigger", "SMALL": "smaller", "NEAREST": "nearer", "FARTHEST": "farther"}


class QuestionReader(PhraseReader):
    """One method a rule: how questions and conditions are read."""

    def question(self, children: Children) -> Ask:
        asked: Ask = values_of(children)[0]
        return asked

    def where(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.WHERE, things=_things(children))

    def room_of(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.ROOM_OF, things=_things(children))

    def robot_room(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.ROBOT_ROOM)

    def where_me(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.WHERE, things=(Pronoun(word="me"),))

    def count(self, children: Children) -> Ask:
        return _about(QueryKind.COUNT, children)

    def list_at(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.LIST, place=values_of(children)[0])

    def list_of(self, children: Children) -> Ask:
        return _about(QueryKind.LIST, children)

    def seen(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.SEEN)

    def describe(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.LIST, place=Restriction(relation="at", reference=values_of(children)[0]))

    def exists(self, children: Children) -> Ask:
        return _about(QueryKind.EXISTS, children)

    def exists_no(self, children: Children) -> Ask:
        return replace(_about(QueryKind.EXISTS, children), negated=True)

    def exists_at(self, children: Children) -> Ask:
        return _about(QueryKind.EXISTS, children)

    def seen_if(self, children: Children) -> Ask:
        return _about(QueryKind.EXISTS, children)

    def compared(self, children: Children) -> Ask:
        (least, most), phrase = values_of(children)
        return replace(_about(QueryKind.EXISTS, [phrase]), least=least, most=most)

    def comparison(self, children: Children) -> tuple[int | None, int | None]:
        kind, number = children[0].type, 1 if children[1].type == "ONE" else int(children[1])
        return {
            "MORE_THAN": (number + 1, None),
            "AT_LEAST": (number, None),
            "LESS_THAN": (None, number - 1),
            "AT_MOST": (None, number),
        }[kind]

    def open_closed(self, children: Children) -> Ask:
        return _is_so("state", children)

    def is_colored(self, children: Children) -> Ask:
        return _is_so("color", children)

    def which_most(self, children: Children) -> Ask:
        phrase, *rest = values_of(children)
        merged = replace(phrase, quantity=Quantity.ALL, **(rest[0] if rest else {}))
        return Ask(kind=QueryKind.WHERE, things=(merged,))

    def most(self, children: Children) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for token in tokens_of(children):
            if token.type == "ORDINAL":
                found["rank"] = ORDINALS[str(token)]
            elif token.type in ("BIG", "SMALL"):
                found["superlative"] = "largest" if token.type == "BIG" else "smallest"
            elif token.type in SUPERLATIVE:
                found["superlative"] = SUPERLATIVE[token.type]
        values = values_of(children)
        if values and isinstance(values[0], Restriction):
            found["restrictions"] = (values[0],)
        elif values:
            found["superlative"] = None
            found["restrictions"] = (Restriction(relation="nearest", reference=values[0]),)
        return found

    def most_at(self, children: Children) -> Ask:
        """*Which room has the most cups.*"""
        word = next(t.type for t in tokens_of(children) if t.type in ("MOST", "FEWEST"))
        return Ask(kind=QueryKind.MOST, things=tuple(values_of(children)), word=word.lower())

    def more_at(self, children: Children) -> Ask:
        """*Which has more cups, the table or the desk*; *has the table more cups than the desk*."""
        word = next(t.type for t in tokens_of(children) if t.type in ("MORE", "FEWER"))
        whether = tokens_of(children)[0].type == "BE"
        return Ask(kind=QueryKind.MORE, things=tuple(values_of(children)), word=word.lower(), least=int(whether))

    def compared_size(self, children: Children) -> Ask:
        """*Which is bigger, the red cup or the blue one*: the noun may be said with one of them only."""
        one, other = values_of(children)
        token = tokens_of(children)[1]
        if isinstance(one, NounPhrase) and isinstance(other, NounPhrase):
            one = replace(one, words=other.words) if one.words == ("one",) else one
            other = replace(other, words=one.words) if other.words == ("one",) else other
        whether = tokens_of(children)[0].type == "BE"
        return Ask(kind=QueryKind.COMPARE, things=(one, other), word=_COMPARED[token.type], least=int(whether))

    def support(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.WHERE, things=next(v for v in values_of(children) if isinstance(v, tuple)))

    def distance(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.DISTANCE, things=tuple(values_of(children)))

    def size(self, children: Children) -> Ask:
        return _about(QueryKind.SIZE, children)

    def way(self, children: Children) -> Ask:
        values = values_of(children)
        backwards = [token.type for token in tokens_of(children)][:2] == ["WAY", "FROM"]
        return Ask(kind=QueryKind.PATH, things=tuple(reversed(values)) if backwards else tuple(values))

    def last_seen(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.LAST_SEEN, things=values_of(children)[0])

    def did(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.DONE)

    def failure(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.FAILURE)

    def doing(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.DOING)

    def explored(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.EXPLORED)

    def battery(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.BATTERY)

    def own_nature(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.NATURE)

    def well_being(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.WELL_BEING)

    def source(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.SOURCE)

    def asked_before(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.ASKED)

    def did_it(self, children: Children) -> Ask:
        """*Did you bring the apple*: what came of it; the deed is only asked about."""
        deed = values_of(children)[0]
        things = getattr(deed, "things", None) or (getattr(deed, "target", None) or Pronoun(word="me"),)
        return Ask(kind=QueryKind.DONE_WITH, things=tuple(things))

    def duration(self, children: Children) -> Ask:
        """*How long to reach the kitchen*, *to fetch the apple*."""
        carried = any(token.type == "BRING" for token in tokens_of(children))
        what = next(iter(values_of(children)), Pronoun(word="me"))
        return Ask(kind=QueryKind.DURATION, things=(what,), word="fetch" if carried else "reach")

    def nothing_at(self, children: Children) -> Ask:
        """*Is there nothing on the table.*"""
        return Ask(kind=QueryKind.EXISTS, place=values_of(children)[0], negated=True)

    def anything_at(self, children: Children) -> Ask:
        """*If there is anything on the table.*"""
        return Ask(kind=QueryKind.EXISTS, place=values_of(children)[0])

    def own_name(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.NAME)

    def own_self(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.NAME, things=(Pronoun(word="me"),))

    def capable(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.CAPABLE, things=tuple(values_of(children)))

    def holding(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.HOLDING, things=tuple(values_of(children)))

    def rooms(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.ROOMS)

    def color(self, children: Children) -> Ask:
        return _about(QueryKind.COLOR, children)

    def abilities(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.ABILITIES)

    def who(self, children: Children) -> Ask:
        places = values_of(children)
        people = NounPhrase(words=("people",), quantity=Quantity.ALL, person=True)
        return Ask(kind=QueryKind.LIST, things=(people,), place=places[0] if places else None)

    def has(self, children: Children) -> Ask:
        """*The bowl has at least two apples.*"""
        where, *limits, what = values_of(children)
        least, most = limits[0] if limits else (None, None)
        place = Restriction(relation="at", reference=where)
        return Ask(kind=QueryKind.EXISTS, things=(what,), place=place, least=least, most=most)


def _things(children: Children) -> tuple[Reference, ...]:
    """What is asked about: things, or *he* and *she*."""
    things: tuple[Reference, ...] = next(iter(values_of(children)), (Pronoun(word="him"),))
    return things


def _is_so(relation: str, children: Children) -> Ask:
    tokens = tokens_of(children)
    place = Restriction(relation=relation, word=str(tokens[-1]))
    negated = any(token.type == "NOT" for token in tokens)
    return Ask(kind=QueryKind.EXISTS, things=(values_of(children)[0],), place=place, negated=negated)


def _about(kind: QueryKind, children: Children) -> Ask:
    values = values_of(children) or [Pronoun(word="him")]
    place = next((value for value in values if isinstance(value, Restriction)), None)
    return Ask(kind=kind, things=(values[0],), place=place)
