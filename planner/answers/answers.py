"""Answers to questions, read from the graph, with the age of what is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner.answers.comparison import COMPARING, Comparison
from planner.answers.inventory import Inventory
from planner.answers.reports import ABILITIES, REPORTED, Report, Reports
from planner.answers.settings import AnswerSettings
from planner.answers.subjects import Subjects, speaks_of_all
from planner.answers.whereabouts import Whereabouts
from planner.grounding.context import Context, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.matching import nodes_of
from planner.grounding.openness import about_loss, about_openness, is_open, not_known, undecided
from planner.grounding.phrasing import describe, phrase_text, place_phrase
from planner.language.grammar.syntax import Ask, NounPhrase, Pronoun, Quantity
from planner.language.lexicon.vocabulary import singular
from planner.naming import at, capital, listed, name_of
from planner.plan import Query, QueryKind
from scene_graph.nodes import DoorNode, ObjectNode, PersonNode, RoomNode


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What is said, and the question as the graph understood it.

    ``holds``: the truth of what was asked, if it has one.
    """

    text: str
    query: Query
    holds: bool | None = None


class Answers:
    """Answers ``Ask`` steps on one graph."""

    def __init__(self, grounding: Grounding, settings: AnswerSettings = AnswerSettings()) -> None:
        self._grounding, self._settings = grounding, settings
        self._snapshot, self._state = grounding.snapshot, grounding.state
        self._subjects, self._inventory = Subjects(grounding), Inventory(grounding.snapshot, grounding.state, settings)
        self._reports, self._comparison = Reports(grounding, settings), Comparison(grounding)
        self._told = Whereabouts(grounding.snapshot, grounding.state, settings)

    def of(self, ask: Ask, context: Context) -> Answer | Trouble:
        """The answer, or why the question cannot be put to the graph."""
        nodes: tuple[str, ...] = ()
        if about_openness(ask) and isinstance(ask.things[0], Pronoun) and context.places:
            context = replace(context, fresh=context.places[:1])  # *go to the den if it is open*
        if ask.kind in REPORTED | COMPARING:
            return self._reported(ask, context)
        match ask.kind:
            case QueryKind.ROBOT_ROOM:
                text = self._inventory.robot_room()
            case QueryKind.ABILITIES:
                text = ABILITIES
            case QueryKind.ROOMS:
                text, nodes = self._inventory.rooms()
            case QueryKind.UNKNOWABLE:
                text = _unknowable(ask)
            case QueryKind.SEEN:
                text, nodes = self._inventory.seen()
            case QueryKind.HOLDING:
                text, nodes = self._inventory.holding()
            case _:
                found = self._subjects.found(ask, context)
                if not isinstance(found, tuple):
                    return found
                nodes = found
                text = self._about(ask, found, context)
        query = Query(kind=ask.kind, nodes=nodes, phrase=_phrase(ask))
        holds = None if ask.kind is QueryKind.UNKNOWABLE else self._subjects.holds(ask, nodes, context)
        return Answer(text=text, query=query, holds=holds)

    def _reported(self, ask: Ask, context: Context) -> Answer | Trouble:
        told = (self._comparison if ask.kind in COMPARING else self._reports).of(ask, context)
        if not isinstance(told, Report):
            return told
        holds = told.text.startswith("Yes") if ask.kind is QueryKind.CAPABLE else None
        return Answer(text=told.text, query=Query(kind=ask.kind, nodes=told.nodes, phrase=_phrase(ask)), holds=holds)

    def _about(self, ask: Ask, found: tuple[str, ...], context: Context) -> str:
        present = [i for i in found if i not in self._state.missing or about_loss(ask)]
        match ask.kind:
            case QueryKind.COUNT:
                return _also(self._count(ask, present, found), self._not_known(ask, context))
            case QueryKind.LIST:
                unknown = self._not_known(ask, context)
                return unknown if unknown and not present else _also(self._list(ask, present, context), unknown)
            case QueryKind.EXISTS:
                return self._exists(ask, found, context)
            case QueryKind.COLOR:
                return self._colors(found) or self._none(ask, context)
            case QueryKind.ROOM_OF:
                return self._where(found, rooms_only=True) or self._none(ask, context)
            case _:
                return self._where(found, rooms_only=False) or self._none(ask, context)

    def _not_known(self, ask: Ask, context: Context) -> str:
        return not_known(self._subjects.undecided(ask, context), self._snapshot)

    def _none(self, ask: Ask, context: Context) -> str:
        reference = ask.things[0] if ask.things else None
        if isinstance(reference, NounPhrase):
            return self._grounding.nothing(reference, context).reason
        return "I do not know."

    def _where(self, found: Sequence[str], *, rooms_only: bool) -> str:
        you = self._grounding.speaker(Context())
        speaker = you[0] if isinstance(you, tuple) else None
        told = [
            self._told.sentence(i, rooms_only=rooms_only, speaker=speaker) for i in found[: self._settings.most_named]
        ]
        if len(found) > self._settings.most_named:
            told.append(f"I know of {len(found) - self._settings.most_named} more.")
        return " ".join(told)

    def _count(self, ask: Ask, present: Sequence[str], found: Sequence[str]) -> str:
        number = len(present)
        text = _counted(ask, number)
        lost = len(found) - number
        many = ("is", "it") if lost == 1 else ("are", "them")
        also = f", and {lost} more that {many[0]} not where I last saw {many[1]}"
        names = (
            f": {listed([describe(i, self._snapshot) for i in present[: self._settings.most_named]])}"
            if 0 < number <= 3
            else ""
        )
        return f"I know of {number or 'no'} {text}{also if lost else ''}{names}."

    def _list(self, ask: Ask, present: Sequence[str], context: Context) -> str:
        shown = [i for i in present if i not in self._subjects.targets(ask, context)]
        if not shown:
            return self._nothing(ask, context)
        targets = self._subjects.targets(ask, context)
        if len(targets) > 1 and not ask.things:
            return self._by_place(shown, targets)
        if ask.things:
            return f"{capital(listed([describe(i, self._snapshot) for i in shown[: 2 * self._settings.most_named]]))}."
        return f"I have seen {self._inventory.of(shown)} there."

    def _nothing(self, ask: Ask, context: Context) -> str:
        """Nobody is there: who is elsewhere; of a thing that was to be described, where it is."""
        if self._asks_who(ask):
            return self._people()
        if ask.things:
            return f"I know of no {_phrase(ask)} there."
        things = self._state.world.things
        carried = [i for i in self._subjects.targets(ask, context) if i in things and things[i].graspable]
        if carried and ask.place is not None and ask.place.relation == "at":
            return self._where(carried, rooms_only=False)
        return "I know of nothing there."

    def _asks_who(self, ask: Ask) -> bool:
        return bool(ask.things) and isinstance(ask.things[0], NounPhrase) and ask.things[0].person

    def _people(self) -> str:
        """Nobody is there: who is elsewhere."""
        people = [node.id for node in nodes_of(self._snapshot) if isinstance(node, PersonNode)]
        return f"Nobody that I know of. {self._where(people, rooms_only=False)}".strip()

    def _by_place(self, shown: Sequence[str], targets: tuple[str, ...]) -> str:
        sentences = []
        for target in targets:
            here = [i for i in shown if self._grounding.places.is_at(i, target)]
            sentences.append(
                f"{capital(at(target, self._snapshot))}: {self._inventory.of(here) if here else 'nothing'}."
            )
        return " ".join(sentences)

    def _exists(self, ask: Ask, found: Sequence[str], context: Context) -> str:
        place = ask.place
        if place is not None and place.relation in ("state", "color"):
            return self._is_so(ask, found, context)
        if not ask.things:
            shown = [i for i in found if i not in self._subjects.targets(ask, context)]
            return f"No. I have seen {self._inventory.of(shown)} there." if shown else "Yes: I know of nothing there."
        if ask.negated or ask.least is not None or ask.most is not None:
            so = "Yes" if self._subjects.holds(ask, found, context) else "No"
            return f"{so}. {self._where(found, rooms_only=False) or self._none(ask, context)}"
        if found and all(i in self._state.missing for i in found):
            return f"No. {self._where(found, rooms_only=False)}"
        if found and not self._subjects.holds(ask, found, context):
            return self._too_few(ask, found, context)
        if found:
            return f"Yes. {self._where(found, rooms_only=False)}"
        if ask.place is None:
            return f"No. {self._none(ask, context)}"
        elsewhere = self._subjects.candidates(ask.things[0], context) if ask.things else ()
        rest = self._where(elsewhere, rooms_only=False) if isinstance(elsewhere, tuple) else ""
        return f"Not that I know of. {rest}".strip() if rest else f"No. {self._none(ask, context)}"

    def _too_few(self, ask: Ask, found: Sequence[str], context: Context) -> str:
        """*No*, with those that are elsewhere, of all; else with those there are."""
        every = self._subjects.candidates(ask.things[0], context)
        if not speaks_of_all(ask.things[0]) or not isinstance(every, tuple):
            return f"No, I know of only {len(found)}. {self._where(found, rooms_only=False)}"
        return f"No. {self._where([i for i in every if i not in found], rooms_only=False)}"

    def _is_so(self, ask: Ask, found: Sequence[str], context: Context) -> str:
        """*The door is open*: the answer with what is so instead."""
        some = isinstance(ask.things[0], NounPhrase) and ask.things[0].quantity is Quantity.A
        about = tuple(found) if some and found else self._subjects.candidates(ask.things[0], context)
        told = (
            " ".join(self._state_of(i) for i in about[: self._settings.most_named]) if isinstance(about, tuple) else ""
        )
        if not told:
            return self._none(ask, context)
        holds = self._subjects.holds(ask, found, context)
        return told if holds is None else f"{'Yes' if holds else 'No'}. {told}"

    def _state_of(self, node_id: str) -> str:
        node = self._snapshot.node(node_id)
        if isinstance(node, ObjectNode):
            return self._color(node)
        name = capital(name_of(node_id, self._snapshot))
        if not isinstance(node, RoomNode | DoorNode):
            return f"{name}: I cannot tell."
        open_now = is_open(node_id, self._snapshot)
        return (
            not_known(undecided((node_id,), self._snapshot), self._snapshot)
            or f"{name} is {'open' if open_now else 'closed'}."
        )

    def _colors(self, found: Sequence[str]) -> str:
        objects = [node for i in found if isinstance(node := self._snapshot.node(i), ObjectNode)]
        return " ".join(self._color(node) for node in objects[: self._settings.most_named])

    def _color(self, node: ObjectNode) -> str:
        thing = f"The {node.name or node.label.replace('_', ' ')} {place_phrase(node.id, self._snapshot)}"
        if not node.color:
            return f"{thing}: I could not tell its color."
        return f"{thing} is {node.color}{f', and partly {listed(list(node.accents))}' if node.accents else ''}."


def _unknowable(ask: Ask) -> str:
    named = [phrase_text(thing) for thing in ask.things if isinstance(thing, NounPhrase)]
    what = f"the {named[0]}" if named else "it"
    return f"I cannot tell whether {what} {ask.word}: of things I know what they are, their color, size and place."


def _also(told: str, more: str) -> str:
    return f"{told} {more}".strip()


def _phrase(ask: Ask) -> str:
    reference = ask.things[0] if ask.things else None
    return phrase_text(reference) if isinstance(reference, NounPhrase) else "things"


def _counted(ask: Ask, number: int) -> str:
    """*1 red cup*, *2 red cups*: the noun phrase in the number that was counted."""
    reference = ask.things[0]
    if not isinstance(reference, NounPhrase) or number != 1:
        return _phrase(ask)
    return phrase_text(replace(reference, words=tuple(singular(reference.head).split(" "))))
