"""From parse trees to readings: Lark's tree of one step becomes a value of ``syntax``."""

from __future__ import annotations

from typing import Any

from majordomo.planner.grammar.phrases import Children, PhraseReader, tokens_of, values_of
from majordomo.planner.grammar.syntax import (
    Ask,
    Carry,
    Destination,
    Find,
    Go,
    NounPhrase,
    Pick,
    Pronoun,
    PutBack,
    PutDown,
    Quantity,
    Reference,
    Restriction,
    Several,
)
from majordomo.planner.plan import QueryKind


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

    def place(self, children: Children) -> Destination:
        destination: Destination = children[0]
        return destination

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
        return Several(steps=tuple(Carry(things=things, destination=to, verb=verb) for things, to in pairs))

    def carry_nowhere(self, children: Children) -> Carry:
        return Carry(things=values_of(children)[0], destination=None, verb=_verb(children))

    def put_back(self, children: Children) -> PutBack:
        return PutBack(things=values_of(children)[0])

    def put_down(self, children: Children) -> PutDown:
        return PutDown(things=values_of(children)[0])

    def go(self, children: Children) -> Go:
        return Go(target=values_of(children)[0])

    def go_there(self, _: Children) -> Go:
        return Go(target=Pronoun(word="there"))

    def come(self, _: Children) -> Go:
        return Go(target=Pronoun(word="me"))

    def find(self, children: Children) -> Find:
        return Find(things=values_of(children)[0])

    def find_in(self, children: Children) -> Find:
        place, things = values_of(children)
        return Find(things=things, place=place)

    def find_there(self, children: Children) -> Find:
        return Find(things=values_of(children)[0], place=Pronoun(word="there"))

    def pick(self, children: Children) -> Pick:
        return Pick(things=values_of(children)[0])

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

    def exists(self, children: Children) -> Ask:
        return _about(QueryKind.EXISTS, children)

    def exists_at(self, children: Children) -> Ask:
        return _about(QueryKind.EXISTS, children)

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


def _about(kind: QueryKind, children: Children) -> Ask:
    values = values_of(children)
    place = next((value for value in values if isinstance(value, Restriction)), None)
    return Ask(kind=kind, things=(values[0],), place=place)


def _verb(children: Children) -> str:
    tokens = tokens_of(children)
    return str(tokens[0]) if tokens else "put"


def _as_things(value: Any) -> tuple[Reference, ...]:
    return value if isinstance(value, tuple) else (value,)
