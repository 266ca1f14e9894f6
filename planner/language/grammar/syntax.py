"""What a step of a request says, before anything is looked up: references in words, and what is wanted of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

from planner.plan import QueryKind


class Quantity(StrEnum):
    """How many things a noun phrase speaks of."""

    BARE = "bare"
    THE = "the"
    A = "a"
    THIS = "this"
    ALL = "all"
    BOTH = "both"
    SOME = "some"
    EXACTLY = "exactly"


@dataclass(frozen=True, kw_only=True)
class Restriction:
    """Narrows a noun phrase. ``relation``: on, in, near, from, at, nearest, held, here, there, with, color, state, or
    as typed. ``other``: the second reference of *between*. ``word``: the color or state. ``negated``: *not on*.
    """

    relation: str
    reference: Reference | None = None
    other: Reference | None = None
    word: str = ""
    negated: bool = False


@dataclass(frozen=True, kw_only=True)
class NounPhrase:
    """*the two big red cups on the table*: head words, quantity with its number, modifiers, restrictions.

    ``rank``: of a superlative, 2 for *second largest*; alone, *the second cup*. ``other``: *the other cup*, not one
    spoken of. ``either``: one of the colors is enough, *the red and green cups*. ``exceptions``: what is left out.
    ``share``: *half*, or *all but 1*.
    """

    words: tuple[str, ...]
    quantity: Quantity = Quantity.BARE
    count: int | None = None
    colors: tuple[str, ...] = ()
    sizes: tuple[str, ...] = ()
    superlative: str | None = None
    restrictions: tuple[Restriction, ...] = ()
    number: int | None = None
    person: bool = False
    rank: int | None = None
    other: bool = False
    either: bool = False
    exceptions: tuple[Reference, ...] = ()
    share: str = ""

    @property
    def head(self) -> str:
        """The head as one string: ``remote control``."""
        return " ".join(self.words)


@dataclass(frozen=True, kw_only=True)
class Pronoun:
    """*it*, *me*, *him*, *here*, *there*, *you*: a reference to what was said or to who is speaking."""

    word: str


@dataclass(frozen=True, kw_only=True)
class Spot:
    """*where the apple is*, *where it was*: a place named by what is there, or was before it was moved."""

    thing: Reference
    past: bool = False


Reference = NounPhrase | Pronoun | Spot


@dataclass(frozen=True, kw_only=True)
class Destination:
    """Where something goes. ``relation``: to, on, in, near, or as typed. ``other``: the second one of *between*.

    ``back``: it was there before, as in *put it back on the shelf*.
    """

    relation: str
    reference: Reference
    other: Reference | None = None
    back: bool = False


@dataclass(frozen=True, kw_only=True)
class Carry:
    """Bring things somewhere; ``destination`` is None when not said, ``implied`` when it is the speaker by default."""

    things: tuple[Reference, ...]
    destination: Destination | None
    implied: bool = False
    verb: str = "put"


@dataclass(frozen=True, kw_only=True)
class Several:
    """*Put the cup on the table and the book on the desk*: one verb, several things with a destination each."""

    steps: tuple[Carry | Go, ...]
    verbless: bool = False


@dataclass(frozen=True, kw_only=True)
class Perhaps:
    """What a statement may be asking for: *the apple belongs on the desk*. It is asked about before it is done.

    ``verbless``: *the apple on the desk*, which is asked about only if it may describe an apple that is there;
    ``sure``: *the apple to the desk*, which describes nothing.
    """

    step: Carry
    verbless: bool = False
    sure: bool = False


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """*The bathroom, please*: a thing to be brought, or a place to go to."""

    thing: Reference


@dataclass(frozen=True, kw_only=True)
class Teach:
    """*This room is the office*: what ``target`` is called from now on. ``target`` None: whatever is pointed at.

    ``called``: it was said to be a name, as in *call it Bruno*; *that is the wrong cup* gives none.
    """

    words: tuple[str, ...]
    target: Reference | None = None
    mine: bool = False
    named: bool = False
    called: bool = False


@dataclass(frozen=True, kw_only=True)
class PutDown:
    """Put what is held down, nearby."""

    things: tuple[Reference, ...]


@dataclass(frozen=True, kw_only=True)
class Swap:
    """Two things, or what two phrases name, each to where the other is."""

    things: tuple[Reference, ...]


@dataclass(frozen=True, kw_only=True)
class Operate:
    """*Open the door*, when an installed package has a skill for it; ``verb`` as it was typed."""

    verb: str
    thing: Reference


@dataclass(frozen=True, kw_only=True)
class PutBack:
    """Put things back where they were."""

    things: tuple[Reference, ...]


@dataclass(frozen=True, kw_only=True)
class Go:
    """Drive to a room, a thing or a person, and wait if it ``stays``; ``target`` None: where the step before led."""

    target: Reference | None
    stays: bool = False


@dataclass(frozen=True, kw_only=True)
class Find:
    """Find things, perhaps within ``place``."""

    things: tuple[Reference, ...]
    place: Reference | None = None


@dataclass(frozen=True, kw_only=True)
class Pick:
    """Take things into the gripper."""

    things: tuple[Reference, ...]


@dataclass(frozen=True, kw_only=True)
class Ask:
    """A question about ``things``, limited to ``place``.

    ``negated``: *is the cup not on the table*. ``least``, ``most``: *are there at least two cups*. ``word``: what is
    compared, *bigger*, or *most* or *fewest*.
    """

    kind: QueryKind
    things: tuple[Reference, ...] = ()
    place: Restriction | None = None
    negated: bool = False
    least: int | None = None
    most: int | None = None
    word: str = ""


@dataclass(frozen=True, kw_only=True)
class Mention:
    """*There is a mug on the desk*: what the next step is about. ``lost``: *my phone is gone*. ``who``: who lost it.

    ``more``: other things beside it.
    """

    thing: Reference
    more: tuple[Reference, ...] = ()
    who: Reference | None = None
    lost: bool = False


LEANING = frozenset({"it", "them", "both", "all", "that", "him"})
"""Pronouns that stand for what was spoken of."""


def along(step: Step, before: Step) -> Step:
    """``step``, which says neither verb nor place, as it is meant after ``before``: its things go to the same place."""
    if not isinstance(step, Pick | Carry) or not isinstance(before, Carry):
        return step
    if before.implied or before.destination is None:
        return step
    return replace(before, things=step.things)


def leans(value: object) -> bool:
    """Whether a reading has a pronoun, or *one*, that needs something spoken of before."""
    if isinstance(value, Pronoun):
        return value.word in LEANING
    if isinstance(value, NounPhrase) and value.words in (("one",), ("ones",)):
        return True
    parts = value if isinstance(value, tuple) else tuple(vars(value).values()) if hasattr(value, "__dict__") else ()
    return any(leans(part) for part in parts if not isinstance(part, str))


def is_wish(step: Step) -> bool:
    """*I want the book in the chapel*, as one that is there: it is meant so if there is one."""
    wished = isinstance(step, Carry) and step.implied and step.verb.startswith(("i ", "we "))
    told = [thing for thing in getattr(step, "things", ()) if isinstance(thing, NounPhrase)]
    return wished and any(x.relation in ("on", "in", "at", "near") for thing in told for x in thing.restrictions)


Step = (
    Carry | Several | Swap | Perhaps | Wanted | Mention | Operate | PutDown | PutBack | Go | Find | Pick | Teach | Ask
)
