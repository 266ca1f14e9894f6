"""An independent planner: reads PDDL text and searches it by uniform cost. It knows nothing of robots and scene graphs.

Typed STRIPS with action costs. Actions are grounded by what can be reached when nothing is ever deleted; a state is the
set of facts that hold, as bits of one number.
"""

from __future__ import annotations

import heapq
import re
from itertools import count

Fact = tuple[str, ...]


class Task:
    """A grounded problem: ``operators`` are (name, needs, adds, deletes, cost), the middle three as bits."""

    def __init__(self, domain: str, problem: str) -> None:
        domain_parts, problem_parts = _parse(domain)[2:], _parse(problem)[2:]
        facts, self._costs = set(), {}
        for fact in next(part for part in problem_parts if part[0] == ":init")[1:]:
            if fact[0] == "=":
                self._costs[tuple(fact[1])] = int(fact[2])
            else:
                facts.add(tuple(fact))
        supertypes, objects = {}, {}
        for part in (*domain_parts, *problem_parts):
            if part[0] == ":types":
                supertypes |= _typed(part[1:])
            if part[0] in (":constants", ":objects"):
                objects |= _typed(part[1:])
        self._types = {name: set(_lineage(kind, supertypes)) for name, kind in objects.items()}
        actions = [_action(part) for part in domain_parts if part[0] == ":action"]
        self._bits: dict[Fact, int] = {}
        grounded = self._ground(actions, facts)
        changing = {fact for _, _, adds, deletes, _ in grounded for fact in (*adds, *deletes)}
        self.start = self._mask(facts & changing)
        self.operators = [
            (name, self._mask(set(needs) & changing), self._mask(adds), self._mask(deletes), cost)
            for name, needs, adds, deletes, cost in grounded
        ]
        goal = next(part for part in problem_parts if part[0] == ":goal")[1]
        self.goal = self._mask({tuple(fact) for fact in (goal[1:] if goal[0] == "and" else [goal])})

    def _mask(self, facts) -> int:
        return sum(1 << self._bits.setdefault(fact, len(self._bits)) for fact in set(facts))

    def _ground(self, actions, facts):
        reached, grounded = set(facts), {}
        while True:
            before = len(reached)
            by_name: dict[str, list[Fact]] = {}
            for fact in reached:
                by_name.setdefault(fact[0], []).append(fact)
            for name, parameters, needs, adds, deletes, cost in actions:
                rarest_first = sorted(needs, key=lambda need, known=by_name: len(known.get(need[0], [])))
                for binding in self._bindings(parameters, rarest_first, by_name):
                    terms = (name, *(binding[p] for p in parameters))
                    if terms not in grounded:
                        price = cost if isinstance(cost, int) else self._costs[_put([cost], binding)[0]]
                        added, deleted = _put(adds, binding), set(_put(deletes, binding))
                        grounded[terms] = (terms, _put(needs, binding), added, deleted - set(added), price)
                        reached.update(added)
            if len(reached) == before:
                return list(grounded.values())

    def _bindings(self, parameters, needs, by_name, binding=None):
        binding = binding or {}
        if not needs:
            assert binding.keys() == parameters.keys(), "every parameter is in a precondition"
            yield binding
            return
        first, *rest = needs
        for fact in by_name.get(first[0], []):
            new = dict(binding)
            if all(self._fits(term, value, new, parameters) for term, value in zip(first, fact, strict=True)):
                yield from self._bindings(parameters, rest, by_name, new)

    def _fits(self, term, value, binding, parameters) -> bool:
        if not term.startswith("?"):
            return term == value
        if term not in binding and parameters[term] in self._types[value]:
            binding[term] = value
        return binding.get(term) == value


def cheapest(task: Task) -> tuple[int, list[Fact]] | None:
    """Cost and steps of an optimal plan (Dijkstra, 1959), None when there is none."""
    tie = count()
    queue = [(0, next(tie), task.start, None)]
    best, closed = {task.start: 0}, set()
    while queue:
        cost, _, state, trail = heapq.heappop(queue)
        if state in closed:
            continue
        closed.add(state)
        if state & task.goal == task.goal:
            steps = []
            while trail is not None:
                trail, step = trail
                steps.append(step)
            return cost, steps[::-1]
        for name, needs, adds, deletes, price in task.operators:
            if needs & state == needs:
                after = (state & ~deletes) | adds
                if cost + price < best.get(after, 1 << 60):
                    best[after] = cost + price
                    heapq.heappush(queue, (cost + price, next(tie), after, (trail, name)))
    return None


def _parse(text: str):
    tokens = re.findall(r"[()]|[^\s()]+", re.sub(r";.*", "", text).lower())

    def read(position: int):
        if tokens[position] != "(":
            return tokens[position], position + 1
        items, position = [], position + 1
        while tokens[position] != ")":
            item, position = read(position)
            items.append(item)
        return items, position + 1

    parsed, end = read(0)
    assert end == len(tokens)
    return parsed


def _put(things, binding) -> list[Fact]:
    return [tuple(binding.get(term, term) for term in thing) for thing in things]


def _typed(entries) -> dict[str, str]:
    kinds, waiting, entries = {}, [], list(entries)
    while entries:
        entry = entries.pop(0)
        if entry == "-":
            kind = entries.pop(0)
            kinds |= dict.fromkeys(waiting, kind)
            waiting = []
        else:
            waiting.append(entry)
    return kinds | dict.fromkeys(waiting, "object")


def _lineage(kind, supertypes):
    while kind is not None:
        yield kind
        kind = supertypes.get(kind) if kind != "object" else None


def _action(part):
    name, fields = part[1], dict(zip(part[2::2], part[3::2], strict=True))
    needs = [tuple(fact) for fact in fields[":precondition"][1:]]
    adds, deletes, cost = [], [], 1
    for effect in fields[":effect"][1:]:
        if effect[0] == "not":
            deletes.append(tuple(effect[1]))
        elif effect[0] == "increase":
            cost = int(effect[2]) if isinstance(effect[2], str) else tuple(effect[2])
        else:
            adds.append(tuple(effect))
    return name, _typed(fields[":parameters"]), needs, adds, deletes, cost
