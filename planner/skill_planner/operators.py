"""The search's operators: which skills are worth trying for a goal in a state, and the least that goals can cost.

Grounding is by purpose. For a goal about a cup only the cup, what stands on it, what the gripper holds, and places to
put them come into question, so a building of thousands of nodes branches no more than a room does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import inf

from planner.goals import PLACING, Goal, Predicate
from planner.plan import Step
from planner.skill_planner.settings import SkillPlanningSettings
from planner.skill_planner.stops import Stops
from planner.surfaces import surfaces_near
from skills.skill import Skill, Unmet
from skills.state.state import PlaceRelation, PlanState, World

GOTO, PICK, PLACE = "GOTO", "PICK", "PLACE"

Applied = tuple[Step, float, PlanState]


class Operators:
    """Grounded skills of one problem, whose ways' costs are remembered.

    What is in the way is put down where the robot stands; what a goal needs again later, also where the robot comes to
    on its way, and in any room of the request.
    """

    def __init__(
        self,
        skills: Mapping[str, Skill],
        goals: Sequence[Goal],
        start: PlanState,
        *,
        settings: SkillPlanningSettings = SkillPlanningSettings(),
    ) -> None:
        self._skills, self._near_m = skills, settings.goals.near_m
        others = (skill for name, skill in skills.items() if name not in (GOTO, PICK, PLACE))
        self._on_doors = tuple(s.name for s in others if len(s.parameters) == 1 and "door" in s.parameters[0].kinds)
        self._legs_s: dict[tuple[World, str, str], float] = {}
        self._needed = frozenset(arg for goal in goals for arg in goal.args)
        spoken_of = (node for goal in goals for node in (*goal.args, *self.places(goal, start)))
        self._stops = Stops(spoken_of, start, most=settings.most_stops)

    def applicable(
        self, goal: Goal, state: PlanState, unmet: dict[Unmet, None], later: Sequence[Goal] = ()
    ) -> Iterator[Applied]:
        """Steps towards ``goal`` whose conditions hold; the conditions that do not are added to ``unmet``.

        ``later``: goals that come after this one.
        """
        in_the_way: dict[str, None] = {}
        for step in self._steps(goal, state, later):
            failed = self._skills[step.skill].conditions(state, step.args)
            if not failed:
                yield self._applied(step, state)
            unmet.update(dict.fromkeys(failed))
            in_the_way.update((node, None) for condition in failed if condition.final for node in condition.nodes)
        yield from (self._applied(step, state) for step in self._remedies(in_the_way, state))

    def _applied(self, step: Step, state: PlanState) -> Applied:
        skill = self._skills[step.skill]
        return step, skill.cost_s(state, step.args), skill.effects(state, step.args)

    def _remedies(self, nodes: Iterable[str], state: PlanState) -> Iterator[Step]:
        """What the skills of other packages can do about nodes that conditions name, and the way there."""
        others = [skill for name, skill in self._skills.items() if name not in (GOTO, PICK, PLACE)]
        for node in nodes:
            thing = state.world.things.get(node)
            for skill in others:
                if thing is None or len(skill.parameters) != 1 or not skill.parameters[0].accepts(thing):
                    continue
                if not skill.conditions(state, (node,)):
                    yield Step(skill=skill.name, args=(node,))
                elif not self._skills[GOTO].conditions(state, (node,)):
                    yield from self._goto(state, node)

    def at_least_s(self, goals: Sequence[Goal], state: PlanState) -> float:
        """Seconds that ``goals``, none of which holds, take at least from ``state``.

        Every object that must move is picked up once, carried once and put down once, one after the other; the robot
        must first come to one of them, and in the end to everywhere it is sent. What is to be near something that moves
        itself may not have to, nor what is in something that can be carried.
        """
        first: dict[str, Goal] = {}
        moving = {goal.object_id for goal in goals}
        sent_s = 0.0
        for goal in goals:
            if goal.predicate is Predicate.OPEN:
                continue
            if goal.object_id is None or goal.predicate is Predicate.FOUND:
                sent_s = max(sent_s, self._sent_s(goal, state))
            elif (goal.predicate is not Predicate.NEAR or goal.args[1] not in moving) and not _comes_along(goal, state):
                first.setdefault(goal.args[0], goal)
        handling_s, approaches_s = 0.0, [inf]
        for object_id, goal in first.items():
            handling_s += self._handling_s(goal, state)
            if state.holding in goal.args or state.is_at(object_id):
                approaches_s.append(0.0)
            else:
                approaches_s.append(self._leg_s(state, None, object_id))
        return max(sent_s, handling_s + (min(approaches_s) if first else 0.0))

    def _steps(self, goal: Goal, state: PlanState, later: Sequence[Goal]) -> Iterator[Step]:
        """Going to what is to be found, where the goal's object or place is in reach too, saves an approach."""
        to_find = dict.fromkeys(other.args[0] for other in (goal, *later) if other.predicate is Predicate.FOUND)
        for step in self._worth_trying(goal, state, later):
            yield step
            if step.skill == GOTO:
                beside = (thing for thing in to_find if thing != step.args[0])
                yield from (Step(skill=GOTO, args=(x,)) for x in beside if self._in_reach(step.args[0], x, state))

    def _in_reach(self, target: str, beside: str, state: PlanState) -> bool:
        """Whether the robot can go to ``beside``, and stands at ``target`` there too."""
        goto = self._skills[GOTO]
        return not goto.conditions(state, (beside,)) and goto.effects(state, (beside,)).is_at(target)

    def _worth_trying(self, goal: Goal, state: PlanState, later: Sequence[Goal]) -> Iterator[Step]:
        if goal.predicate is Predicate.OPEN:
            yield from self._goto(state, goal.args[0])
            yield from (Step(skill=name, args=goal.args) for name in self._on_doors)
            if state.holding is not None:
                yield from self._put_away(state, state.holding, goal, later)
        elif goal.object_id is None or (goal.predicate is Predicate.FOUND and state.holding != goal.args[0]):
            yield from self._goto(state, goal.args[0])
            if state.holding is not None and (goal.predicate is Predicate.FOUND or state.holding in self._needed):
                yield from self._put_away(state, state.holding, goal, later)
            if goal.predicate is Predicate.FOUND and state.holding is None:
                yield from self._take(goal.args[0], state)
        elif state.holding == goal.args[0]:
            yield from self._put(state, goal.args[0], self.places(goal, state))
        elif state.holding is not None:
            yield from self._put_away(state, state.holding, goal, later)
        else:
            for object_id in (goal.args[0], *_blockers(state, goal.args[0])):
                yield from self._goto(state, object_id)
                yield Step(skill=PICK, args=(object_id,))

    def _take(self, object_id: str, state: PlanState) -> Iterator[Step]:
        """To have found something by picking it up: what stands on it first; going to it would end the search there."""
        blockers = _blockers(state, object_id)
        below = [link for link in list(state.chain(object_id))[1:] if not _is_room(link, state)]
        for other in (*below, *blockers):
            yield from self._goto(state, other)
        yield from (Step(skill=PICK, args=(x,)) for x in (object_id, *blockers))

    def places(self, goal: Goal, state: PlanState) -> tuple[str, ...]:
        """Where ``goal``'s object can be put so that the goal holds. PLACE itself finds a free spot there."""
        if goal.predicate is not Predicate.NEAR:
            return goal.args[1:] if goal.predicate in PLACING else ()
        handed = state.world.things[goal.args[1]].kind == "person"
        return (goal.args[1],) if handed else surfaces_near(goal.args[1], state, self._near_m)

    def _put(self, state: PlanState, object_id: str, places: Sequence[str]) -> Iterator[Step]:
        for place in places:
            if not state.is_inside(place):
                yield from self._goto(state, place)
            yield Step(skill=PLACE, args=(object_id, place))

    def _put_away(self, state: PlanState, object_id: str, goal: Goal, later: Sequence[Goal]) -> Iterator[Step]:
        """The held object is not the goal's: it goes down here or, needed again, elsewhere; and beside the goal's
        object, if that is to be near it.
        """
        if goal.predicate is Predicate.NEAR and object_id == goal.args[1]:
            yield from self._put(state, object_id, surfaces_near(goal.args[0], state, self._near_m))
            return
        room = state.robot_room
        if room is not None and self._stops.may_lie_in(object_id, room, later):
            yield Step(skill=PLACE, args=(object_id, room))
        if object_id in self._needed:
            for stop in self._stops.to_leave(object_id, goal, state):
                yield from self._goto(state, stop)

    def _goto(self, state: PlanState, target: str) -> Iterator[Step]:
        """To ``target``; into a room also by going to something in it that the request speaks of."""
        stops = self._stops.into(target, state) if _is_room(target, state) and target != state.robot_room else (target,)
        yield from (Step(skill=GOTO, args=(stop,)) for stop in stops if state.robot_at != stop)

    def _handling_s(self, goal: Goal, state: PlanState) -> float:
        """Seconds to pick up (unless held), carry and put down the goal's object, without the way to it."""
        object_id = goal.args[0]
        if goal.predicate is Predicate.NEAR and state.holding == goal.args[1]:
            return 0.0
        held = state.holding == object_id
        pick_s = 0.0 if held else self._skills[PICK].cost_s(state, (object_id,))
        if goal.predicate is Predicate.HOLDING:
            return pick_s
        costs_s = [
            self._carry_s(state, object_id, place) + self._put_s(state, object_id, place)
            for place in self.places(goal, state)
        ]
        return pick_s + min(costs_s, default=0.0)

    def _put_s(self, state: PlanState, object_id: str, place: str) -> float:
        return self._skills[PLACE].cost_s(state, (object_id, place))

    def _sent_s(self, goal: Goal, state: PlanState) -> float:
        """The way to where the robot is sent."""
        target = goal.args[-1]
        return 0.0 if state.is_at(target) else self._way_s(state, None, target)

    def _carry_s(self, state: PlanState, object_id: str, place: str) -> float:
        here = state.holding == object_id or state.is_at(object_id)
        together = place == state.room_of(object_id) or state.anchor(object_id) == state.anchor(place)
        if together or (here and (state.is_at(place) or state.is_inside(place))):
            return 0.0
        from_robot_s = self._way_s(state, None, place) if here else inf
        return from_robot_s if state.holding == object_id else min(from_robot_s, self._way_s(state, object_id, place))

    def _way_s(self, state: PlanState, start: str | None, target: str) -> float:
        """Seconds of one GOTO that leads to ``target``, or anywhere into it if it is a room."""
        stops = self._stops.into(target, state) if _is_room(target, state) else (target,)
        return min(self._leg_s(state, start, stop) for stop in stops)

    def _leg_s(self, state: PlanState, start: str | None, target: str) -> float:
        """Seconds of one GOTO from ``start`` (the robot's own place when None); a detour takes no less."""
        origin = state.robot_at if start is None else start
        here, goal = state.anchor(origin), state.anchor(target)
        key = (state.world, here, goal)
        if key not in self._legs_s:
            there = state.after(robot_at=here, robot_room=state.room_of(here), near=frozenset())
            self._legs_s[key] = self._skills[GOTO].cost_s(there, (goal,))
        return self._legs_s[key]


def _is_room(node_id: str, state: PlanState) -> bool:
    return state.world.things[node_id].kind == "room"


def _comes_along(goal: Goal, state: PlanState) -> bool:
    """Whether the goal's object is in something that can be carried, and may be moved with it."""
    places = (state.places.get(link) for link in state.chain(goal.args[0]))
    into = [place for at in places if at is not None for relation, place in (at,) if relation is PlaceRelation.IN]
    return any(place in state.places or place == state.holding for place in into)


def _blockers(state: PlanState, object_id: str) -> list[str]:
    """Everything that stands on ``object_id``, whatever it stands on in between, and whatever stands in the way of the
    hand to any of it; what is in it comes along.
    """
    found: dict[str, None] = {}
    todo = [object_id]
    while todo:
        others = [other for other in state.in_the_way_of(todo.pop()) if other not in found and other != object_id]
        found.update(dict.fromkeys(others))
        todo += others
    return list(found)
