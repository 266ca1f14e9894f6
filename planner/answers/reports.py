"""Answers that are computed rather than looked up: ways, distances, sizes, times, and what the robot did and why."""

from __future__ import annotations

from dataclasses import dataclass

from planner.answers.settings import AnswerSettings
from planner.answers.whereabouts import Whereabouts, age_phrase
from planner.grounding.context import Ambiguous, Context, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.phrasing import parts_unseen
from planner.language.grammar.syntax import Ask, Reference
from planner.naming import capital, listed, name_of
from planner.plan import Exchange, QueryKind
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode
from scene_graph.queries.topology import Topology

REPORTED = frozenset(
    {QueryKind.DISTANCE, QueryKind.SIZE, QueryKind.PATH, QueryKind.LAST_SEEN, QueryKind.DONE, QueryKind.FAILURE}
    | {QueryKind.DOING, QueryKind.BATTERY, QueryKind.NAME, QueryKind.CAPABLE}
    | {
        QueryKind.NATURE,
        QueryKind.WELL_BEING,
        QueryKind.SOURCE,
        QueryKind.DURATION,
        QueryKind.ASKED,
        QueryKind.DONE_WITH,
        QueryKind.EXPLORED,
    }
)
ABILITIES = (
    "I can go to places and people, find things, pick them up, put them somewhere, bring them, and answer questions."
)
MINUTE_S = 60.0
NOTHING_YET = "I have done nothing yet."
UNDER_WAY = ("running", "paused", "planning", "queued")
BEGUN = ("running", "paused", "succeeded", "failed", "cancelled")


@dataclass(frozen=True, kw_only=True)
class Report:
    """What is said, and the nodes it is about."""

    text: str
    nodes: tuple[str, ...] = ()


def one_place(grounding: Grounding, reference: Reference, context: Context) -> str | Trouble:
    """The one place, thing or person that a question is about."""
    found = grounding.place(reference, context)
    if not isinstance(found, tuple):
        return found
    if len(found) > 1:
        return Ambiguous(question="Which one of them do you mean?", phrase="", candidates=found)
    return found[0]


