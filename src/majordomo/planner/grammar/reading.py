"""From parse trees to readings: Lark's tree of one step becomes a value of ``syntax``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from majordomo.planner.grammar.phrases import ORDINALS, SUPERLATIVE, Children, PhraseReader, tokens_of, values_of
from majordomo.planner.grammar.syntax import (
    Ask,
    Carry,
    Destination,
    Find,
    Go,
    NounPhrase,
    Perhaps,
    Pick,
    Pronoun,
    PutBack,
    PutDown,
    Quantity,
    Reference,
    Restriction,
    Several,
    Spot,
    Step,
    Teach,
)
from majordomo.planner.plan import QueryKind

NONSENSE = NounPhrase(words=())
"""Stands where words would be dropped; no reading with it is kept."""


class Reader(PhraseReader):
    """One method a rule: how commands and questions are read."""

    def dest_to(self, children: Children) -> Destination:
        return Destination(relation="to", reference=values_of(children)[0])

    def dest_in(self, children: Children) -> Destination:
        return Destination(relation="in", reference=values_of(children)[0])

    def dest_on(self, children: Children) -> Destination:
        return Destination(relation="on", reference=values_of(children)[0])

    def dest_near(self, children: Children) -> Destination:
        return Destination(relation="near", reference=values_of(children)[0])

    def dest_here(self, _: Children) -> Destination:
        return Destination(relation="to", reference=Pronoun(word="here"))

    def dest_there(self, _: Children) -> Destination:
        return Destination(relation="to", reference=Pronoun(word="there"))

    def dest_beside(self, children: Children) -> Destination:
        return Destination(relation=str(tokens_of(children)[0]), reference=values_of(children)[0])

    def dest_spot(self, children: Children) -> Destination:
        return Destination(relation="to", reference=values_of(children)[0])

    def place(self, children: Children) -> Destination:
        destination: Destination = children[0]
        return destination

    def with_exception(self, children: Children) -> Step:
        deed, (_, left_out) = values_of(children)
        things = tuple(
            replace(thing, exceptions=(*thing.exceptions, *left_out)) if isinstance(thing, NounPhrase) else thing
            for thing in getattr(deed, "things", ())
        )
        return replace(deed, things=things) if things else Go(target=NONSENSE)

    def statement(self, children: Children) -> Perhaps:
        things, destination = values_of(children)
        return Perhaps(step=Carry(things=_as_things(things), destination=destination))

    def wants(self, children: Children) -> Carry:
        person = NounPhrase(words=(str(children[0]),), quantity=Quantity.THE, person=True)
        destination = Destination(relation="to", reference=person)
        return Carry(things=values_of(children)[0], destination=destination, verb="bring")

    def bring(self, children: Children) -> Carry:
        values = values_of(children)
        things = next(_as_things(value) for value in values if isinstance(value, tuple) or value is values[-1])
        recipient = next(value for value in values if not isinstance(value, tuple))
        return Carry(things=things, destination=Destination(relation="to", reference=recipient), verb=_verb(children))

    def bring_implied(self, children: Children) -> Carry:
        destination = Destination(relation="to", reference=Pronoun(word="me"))
        return Carry(things=values_of(children)[0], destination=destination, implied=True, verb=_verb(children))

    def carry(self, children: Children) -> Carry:
        values = values_of(children)
        destination = next(value for value in values if isinstance(value, Destination))
        things = next(value for value in values if isinstance(value, tuple))
        return Carry(things=things, destination=destination, verb=_verb(children))

    def gapped(self, children: Children) -> Several:
        values = values_of(children)
        pairs = zip(values[::2], values[1::2], strict=True)
        verb = _verb(children)
        return Several(steps=tuple(_carried(one, other, verb) for one, other in pairs))

    def go_several(self, children: Children) -> Several:
        return Several(steps=tuple(Go(target=target) for target in values_of(children)))

    def carry_nowhere(self, children: Children) -> Carry:
        return Carry(things=values_of(children)[0], destination=None, verb=_verb(children))

    def put_back(self, children: Children) -> PutBack:
        values = values_of(children)
        meant = all(value.past for value in values[1:])
        return PutBack(things=values[0] if meant else (NONSENSE,))

    def past_spot(self, children: Children) -> Spot:
        return Spot(thing=Pronoun(word="it"), past=str(tokens_of(children)[-1]) in ("was", "were"))

    def put_down(self, children: Children) -> PutDown:
        return PutDown(things=values_of(children)[0])

    def go(self, children: Children) -> Go:
        return Go(target=values_of(children)[0])

    def go_there(self, _: Children) -> Go:
        return Go(target=Pronoun(word="there"))

    def come(self, children: Children) -> Go:
        """Whoever comes *back* may do so without knowing where the speaker is."""
        back = any(token.type in ("BACK", "RETURN") for token in tokens_of(children))
        return Go(target=Pronoun(word="here" if back else "me"))

    def find(self, children: Children) -> Find:
        return Find(things=values_of(children)[0])

    def find_in(self, children: Children) -> Find:
        place, things = values_of(children)
        return Find(things=things, place=place)

    def find_there(self, children: Children) -> Find:
        return Find(things=values_of(children)[0], place=Pronoun(word="there"))

    def pick(self, children: Children) -> Pick:
        return Pick(things=values_of(children)[0])

    def called(self, children: Children) -> Teach:
        words = tuple(str(token) for token in children if token.type not in ("THE", "A", "MY", "THAT", "CALLED"))
        return Teach(words=words, named=not any(token.type == "A" for token in children))

    def called_mine(self, children: Children) -> Teach:
        called: Teach = self.called(children)
        return replace(called, mine=True)

    def teach_this(self, children: Children) -> Teach:
        return replace(_teach(children), target=Pronoun(word="this"))

    def teach_that(self, children: Children) -> Teach:
        return replace(_teach(children), target=Pronoun(word="that"))

    def teach_me(self, children: Children) -> Teach:
        sure = tokens_of(children)[0].type == "MY_NAME"
        return replace(_teach(children), target=Pronoun(word="me"), named=sure)

    def teach_np(self, children: Children) -> Teach:
        return replace(_teach(children), target=values_of(children)[0])

    def question(self, children: Children) -> Ask:
        asked: Ask = values_of(children)[0]
        return asked

    def where(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.WHERE, things=values_of(children)[0])

    def room_of(self, children: Children) -> Ask:
        return Ask(kind=QueryKind.ROOM_OF, things=values_of(children)[0])

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
        kind, number = children[0].type, int(children[1])
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

    def battery(self, _: Children) -> Ask:
        return Ask(kind=QueryKind.BATTERY)

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


def _is_so(relation: str, children: Children) -> Ask:
    tokens = tokens_of(children)
    place = Restriction(relation=relation, word=str(tokens[-1]))
    negated = any(token.type == "NOT" for token in tokens)
    return Ask(kind=QueryKind.EXISTS, things=(values_of(children)[0],), place=place, negated=negated)


def _carried(one: Any, other: Any, verb: str) -> Carry:
    if isinstance(other, Destination):
        return Carry(things=_as_things(one), destination=other, verb=verb)
    return Carry(things=_as_things(other), destination=Destination(relation="to", reference=one), verb=verb)


def _about(kind: QueryKind, children: Children) -> Ask:
    values = values_of(children)
    place = next((value for value in values if isinstance(value, Restriction)), None)
    return Ask(kind=kind, things=(values[0],), place=place)


def _verb(children: Children) -> str:
    tokens = tokens_of(children)
    return str(tokens[0]) if tokens else "put"


def _as_things(value: Any) -> tuple[Reference, ...]:
    return value if isinstance(value, tuple) else (value,)


def _teach(children: Children) -> Teach:
    teach: Teach = values_of(children)[-1]
    return teach
