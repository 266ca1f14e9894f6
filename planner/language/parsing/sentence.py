"""What stands in a sentence: steps, conditions, orders that are forbidden, what is only told; as the grammar has it."""

from __future__ import annotations

from typing import Any

from lark import Token as LarkToken

from planner.language.grammar.children import Children, tokens_of, values_of
from planner.language.grammar.syntax import (
    Ask,
    Carry,
    Destination,
    Mention,
    Reference,
    Restriction,
)
from planner.language.parsing.deeds import DeedReader, at_place
from planner.language.parsing.parts import Branching, Elliptic, First, Unable
from planner.plan import QueryKind


class SentenceReader(DeedReader):
    """One method a rule of ``request.lark`` that is about whole sentences."""

    def sentence(self, children: Children) -> tuple[Any, ...]:
        """The parts in order."""
        flat: list[Any] = []
        for value in values_of(children):
            flat += value if isinstance(value, tuple) else [value]
        return tuple(flat)

    branch = sentence

    def refrain(self, children: Children) -> Any:
        return values_of(children)[0]

    def refrain_things(self, children: Children) -> Carry:
        """*Not the red one*: whatever is done, not with these."""
        return Carry(things=values_of(children)[0], destination=None)

    def refrain_unclear(self, children: Children) -> Any:
        del children
        return "unclear"

    def elliptic(self, children: Children) -> Elliptic:
        things: tuple[Reference, ...] = ()
        destination = None
        for value in values_of(children):
            if isinstance(value, Destination):
                destination = value
            elif isinstance(value, tuple):
                things = value
            else:
                destination = Destination(relation="to", reference=value)
        return Elliptic(things=things, destination=destination)

    def fork_if(self, children: Children) -> Branching:
        condition, then, *otherwise = values_of(children)
        return Branching(condition=condition, negated=False, then=then, otherwise=otherwise[0] if otherwise else ())

    def fork_unless(self, children: Children) -> Branching:
        condition, then = values_of(children)
        return Branching(condition=condition, negated=True, then=then)

    def fork_late(self, children: Children) -> Branching:
        then, condition, *otherwise = values_of(children)
        return Branching(condition=condition, negated=False, then=then, otherwise=otherwise[0] if otherwise else ())

    def fork_late_unless(self, children: Children) -> Branching:
        then, condition = values_of(children)
        return Branching(condition=condition, negated=True, then=then)

    def fork_else(self, children: Children) -> Branching:
        then, otherwise = values_of(children)
        return Branching(condition=None, negated=False, then=then, otherwise=otherwise)

    def so(self, children: Children) -> Branching:
        then, *otherwise = values_of(children)
        return Branching(
            condition=None, negated=False, then=then, otherwise=otherwise[0] if otherwise else (), before=True
        )

    def not_so(self, children: Children) -> Branching:
        return Branching(condition=None, negated=True, then=values_of(children)[0], before=True)

    def first(self, children: Children) -> First:
        return First(then=values_of(children)[0])

    def ordered_late(self, children: Children) -> tuple[Any, ...]:
        """*Before you do this, do that*: the second comes first."""
        one, other = (value if isinstance(value, tuple) else (value,) for value in values_of(children))
        return (*other, *one)

    def ordered_soon(self, children: Children) -> tuple[Any, ...]:
        one, other = (value if isinstance(value, tuple) else (value,) for value in values_of(children))
        return (*one, *other)

    def unable(self, children: Children) -> Unable:
        return Unable(verb=str(tokens_of(children)[0]))

    def unable_distance(self, children: Children) -> Unable:
        """*Move forward 0.2 m*, *turn left 90 degrees*."""
        del children
        return Unable(verb="move or turn by a distance or an angle")

    def aside(self, children: Children) -> str:
        return " ".join(str(child) for child in children if isinstance(child, LarkToken))

    def narrated_person(self, children: Children) -> Mention:
        """*The man in the kitchen is cold*: what follows is about him."""
        return Mention(thing=values_of(children)[0])

    def narrated_need(self, children: Children) -> Mention:
        """*Zoe wants to fly the kite*: what follows is about her and it."""
        person, things = values_of(children)
        return Mention(thing=things[0], more=things[1:], who=person)

    def narrated_place(self, children: Children) -> Mention:
        """*In the bathroom is a toothbrush.*"""
        place, thing = values_of(children)
        return Mention(thing=at_place(thing, place))

    def unknowable(self, children: Children) -> Ask:
        said = next(str(token) for token in tokens_of(children) if token.type == "QUALITY")
        things = tuple(value for value in values_of(children) if not isinstance(value, Restriction))
        return Ask(kind=QueryKind.UNKNOWABLE, things=things[:1], word=f"is {said}")

    def unknowable_other(self, children: Children) -> Ask:
        """*Does the laptop work again*: no question that the graph can answer."""
        said = " ".join(str(token) for token in tokens_of(children) if token.type in ("DO", "BE", "HAVE", "TOLD"))
        return Ask(kind=QueryKind.UNKNOWABLE, things=tuple(values_of(children)), word=said)

    unknowable_told = unknowable_other