class Reports:
    """Answers the kinds of ``REPORTED`` on one graph."""

    def __init__(self, grounding: Grounding, settings: AnswerSettings) -> None:
        self._grounding, self._settings = grounding, settings
        self._snapshot, self._state = grounding.snapshot, grounding.state
        self._told = Whereabouts(grounding.snapshot, grounding.state, settings)

    def of(self, ask: Ask, context: Context) -> Report | Trouble:
        """The answer, or why there is none."""
        nodes: list[str] = []
        for reference in ask.things:
            found = one_place(self._grounding, reference, context)
            if not isinstance(found, str):
                return found
            nodes.append(found)
        match ask.kind:
            case QueryKind.DISTANCE:
                return self._distance(nodes)
            case QueryKind.PATH:
                return self._path(nodes)
            case QueryKind.SIZE:
                return self._size(nodes[0])
            case QueryKind.LAST_SEEN:
                return self._last_seen(nodes[0])
            case QueryKind.CAPABLE:
                return self._capable(nodes[0])
            case QueryKind.DONE_WITH:
                return self._done_with(nodes[0], context)
            case QueryKind.DURATION:
                return self._duration(nodes[0], ask.word, context)
            case QueryKind.NAME:
                return self._name(nodes)
            case _:
                return Report(text=self._of_itself(ask.kind, context))

    def _of_itself(self, kind: QueryKind, context: Context) -> str:
        """What the robot says of itself: who and how it is, and what it did."""
        match kind:
            case QueryKind.BATTERY:
                return self._battery()
            case QueryKind.EXPLORED:
                return self._explored()
            case QueryKind.NATURE:
                return f"I am Majordomo, a robot that fetches and carries. {ABILITIES}"
            case QueryKind.WELL_BEING:
                doing = _told(QueryKind.DOING, context.earlier, self._settings.most_told)
                return f"I am fine, thank you. {self._battery()} {doing}"
            case QueryKind.SOURCE:
                return "I say only what I have seen myself, and how long ago; things may have changed since."
            case QueryKind.ASKED:
                return _sentence(context.earlier[0]) if context.earlier else "You have not asked me for anything yet."
            case _:
                return _told(kind, context.earlier, self._settings.most_told)

    def _explored(self) -> str:
        """How far exploration has come; the robot goes on with it by itself."""
        number = len(self._snapshot.of_type(RoomNode))
        rooms = f"{number} room{'' if number == 1 else 's'}"
        if not parts_unseen(self._snapshot):
            return f"I have seen all of the building that I can get to: {rooms}."
        so_far = f"I know {rooms} so far" if number else "I know no room yet"
        return f"{so_far}, and there is more to see. I go on exploring by myself whenever nothing else is to be done."

    def _distance(self, nodes: list[str]) -> Report:
        start = nodes[1] if len(nodes) > 1 else self._state.robot_at
        distance_m = self._state.distance_m(start, nodes[0])
        name, other = capital(self._name_of(nodes[0])), self._name_of(nodes[1]) if len(nodes) > 1 else "me"
        if distance_m is None:
            return Report(text=f"I know of no open way to {self._name_of(nodes[0])}.", nodes=tuple(nodes))
        being = "are" if name == "You" else "is"
        return Report(text=f"{name} {being} about {distance_m:.1f} m from {other}.", nodes=tuple(nodes))

    def _path(self, nodes: list[str]) -> Report:
        speaker = self._grounding.speaker(Context())
        start = nodes[1] if len(nodes) > 1 else speaker[0] if isinstance(speaker, tuple) else self._state.robot_at
        here, there = self._state.room_of(start), self._state.room_of(nodes[0])
        name = self._name_of(nodes[0])
        if here is None or there is None:
            return Report(
                text=f"I do not know which room {name if there is None else 'that'} is in.", nodes=tuple(nodes)
            )
        if here == there:
            return Report(text=f"{capital(name)} is in the same room, {self._name_of(here)}.", nodes=tuple(nodes))
        path = Topology.from_snapshot(self._snapshot).path(here, there, only_open=False)
        if path is None:
            return Report(text=f"I know of no way to {name}.", nodes=tuple(nodes))
        closed = [self._name_of(i) for i in self._state.world.closed_doors(here, there)]
        rooms = [self._name_of(room) for room in path.rooms]
        through = f" through {listed(rooms[1:-1])}" if rooms[1:-1] else ""
        shut = f" {capital(listed(closed))} {'is' if len(closed) == 1 else 'are'} closed." if closed else ""
        place = "" if there == nodes[0] else f", where {name} is"
        text = f"From {rooms[0]}{through} to {rooms[-1]}{place}: about {path.length_m:.0f} m.{shut}"
        return Report(text=text, nodes=(*path.rooms, *path.doors))

    def _size(self, node_id: str) -> Report:
        node, name = self._snapshot.node(node_id), capital(self._name_of(node_id))
        if isinstance(node, RoomNode) and node.polygon_m:
            xs, ys = [p[0] for p in node.polygon_m], [p[1] for p in node.polygon_m]
            return Report(
                text=f"{name} is about {max(xs) - min(xs):.1f} by {max(ys) - min(ys):.1f} m.", nodes=(node_id,)
            )
        if isinstance(node, ObjectNode) and max(node.size_m) > 0.0:
            sides = " × ".join(f"{100 * side:.0f}" for side in node.size_m)
            return Report(text=f"{name} measures about {sides} cm.", nodes=(node_id,))
        return Report(text=f"I have not measured {self._name_of(node_id)}.", nodes=(node_id,))

    def _last_seen(self, node_id: str) -> Report:
        node = self._snapshot.node(node_id)
        if not isinstance(node, ObjectNode | PersonNode):
            return Report(text="I note when I see things, not rooms.", nodes=(node_id,))
        age = age_phrase(self._snapshot.stamp_s - node.last_seen_s, self._settings)
        return Report(text=f"I saw {self._name_of(node_id)} {age}.", nodes=(node_id,))

    def _capable(self, node_id: str) -> Report:
        thing, name = self._state.world.things.get(node_id), self._name_of(node_id)
        if thing is not None and thing.kind == "object" and not thing.graspable:
            return Report(text=f"No, I cannot carry {name}.", nodes=(node_id,))
        room = self._state.room_of(node_id)
        if room is None or self._state.robot_room is None:
            return Report(text=f"I do not know which room {name} is in.", nodes=(node_id,))
        if room != self._state.robot_room and self._state.distance_m(self._state.robot_room, room) is None:
            doors = [self._name_of(door) for door in self._state.world.closed_doors(self._state.robot_room, room)]
            why = f": {listed(doors)} {'is' if len(doors) == 1 else 'are'} closed" if doors else ""
            return Report(text=f"No, I know of no open way to {name}{why}.", nodes=(node_id,))
        return Report(text=f"Yes, I can: {name} is within my reach.", nodes=(node_id,))

    def _done_with(self, node_id: str, context: Context) -> Report:
        """Whether the robot did something with a thing, or went to a place, as far as it remembers."""
        about = [e for e in context.earlier if any(node_id in goal.args[:1] for goal in e.goals)]
        if not about:
            return Report(
                text=f"No, not that I remember. {self._told.sentence(node_id, rooms_only=False)}", nodes=(node_id,)
            )
        lead = "Yes." if about[0].status == "succeeded" else "Not yet." if about[0].status in UNDER_WAY else "No."
        return Report(text=f"{lead} {_sentence(about[0])}", nodes=(node_id,))

    def _duration(self, node_id: str, what: str, context: Context) -> Report:
        """How long a way takes, or to fetch a thing for whoever asks; a rough guess, and said so."""
        name = self._name_of(node_id)
        way_m = self._state.distance_m(self._state.robot_at, node_id)
        handling_s = 0.0
        if what == "fetch":
            speaker = self._grounding.speaker(context)
            back_m = self._state.distance_m(node_id, speaker[0]) if isinstance(speaker, tuple) else way_m
            way_m = way_m + back_m if way_m is not None and back_m is not None else None
            handling_s = self._settings.handling_s
        if way_m is None:
            return Report(text=f"I know of no open way to {name}.", nodes=(node_id,))
        seconds = way_m / self._settings.speed_mps + handling_s
        told = f"{seconds:.0f} seconds" if seconds < MINUTE_S else f"{seconds / MINUTE_S:.1f} minutes"
        doing = f"bring you {name}" if what == "fetch" else f"get to {name}"
        return Report(text=f"I would need about {told} to {doing}.", nodes=(node_id,))

    def _battery(self) -> str:
        robot = self._snapshot.robot
        return f"My battery is at {100 * robot.battery:.0f} %." if robot else "I do not know how full my battery is."

    def _name(self, nodes: list[str]) -> Report:
        if not nodes:
            return Report(text="I am Majordomo, a robot that fetches and carries.")
        node = self._snapshot.get(nodes[0])
        name = node.name if isinstance(node, PersonNode) else ""
        return Report(text=f"You are {name}." if name else "You have not told me your name.", nodes=tuple(nodes))

    def _name_of(self, node_id: str) -> str:
        node = self._snapshot.get(node_id)
        speaker = self._grounding.speaker(Context())
        if isinstance(node, PersonNode) and speaker == (node_id,):
            return "you"
        return name_of(node_id, self._snapshot)


def _told(kind: QueryKind, earlier: tuple[Exchange, ...], most_told: int) -> str:
    if kind is QueryKind.DOING:
        busy = [e for e in earlier if e.status in UNDER_WAY]
        return " ".join(map(_sentence, busy[:1])) or "Nothing right now: I am waiting for your request."
    if kind is QueryKind.FAILURE:
        failed = [e for e in earlier if e.status in ("failed", "refused", "cancelled")]
        return _sentence(failed[0]) if failed else "I have not failed at anything that I remember."
    begun = [e for e in earlier if e.status in BEGUN and e.goals]
    return " ".join(map(_sentence, begun[:most_told])) or NOTHING_YET


def _sentence(exchange: Exchange) -> str:
    why = exchange.explanation or "I have nothing to add."
    return f"You asked: “{exchange.request}”. It is {exchange.status.replace('_', ' ')}: {why}"
