"""What requests mean in a flat, for tests of grounding."""

from __future__ import annotations

from planner.dialogue.interpreter import Interpreter
from planner.doubles.sketch import flat
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

VERIFIER = Verifier(load_registry([]))
INTERPRETER = Interpreter(CommandGrammar(), VERIFIER)
PLANNER = TaskPlanner(CommandGrammar(), VERIFIER)
FLAT = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))


def read(text, snapshot=FLAT, **dialogue):
    return INTERPRETER.read(text, snapshot, Dialogue(**dialogue)).interpretation


def goals(text, snapshot=FLAT, **dialogue):
    found = read(text, snapshot, **dialogue)
    return " ".join(map(str, found.goals)) or f"{found.kind}: {found.reply}"


def in_hall(sketch):
    return sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))


def at_desk(sketch):
    return sketch.snapshot(robot_in="room_4", at=(4.2, 4.4))


def unlabeled(sketch, node_id, on, **chances):
    return sketch.thing(node_id, "unknown", on=on, label_distribution=tuple(chances.items()))
