"""From parse trees to readings: Lark's tree of one step becomes a value of ``syntax``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from planner.language.grammar.agreement import apposed, generic, is_definite
from planner.language.grammar.asking import QuestionReader
from planner.language.grammar.children import Children, tokens_of, values_of
from planner.language.grammar.syntax import (
    Carry,
    Destination,
    Find,
    Go,
    Mention,
    NounPhrase,
    Operate,
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
    Wanted,
)

_WAITING = frozenset({"wait", "stay", "remain"})
NONSENSE = NounPhrase(words=())
"""Stands where words would be dropped; no reading with it is kept."""


class Reader(QuestionReader):
    """One method a rule: how commands are read, and what is taught."""

    def dest_to(self, children: Children) -> Destination:
        return Destination(relation="to", reference=values_of(children)[0], back=_goes_back(children))

    def dest_in(self, children: Children) -> Destination:
        return Destination(relation="in", reference=values_of(children)[0], back=_goes_back(children))

    def dest_on(self, children: Children) -> Destination:
        return Destination(relation="on", reference=values_of(children)[0], back=_goes_back(children))

    def dest_near(self, children: Children) -> Destination:
        return Destination(relation="near", reference=values_of(children)[0])

    def dest_here(self, _: Children) -> Destination:
        return Destination(relation="to", reference=Pronoun(word="here"))

    def dest_there(self, _: Children) -> Destination:
        return Destination(relation="to", reference=Pronoun(word="there"))

    def dest_beside(self, children: Children) -> Destination:
        reference, *other = values_of(children)
        return Destination(relation=str(tokens_of(children)[0]), reference=reference, other=other[0] if other else None)

    def dest_spot(self, children: Children) -> Destination:
        return Destination(relation="to", reference=values_of(children)[0])

    def place(self, children: Children) -> Destination:
        destination: Destination = children[0]
        return destination

    def with_exception(self, children: Children) -> Step:
        deed, (_, left_out) = values_of(children)
        if isinstance(deed, Perhaps):
            inner = self.with_exception([deed.step, children[-1]])
            return replace(deed, step=inner) if isinstance(inner, Carry) else inner
        things = tuple(
            replace(thing, exceptions=(*thing.exceptions, *left_out)) if isinstance(thing, NounPhrase) else thing
            for thing in getattr(deed, "things", ())
        )
        return replace(deed, things=things) if things else Go(target=NONSENSE)

    def with_more(self, children: Children) -> Step:
        """*Put the milk on the counter, and the juice too.*"""
        deed, more = values_of(children)
        if not isinstance(deed, Carry) or deed.destination is None:
            return Go(target=NONSENSE)
        return replace(deed, things=(*deed.things, *more))

    def with_favor(self, children: Children) -> Step:
        """*Go to the kitchen for me.*"""
        deed: Step = values_of(children)[0]
        return deed

    def with_choice(self, children: Children) -> Step:
        """*Put the cup on the desk, the red one*: said of the thing."""
        deed, choice = values_of(children)
        things: tuple[Reference, ...] = getattr(deed, "things", ())
        if len(things) != 1 or not isinstance(deed, Carry | Pick | Find):
            return Go(target=NONSENSE)
        one, *rest = apposed(things[0], choice)
        return Go(target=NONSENSE) if rest else replace(deed, things=(one,))

    def with_neither(self, children: Children) -> Step:
        """*I want a folder on the table, neither blue nor red*: said of the thing."""
        colors = [str(token) for token in tokens_of(children) if token.type in ("COLOR", "ORANGE")]
        neither = tuple(Restriction(relation="color", word=color, negated=True) for color in colors)
        choice = NounPhrase(words=("one",), restrictions=neither)
        return self.with_choice([values_of(children)[0], choice])

    def goes(self, children: Children) -> Perhaps:
        return replace(self.statement(children), sure=True)

    def dest_floor(self, _: Children) -> Destination:
        return Destination(relation="on the floor", reference=Pronoun(word="here"))

    def laid(self, children: Children) -> Perhaps:
        things, destination = values_of(children)
        every = tuple(map(generic, _as_things(things)))
        return Perhaps(step=Carry(things=every, destination=destination), verbless=True)

    def laid_to(self, children: Children) -> Perhaps:
        return replace(self.laid(children), sure=True)

    def wanted(self, children: Children) -> Wanted:
        return Wanted(thing=values_of(children)[0])

    def statement(self, children: Children) -> Perhaps:
        things, destination = values_of(children)
        return Perhaps(step=Carry(things=tuple(map(generic, _as_things(things))), destination=destination))

    def wants(self, children: Children) -> Carry:
        named = next(token for token in tokens_of(children) if token.type in ("NAME", "PERSON", "HIM"))
        person = self.recipient([named])
        destination = Destination(relation="to", reference=person)
        return Carry(things=values_of(children)[0], destination=destination, verb="bring")

    def wants_there(self, children: Children) -> Carry:
        """*Tom needs a spoon in the lab*: where he is."""
        carry = self.wants(children)
        person = NounPhrase(words=(str(tokens_of(children)[0]),), quantity=Quantity.THE, person=True)
        where = Restriction(relation="in", reference=values_of(children)[1])
        destination = Destination(relation="to", reference=replace(person, restrictions=(where,)))
        return replace(carry, destination=destination)

    def bring(self, children: Children) -> Carry:
        values = values_of(children)
        things = next(_as_things(value) for value in values if isinstance(value, tuple) or value is values[-1])
        recipient = next(value for value in values if not isinstance(value, tuple))
        return Carry(things=things, destination=Destination(relation="to", reference=recipient), verb=_verb(children))

    def bring_named(self, children: Children) -> Carry:
        """*Bring key Anna*, as typed in haste."""
        person = NounPhrase(words=(str(tokens_of(children)[-1]),), quantity=Quantity.THE, person=True)
        destination = Destination(relation="to", reference=person)
        return Carry(things=_as_things(values_of(children)[0]), destination=destination, verb=_verb(children))

    def bring_implied(self, children: Children) -> Carry:
        destination = Destination(relation="to", reference=Pronoun(word="me"))
        return Carry(things=values_of(children)[0], destination=destination, implied=True, verb=_verb(children))

    def carry(self, children: Children) -> Carry:
        values = values_of(children)
        destination = next(value for value in values if isinstance(value, Destination))
        things = next(value for value in values if isinstance(value, tuple))
        if any(token.type == "SHOULD" for token in tokens_of(children)):
            things = tuple(map(generic, things))
        if _verb(children) == "return":
            destination = replace(destination, back=True)
        return Carry(things=things, destination=destination, verb=_verb(children))

    def gapped(self, children: Children) -> Several:
        values = values_of(children)
        pairs = zip(values[::2], values[1::2], strict=True)
        verb = _verb(children)
        return Several(steps=tuple(_carried(one, other, verb) for one, other in pairs))

    def laid_several(self, children: Children) -> Several:
        """*Towels in the basket and toothbrushes in the cabinet.*"""
        values = [tuple(map(generic, value)) if isinstance(value, tuple) else value for value in values_of(children)]
        pairs = zip(values[::2], values[1::2], strict=True)
        return Several(steps=tuple(_carried(one, other, "put") for one, other in pairs), verbless=True)

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

    def operate(self, children: Children) -> Operate:
        return Operate(verb=_verb(children), thing=values_of(children)[0])

    def put_down(self, children: Children) -> PutDown:
        return PutDown(things=values_of(children)[0])

    def go(self, children: Children) -> Go:
        return Go(target=values_of(children)[0], stays=_stays(children))

    def stay(self, _: Children) -> Go:
        """*… and wait for me*: where the step before led."""
        return Go(target=None, stays=True)

    def stay_there(self, _: Children) -> Go:
        return Go(target=Pronoun(word="there"), stays=True)

    def go_there(self, _: Children) -> Go:
        return Go(target=Pronoun(word="there"))

    def come(self, children: Children) -> Go:
        """Whoever comes *back* may do so without knowing where the speaker is."""
        back = any(token.type in ("BACK", "RETURN") for token in tokens_of(children))
        return Go(target=Pronoun(word="here" if back else "me"), stays=_stays(children))

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
        called = any(token.type in ("CALL", "CALLED") for token in tokens_of(children))
        return replace(_teach(children), target=Pronoun(word="that"), called=called)

    def teach_me(self, children: Children) -> Teach:
        sure = tokens_of(children)[0].type == "MY_NAME"
        return replace(_teach(children), target=Pronoun(word="me"), named=sure)

    def teach_mine(self, children: Children) -> Teach:
        """*My mug is the green one*: the one of that noun."""
        words = tuple(str(token) for token in tokens_of(children) if token.type in ("NOUN", "WORD"))
        target = values_of(children)[0]
        return Teach(words=words, mine=True, named=True, target=replace(target, words=words))

    def narrated(self, children: Children) -> Mention:
        """*There is a mug on the desk*: said before what is to be done with it."""
        thing, *where = values_of(children)
        states = [str(token) for token in tokens_of(children) if token.type == "STATE"]
        colors = [str(token) for token in tokens_of(children) if token.type in ("COLOR", "ORANGE")]
        if where:
            thing = replace(thing, restrictions=(*thing.restrictions, *where))
        whose = [self.recipient([token]) for token in tokens_of(children) if token.type in ("NAME", "PERSON")]
        who = whose[0] if whose else None
        return Mention(thing=replace(thing, colors=(*thing.colors, *colors)), who=who, lost=bool(states))

    def topic(self, children: Children) -> Mention:
        """*The key*, before *bring it to Ben*."""
        thing, *more = (each if is_definite(each) else generic(each) for each in values_of(children)[0])
        return Mention(thing=thing, more=tuple(more))

    def narrated_lost(self, children: Children) -> Mention:
        """*The phone is missing*."""
        return Mention(thing=values_of(children)[0], lost=True)

    def narrated_person(self, children: Children) -> Mention:
        """*Ben is hungry*: what follows is about him."""
        return Mention(thing=self.recipient([children[0]]))

    def go_home(self, children: Children) -> Go:
        """*Go to Ben's*: to his room."""
        return Go(target=replace(NounPhrase(words=("room",)), **self.owned([children[-1]])))

    def referred(self, children: Children) -> Reference:
        reference: Reference = values_of(children)[0]
        return reference

    def start(self, _: Children) -> Pronoun:
        return Pronoun(word="start")

    def speaking(self, children: Children) -> Pronoun:
        return Pronoun(word={"YOU": "you", "I": "me"}.get(children[0].type, "him"))

    def teach_np(self, children: Children) -> Teach:
        return replace(_teach(children), target=values_of(children)[0])


def _goes_back(children: Children) -> bool:
    """*Back to*, *back on*: to where it was before."""
    return any(token.startswith("back") for token in tokens_of(children))


def _stays(children: Children) -> bool:
    return any(token.type == "STAND" and _WAITING & set(str(token).split()) for token in tokens_of(children))


def _carried(one: Any, other: Any, verb: str) -> Carry:
    if isinstance(one, tuple) and not isinstance(other, Destination | tuple):
        other = Destination(relation="to", reference=other)
    if isinstance(other, Destination):
        return Carry(things=_as_things(one), destination=other, verb=verb)
    return Carry(things=_as_things(other), destination=Destination(relation="to", reference=one), verb=verb)


def _verb(children: Children) -> str:
    tokens = tokens_of(children)
    return str(tokens[0]) if tokens else "put"


def _as_things(value: Any) -> tuple[Reference, ...]:
    return value if isinstance(value, tuple) else (value,)


def _teach(children: Children) -> Teach:
    teach: Teach = values_of(children)[-1]
    return teach
