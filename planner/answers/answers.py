"""Answers to questions, read from the graph, with the age of what is known."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner.answers.comparing import COMPARING, Comparing
from planner.answers.reports import ABILITIES, REPORTED, Report, Reports
from planner.grounding.grounding import Ambiguous, Context, Grounding, NoReferent
from planner.grounding.matching import nodes_of
from planner.grounding.naming import at, listed, name_of, plain_name
from planner.grounding.narrowing import Narrowing
from planner.grounding.openness import about_loss, about_openness, is_open, not_known, undecided, without_openness
from planner.grounding.phrasing import article, describe, described, phrase_text, place_phrase, told_apart
from planner.grounding.whereabouts import NOW_S, Whereabouts, capital
from planner.language.grammar.syntax import Ask, NounPhrase, Pronoun, Quantity, Reference, Restriction
from planner.language.lexicon.vocabulary import is_plural, singular
from planner.plan import Query, QueryKind
from scene_graph.nodes import DoorNode, ObjectNode, ObjectState, PersonNode, RoomNode

MAX_NAMED = 6


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

    def __init__(self, grounding: Grounding) -> None:
        self._grounding = grounding
        self._snapshot, self._state = grounding.snapshot, grounding.state
        self._narrowing = Narrowing(grounding.snapshot, grounding.state, grounding)
        self._reports, self._comparing = Reports(grounding), Comparing(grounding)
        self._told = Whereabouts(grounding.snapshot, grounding.state)

    def of(self, ask: Ask, context: Context) -> Answer | NoReferent | Ambiguous:
        """The answer, or why the question cannot be put to the graph."""
        nodes: tuple[str, ...] = ()
        if about_openness(ask) and isinstance(ask.things[0], Pronoun) and context.places:
            context = replace(context, fresh=context.places[:1])  # *go to the den if it is open*
        if ask.kind in REPORTED | COMPARING:
            return self._reported(ask, context)
        match ask.kind:
            case QueryKind.ROBOT_ROOM:
                text = self._robot_room()
            case QueryKind.ABILITIES:
                text = ABILITIES
            case QueryKind.ROOMS:
                text, nodes = self._rooms()
            case QueryKind.SEEN:
                text, nodes = self._seen()
            case QueryKind.HOLDING:
                text, nodes = self._holding()
            case _:
                found = self._found(ask, context)
                if not isinstance(found, tuple):
                    return found
                nodes = found
                text = self._about(ask, found, context)
        query = Query(kind=ask.kind, nodes=nodes, phrase=_phrase(ask))
        return Answer(text=text, query=query, holds=self._holds(ask, nodes, context))

    def _reported(self, ask: Ask, context: Context) -> Answer | NoReferent | Ambiguous:
        told = (self._comparing if ask.kind in COMPARING else self._reports).of(ask, context)
        if not isinstance(told, Report):
            return told
        holds = told.text.startswith("Yes") if ask.kind is QueryKind.CAPABLE else None
        return Answer(text=told.text, query=Query(kind=ask.kind, nodes=told.nodes, phrase=_phrase(ask)), holds=holds)

    def _holds(self, ask: Ask, found: Sequence[str], context: Context) -> bool | None:
        """Whether it is so; None if that depends on doors that nobody has seen lately."""
        if ask.kind not in (QueryKind.EXISTS, QueryKind.HOLDING):
            return None
        number = len([i for i in found if i not in self._state.missing])
        at_most = number + len(self._undecided(ask, context))
        so = {self._is_enough(ask, count, context) for count in (number, at_most)}
        return None if len(so) > 1 else so.pop() != ask.negated

    def _is_enough(self, ask: Ask, number: int, context: Context) -> bool:
        """Whether ``number`` things are as many as the question speaks of."""
        enough = (1 if ask.most is None else 0) if ask.least is None else ask.least
        wanted = ask.things[0] if ask.things else None
        if isinstance(wanted, NounPhrase) and wanted.quantity is Quantity.SOME:
            enough = wanted.count or enough
        if ask.place is not None and _speaks_of_all(wanted):
            every = self._candidates(wanted, context)
            enough = len(every) if isinstance(every, tuple) else enough
        return number >= enough and (ask.most is None or number <= ask.most)

    def _undecided(self, ask: Ask, context: Context) -> tuple[str, ...]:
        """The doors and rooms that a question about openness cannot tell."""
        if not about_openness(ask):
            return ()
        wanted = ask.things[0] if ask.things else None
        every = self._candidates(without_openness(wanted) if isinstance(wanted, NounPhrase) else wanted, context)
        return undecided(every, self._snapshot) if isinstance(every, tuple) else ()

    def _found(self, ask: Ask, context: Context) -> tuple[str, ...] | NoReferent | Ambiguous:
        """Everything the question is about, present or missing."""
        found: dict[str, None] = {}
        for reference in ask.things or (None,):
            here = self._candidates(reference, context)
            if not isinstance(here, tuple):
                return here
            if ask.place is not None:
                lost = self._unknown_place(ask.place, context)
                if lost is not None:
                    return lost
                here = tuple(self._narrowing.restricted(here, ask.place, context))
            found.update(dict.fromkeys(here))
        return tuple(found)

    def _candidates(self, reference: Reference | None, context: Context) -> tuple[str, ...] | NoReferent | Ambiguous:
        if isinstance(reference, NounPhrase) and reference.words == ("anything",):
            reference = None
        if reference is None:
            return tuple(node.id for node in nodes_of(self._snapshot) if isinstance(node, ObjectNode | PersonNode))
        if isinstance(reference, NounPhrase):
            return self._grounding.matches(reference, context, fixed=True)
        return self._grounding.things(reference, context)

    def _unknown_place(self, place: Restriction, context: Context) -> NoReferent | None:
        if isinstance(place.reference, NounPhrase) and self._narrowing.is_everywhere(place.reference):
            return None
        if place.reference is None or self._narrowing.targets(place, context):
            return None
        if isinstance(place.reference, NounPhrase):
            return self._grounding.nothing(place.reference, context)
        return NoReferent(reason="I do not know which place you mean.")

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
        return not_known(self._undecided(ask, context), self._snapshot)

    def _none(self, ask: Ask, context: Context) -> str:
        reference = ask.things[0] if ask.things else None
        if isinstance(reference, NounPhrase):
            return self._grounding.nothing(reference, context).reason
        return "I do not know."

    def _where(self, found: Sequence[str], *, rooms_only: bool) -> str:
        you = self._grounding.speaker(Context())
        speaker = you[0] if isinstance(you, tuple) else None
        told = [self._told.sentence(i, rooms_only=rooms_only, speaker=speaker) for i in found[:MAX_NAMED]]
        if len(found) > MAX_NAMED:
            told.append(f"I know of {len(found) - MAX_NAMED} more.")
        return " ".join(told)

    def _count(self, ask: Ask, present: Sequence[str], found: Sequence[str]) -> str:
        number = len(present)
        text = _counted(ask, number)
        lost = len(found) - number
        many = ("is", "it") if lost == 1 else ("are", "them")
        also = f", and {lost} more that {many[0]} not where I last saw {many[1]}"
        names = f": {listed([describe(i, self._snapshot) for i in present[:MAX_NAMED]])}" if 0 < number <= 3 else ""
        return f"I know of {number or 'no'} {text}{also if lost else ''}{names}."

    def _list(self, ask: Ask, present: Sequence[str], context: Context) -> str:
        shown = [i for i in present if i not in self._targets(ask, context)]
        if not shown:
            return self._nothing(ask, context)
        targets = self._targets(ask, context)
        if len(targets) > 1 and not ask.things:
            return self._by_place(shown, targets)
        if ask.things:
            return f"{capital(listed([describe(i, self._snapshot) for i in shown[: 2 * MAX_NAMED]]))}."
        return f"I have seen {self._inventory(shown)} there."

    def _nothing(self, ask: Ask, context: Context) -> str:
        """Nobody is there: who is elsewhere; of a thing that was to be described, where it is."""
        if self._asks_who(ask):
            return self._people()
        if ask.things:
            return f"I know of no {_phrase(ask)} there."
        things = self._state.world.things
        carried = [i for i in self._targets(ask, context) if i in things and things[i].graspable]
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
            here = [i for i in shown if self._narrowing.is_at(i, target)]
            sentences.append(f"{capital(at(target, self._snapshot))}: {self._inventory(here) if here else 'nothing'}.")
        return " ".join(sentences)

    def _targets(self, ask: Ask, context: Context) -> tuple[str, ...]:
        return self._narrowing.targets(ask.place, context) if ask.place is not None else ()

    def _inventory(self, nodes: Sequence[str]) -> str:
        names = Counter(self._plain(i) for i in nodes)
        return listed([article(name) if count == 1 else f"{count} × {name}" for name, count in names.items()])

    def _plain(self, node_id: str) -> str:
        node = self._snapshot.node(node_id)
        if isinstance(node, ObjectNode):
            return plain_name(node)
        return described(node_id, self._snapshot)

    def _exists(self, ask: Ask, found: Sequence[str], context: Context) -> str:
        place = ask.place
        if place is not None and place.relation in ("state", "color"):
            return self._is_so(ask, found, context)
        if not ask.things:
            shown = [i for i in found if i not in self._targets(ask, context)]
            return f"No. I have seen {self._inventory(shown)} there." if shown else "Yes: I know of nothing there."
        if ask.negated or ask.least is not None or ask.most is not None:
            so = "Yes" if self._holds(ask, found, context) else "No"
            return f"{so}. {self._where(found, rooms_only=False) or self._none(ask, context)}"
        if found and all(i in self._state.missing for i in found):
            return f"No. {self._where(found, rooms_only=False)}"
        if found and not self._holds(ask, found, context):
            return self._too_few(ask, found, context)
        if found:
            return f"Yes. {self._where(found, rooms_only=False)}"
        if ask.place is None:
            return f"No. {self._none(ask, context)}"
        elsewhere = self._candidates(ask.things[0], context) if ask.things else ()
        rest = self._where(elsewhere, rooms_only=False) if isinstance(elsewhere, tuple) else ""
        return f"Not that I know of. {rest}".strip() if rest else f"No. {self._none(ask, context)}"

    def _too_few(self, ask: Ask, found: Sequence[str], context: Context) -> str:
        """*No*, with those that are elsewhere, of all; else with those there are."""
        every = self._candidates(ask.things[0], context)
        if not _speaks_of_all(ask.things[0]) or not isinstance(every, tuple):
            return f"No, I know of only {len(found)}. {self._where(found, rooms_only=False)}"
        return f"No. {self._where([i for i in every if i not in found], rooms_only=False)}"

    def _is_so(self, ask: Ask, found: Sequence[str], context: Context) -> str:
        """*The door is open*: the answer with what is so instead."""
        some = isinstance(ask.things[0], NounPhrase) and ask.things[0].quantity is Quantity.A
        about = tuple(found) if some and found else self._candidates(ask.things[0], context)
        told = " ".join(self._state_of(i) for i in about[:MAX_NAMED]) if isinstance(about, tuple) else ""
        if not told:
            return self._none(ask, context)
        holds = self._holds(ask, found, context)
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
        return " ".join(self._color(node) for node in objects[:MAX_NAMED])

    def _color(self, node: ObjectNode) -> str:
        thing = f"The {node.name or node.label.replace('_', ' ')} {place_phrase(node.id, self._snapshot)}"
        if not node.color:
            return f"{thing}: I could not tell its color."
        return f"{thing} is {node.color}{f', and partly {listed(list(node.accents))}' if node.accents else ''}."

    def _robot_room(self) -> str:
        room = self._snapshot.current_room
        if room is None:
            return "I do not know yet which room I am in."
        if not self._snapshot.room(room).label:
            return f"I am in {room}; I have no name for it."
        return f"I am in {describe(room, self._snapshot)}."

    def _rooms(self) -> tuple[str, tuple[str, ...]]:
        rooms = tuple(node.id for node in nodes_of(self._snapshot) if isinstance(node, RoomNode))
        if not rooms:
            return "I do not know any room yet.", ()
        names = told_apart(rooms, self._snapshot)
        return f"I know {len(rooms)} room{'s' if len(rooms) > 1 else ''}: {listed(names)}.", rooms

    def _seen(self) -> tuple[str, tuple[str, ...]]:
        now = self._snapshot.stamp_s - NOW_S
        objects = [node for node in nodes_of(self._snapshot) if isinstance(node, ObjectNode)]
        fresh = tuple(node.id for node in objects if node.last_seen_s >= now and node.state is not ObjectState.MISSING)
        if fresh:
            return f"I see {self._inventory(fresh)}.", fresh
        number = f"{len(objects)} object{'s' if len(objects) != 1 else ''}"
        return f"I see no object right now. In all I know of {number}.", ()

    def _holding(self) -> tuple[str, tuple[str, ...]]:
        held = self._state.holding
        if held is None:
            return "I am holding nothing.", ()
        return f"I am holding {name_of(held, self._snapshot)}.", (held,)


def _also(told: str, more: str) -> str:
    return f"{told} {more}".strip()


def _speaks_of_all(reference: Reference | None) -> bool:
    """*All cups*, *both doors*, *the cups*."""
    if not isinstance(reference, NounPhrase):
        return False
    several = is_plural(reference.words[-1]) if reference.words else False
    return reference.quantity in (Quantity.ALL, Quantity.BOTH) or (reference.quantity is Quantity.THE and several)


def _phrase(ask: Ask) -> str:
    reference = ask.things[0] if ask.things else None
    return phrase_text(reference) if isinstance(reference, NounPhrase) else "things"


def _counted(ask: Ask, number: int) -> str:
    """*1 red cup*, *2 red cups*: the noun phrase in the number that was counted."""
    reference = ask.things[0]
    if not isinstance(reference, NounPhrase) or number != 1:
        return _phrase(ask)
    return phrase_text(replace(reference, words=tuple(singular(reference.head).split(" "))))
