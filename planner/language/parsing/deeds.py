"""What is to be done, and with what: constructions beyond a plain verb and its things."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token as LarkToken

from planner.language.grammar.children import Children, tokens_of, values_of
from planner.language.grammar.reading import Reader
from planner.language.grammar.syntax import (
    Carry,
    Destination,
    NounPhrase,
    Pick,
    Pronoun,
    Quantity,
    Reference,
    Restriction,
    Several,
    Swap,
)


class DeedReader(Reader):
    """One method a rule of ``request.lark`` that is about deeds, things and persons."""

    def swap(self, children: Children) -> Swap | None:
        things: tuple[Reference, ...] = ()
        for value in values_of(children):
            things += value if isinstance(value, tuple) else (value,)
        return Swap(things=things) if 1 <= len(things) <= 2 else None

    def swap_crosswise(self, children: Children) -> Swap | None:
        """*Put A where B is and B where A is.*"""
        one, other, same_other, same_one = values_of(children)
        return (
            Swap(things=(one, other)) if _head(one) == _head(same_one) and _head(other) == _head(same_other) else None
        )

    def clear(self, children: Children) -> Carry:
        """*Remove the cups from the table*, with no word about where to."""
        things, *place = values_of(children)
        if place:
            things = tuple(at_place(thing, place[0]) for thing in things)
        return Carry(things=things, destination=None, verb="put")

    def clear_all(self, children: Children) -> Carry:
        (place,) = values_of(children)
        every = NounPhrase(words=("things",), quantity=Quantity.ALL)
        return Carry(things=(at_place(every, place),), destination=None, verb="put")

    def clear_of(self, children: Children) -> Carry:
        place, things = values_of(children)
        return Carry(things=tuple(at_place(_all(thing), place) for thing in things), destination=None, verb="put")

    def clear_no(self, children: Children) -> Carry:
        things, place = values_of(children)
        return Carry(things=tuple(at_place(_all(thing), place) for thing in things), destination=None, verb="put")

    def clear_away(self, children: Children) -> Carry:
        return Carry(things=values_of(children)[0], destination=None, verb="put")

    def performed(self, children: Children) -> Carry:
        things, *rest = values_of(children)
        if len(rest) == 2:
            things = tuple(at_place(thing, rest[0]) for thing in things)
        return Carry(things=things, destination=rest[-1], verb="move")

    def performed_for(self, children: Children) -> Carry:
        things, person = values_of(children)
        return Carry(things=things, destination=Destination(relation="to", reference=person), verb="bring")

    def learner(self, children: Children) -> Carry:
        things, *source, where = values_of(children)
        things = tuple(at_place(thing, source[0]) for thing in things) if source else things
        destination = where if isinstance(where, Destination) else Destination(relation="to", reference=where)
        return Carry(things=things, destination=destination, verb="put")

    def learner_it(self, children: Children) -> Carry:
        return Carry(things=(Pronoun(word="it"),), destination=values_of(children)[0], verb="put")

    def learner_it_for(self, children: Children) -> Carry:
        destination = Destination(relation="to", reference=values_of(children)[0])
        return Carry(things=(Pronoun(word="it"),), destination=destination, verb="bring")

    def learner_for(self, children: Children) -> Carry:
        person, things = values_of(children)
        return Carry(things=things, destination=Destination(relation="to", reference=person), verb="bring")

    def carry(self, children: Children) -> Any:
        """As any carrying; *put them side by side*, with no place, puts the others beside the last."""
        values = values_of(children)
        if any(isinstance(value, Destination) for value in values):
            return super().carry(children)
        (things,) = values
        if len(things) < 2:
            return Carry(things=things, destination=None, verb="put")
        return Carry(things=things[:-1], destination=Destination(relation="near", reference=things[-1]), verb="put")

    def some_of(self, children: Children) -> dict[str, Any]:
        """*Two of the three*: any two."""
        first = next(token for token in tokens_of(children) if token.type in ("NUMBER", "ONE"))
        if first.type == "ONE":
            return {"quantity": Quantity.A, "count": 1}
        return {"quantity": Quantity.SOME, "count": int(first)}

    def np_colored(self, children: Children) -> NounPhrase:
        """*A box red*, as learners say."""
        colors = [child for child in children if isinstance(child, LarkToken) and child.type == "COLOR"]
        phrase = self.np([child for child in children if not isinstance(child, LarkToken)])
        return replace(phrase, colors=(*phrase.colors, *map(str, colors)))

    def use(self, children: Children) -> NounPhrase:
        """*Something to cut paper with*, *what I need for breakfast*: named by what it is for."""
        words = [str(child) for child in children if isinstance(child, LarkToken) and child.type == "ANY"]
        first = tokens_of(children)[0]
        quantity = Quantity.THE if first.type in ("THE", "WHAT", "WHATEVER") else Quantity.A
        whole = Restriction(relation="use", word=" ".join(words))
        colors = tuple(str(token) for token in tokens_of(children) if token.type in ("COLOR", "ORANGE"))
        count = 1 if quantity is Quantity.A else None
        return NounPhrase(words=("thing",), quantity=quantity, count=count, colors=colors, restrictions=(whole,))

    def recipient(self, children: Children) -> Reference:
        token = tokens_of(children)[-1]
        if token.type in ("ME", "HIM"):
            return Pronoun(word=token.type.lower())
        return NounPhrase(words=tuple(str(token).split()), quantity=Quantity.THE, person=True)

    def recipient_at(self, children: Children) -> NounPhrase:
        """*The lady at the reception*, *the old man*."""
        heads = ("PERSON", "NAME", "NOUN", "WORD")
        words = tuple(str(token) for token in tokens_of(children) if token.type in heads)
        phrase = NounPhrase(words=words, quantity=Quantity.THE, person=True)
        where = tuple(value for value in values_of(children) if isinstance(value, Restriction))
        return replace(phrase, restrictions=where)

    def recipient_who(self, children: Children) -> NounPhrase:
        """*Whoever is in the kitchen*."""
        where = tuple(value for value in values_of(children) if isinstance(value, Restriction))
        return NounPhrase(words=("person",), quantity=Quantity.THE, person=True, restrictions=where)

    def everything_like(self, children: Children) -> NounPhrase:
        """*Everything edible on the counter*."""
        word = next(str(token) for token in tokens_of(children) if token.type in ("TOLD", "QUALITY"))
        phrase = self.everything([child for child in children if not isinstance(child, LarkToken)])
        told = Restriction(relation="use", word=word)
        return replace(phrase, restrictions=(*phrase.restrictions, told))

    def wants(self, children: Children) -> Carry:
        person, things = values_of(children)
        return Carry(things=things, destination=Destination(relation="to", reference=person), verb="bring")

    def wants_there(self, children: Children) -> Carry:
        """*Tom needs a spoon in the lab*: where he is."""
        things, place = values_of(children)
        where = Restriction(relation="in", reference=place)
        name = tuple(str(tokens_of(children)[0]).split())
        person = NounPhrase(words=name, quantity=Quantity.THE, person=True, restrictions=(where,))
        return Carry(things=things, destination=Destination(relation="to", reference=person), verb="bring")

    def restricted_between(self, children: Children) -> Restriction:
        one, other = values_of(children)[-1]
        return Restriction(relation="between", reference=one, other=other)

    def goes_to(self, children: Children) -> Carry:
        things, person = values_of(children)
        return Carry(things=things, destination=Destination(relation="to", reference=person), verb="bring")

    def goes(self, children: Children) -> Any:
        things, *where = values_of(children)
        if not isinstance(things, tuple):
            return super().goes(children)
        return super().goes([things, *where])

    def it_them(self, children: Children) -> Pronoun:
        """*Put the stuff on the bench*: what was spoken of."""
        del children
        return Pronoun(word="them")

    def corrected(self, children: Children) -> Reference | None:
        """*The milk, no wait, the juice*: the second; of *the red one* the noun of the first."""
        first, second = values_of(children)
        if not isinstance(second, NounPhrase) or not isinstance(first, NounPhrase):
            return None
        if second.words in (("one",), ("ones",)):
            return replace(second, words=first.words)
        return second

    def np_both(self, children: Children) -> NounPhrase:
        """*Her slippers, both of them.*"""
        phrase: NounPhrase = values_of(children)[0]
        return replace(phrase, quantity=Quantity.BOTH, count=2)

    def np_some_of(self, children: Children) -> NounPhrase:
        """*Two pens of the three on my desk*: any two."""
        number = next(int(token) for token in tokens_of(children) if token.type == "NUMBER")
        phrase = self.np([child for child in children if not isinstance(child, LarkToken)])
        return replace(phrase, quantity=Quantity.SOME, count=number)

    def each_his(self, children: Children) -> Several | None:
        """*The cup and the bottle to the desk and the bench respectively*: one each."""
        things, *places = values_of(children)
        if len(things) != len(places):
            return None
        first = places[0]
        whole = [
            place if isinstance(place, Destination) else replace(first, reference=place, other=None) for place in places
        ]
        pairs = zip(things, whole, strict=True)
        return Several(steps=tuple(Carry(things=(one,), destination=there, verb="put") for one, there in pairs))

    def carried(self, children: Children) -> Carry:
        """*Once you have taken the cup to Ben*."""
        things, *where = values_of(children)
        return Carry(things=things, destination=where[0] if where else None, verb="bring")

    def taken_up(self, children: Children) -> Pick:
        """*A red bell take*, as learners say."""
        return Pick(things=values_of(children)[0])

    def carry_from(self, children: Children) -> Carry | None:
        """*Out of the dishes, move two onto the trolley.*"""
        several, destination = values_of(children)
        count = next(int(token) for token in tokens_of(children) if token.type == "NUMBER")
        if not isinstance(several, NounPhrase):
            return None
        some = replace(several, quantity=Quantity.SOME, count=count)
        return Carry(things=(some,), destination=destination, verb="move")

    def carry_from_which(self, children: Children) -> Carry | None:
        """*From the three roses, bring the red ones to Ben.*"""
        several, ones, destination = values_of(children)
        if not isinstance(several, NounPhrase) or not isinstance(ones, NounPhrase):
            return None
        things = replace(ones, words=several.words, restrictions=(*several.restrictions, *ones.restrictions))
        return Carry(things=(things,), destination=destination, verb="move")

    def carry_with(self, children: Children) -> Carry:
        """*Into the sink with them.*"""
        destination, things = values_of(children)
        return Carry(things=things, destination=destination, verb="put")

    def performed_several(self, children: Children) -> Several:
        values = values_of(children)
        pairs = zip(values[::2], values[1::2], strict=True)
        return Several(steps=tuple(Carry(things=one, destination=other, verb="move") for one, other in pairs))

    def it_him(self, children: Children) -> Pronoun:
        """*Put her on the bench*, as learners say of a thing."""
        del children
        return Pronoun(word="it")

    def restricted_with_all(self, children: Children) -> Restriction:
        """*The tray with the cookies on it*: and they come along."""
        things = values_of(children)[0]
        other = things[1] if len(things) > 1 else None
        return Restriction(relation="with", reference=things[0], other=other)

    def restricted_with_its(self, children: Children) -> Restriction:
        words = tuple(str(token) for token in tokens_of(children) if token.type in ("NOUN", "WORD"))
        return Restriction(relation="with", reference=NounPhrase(words=words, quantity=Quantity.ALL))


def _head(reference: Reference) -> str:
    return reference.head if isinstance(reference, NounPhrase) else ""


def at_place(thing: Reference, place: Reference) -> Reference:
    """A thing as one that is at a place."""
    if not isinstance(thing, NounPhrase):
        return thing
    where = Restriction(relation="from", reference=place)
    return replace(thing, restrictions=(*thing.restrictions, where))


def _all(thing: Reference) -> Reference:
    """*Free of cups*: of every one."""
    bare = isinstance(thing, NounPhrase) and thing.quantity is Quantity.BARE
    return replace(thing, quantity=Quantity.ALL) if bare and isinstance(thing, NounPhrase) else thing
