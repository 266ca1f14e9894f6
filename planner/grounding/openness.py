"""Whether doors are open, and rooms can be entered: yes, no, or not known."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from dataclasses import replace

from planner.language.grammar.syntax import Ask, NounPhrase, Restriction
from planner.naming import listed, name_of
from scene_graph.edges import TASK_AGENT
from scene_graph.edits import PutNode
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode, DoorState, RoomNode
from scene_graph.queries.doors import physical_doors
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)

OPENNESS = ("open", "closed")
"""Words for the state of a door, and of a room by its doors."""


def is_open(node_id: str, snapshot: Snapshot) -> bool | None:
    """Whether a door is open, or a room has an open door; ``None`` when it was not seen lately, or of others."""
    node = snapshot.get(node_id)
    if isinstance(node, DoorNode):
        return None if node.state is DoorState.UNKNOWN else node.state is DoorState.OPEN
    if not isinstance(node, RoomNode):
        return None
    states = [door.state for door in snapshot.of_type(DoorNode) if node_id in door.rooms]
    if DoorState.OPEN in states:
        return True
    return None if DoorState.UNKNOWN in states or not states else False


def suppose_not_known(doors: Iterable[str], memory: WorkingMemory, stamp_s: float) -> None:
    """Take back that doors are closed, on both sides: somebody may have opened them since they were seen."""
    named = frozenset(doors)
    meant = [door for door in physical_doors(memory.building()) if named & {side.id for side in door.members}]
    closed = [side for door in meant for side in door.members if side.state is DoorState.CLOSED]
    logger.info("perhaps opened: %s", ", ".join(side.id for side in closed))
    edits = [PutNode(replace(side, state=DoorState.UNKNOWN)) for side in closed]
    memory.commit(edits, agent=TASK_AGENT, stamp_s=stamp_s)


def about_openness(ask: Ask) -> bool:
    """Whether a question turns on what is open or closed."""
    return any(_tells_openness(restriction) for restriction in _stated(ask))


def about_loss(ask: Ask) -> bool:
    """Whether a question is about what is missing."""
    return any(each.relation == "state" and each.word not in OPENNESS for each in _stated(ask))


def without_openness(phrase: NounPhrase) -> NounPhrase:
    """*Doors*, of *open doors*."""
    kept = tuple(each for each in phrase.restrictions if not _tells_openness(each))
    return NounPhrase(**{**vars(phrase), "restrictions": kept})


def undecided(found: Iterable[str], snapshot: Snapshot) -> tuple[str, ...]:
    """The doors and rooms of ``found`` of which it is not known whether they are open."""
    return tuple(i for i in found if isinstance(snapshot.get(i), DoorNode | RoomNode) and is_open(i, snapshot) is None)


def not_known(doors: Iterable[str], snapshot: Snapshot) -> str:
    """*I do not know whether the door … is open: I have not seen it lately.*; empty of none."""
    names = [name_of(i, snapshot) for i in doors]
    if not names:
        return ""
    one = len(names) == 1
    told = f"I do not know whether {listed(names)} {'is' if one else 'are'} open:"
    return f"{told} I have not seen {'it' if one else 'them'} lately."


def _stated(ask: Ask) -> tuple[Restriction, ...]:
    thing = ask.things[0] if ask.things else None
    inner = thing.restrictions if isinstance(thing, NounPhrase) else ()
    return (*inner, *((ask.place,) if ask.place is not None else ()))


def _tells_openness(restriction: Restriction) -> bool:
    return restriction.relation == "state" and restriction.word in OPENNESS
