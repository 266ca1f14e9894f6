"""How references are spoken of: the phrase as said, candidates to choose from, what there is instead."""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner.grounding.context import Ambiguous, Context, Grounded
from planner.grounding.matching import nodes_of, similar
from planner.language.grammar.syntax import NounPhrase, Pronoun, Quantity, Reference, Spot
from planner.language.lexicon.vocabulary import ALWAYS_PLURAL, is_known, is_plural, normal, singular
from planner.naming import MOST_LISTED, at, bare_name, listed, name_of
from scene_graph.nodes import CrossingStatus, DoorNode, ObjectNode, ObjectState, PersonNode, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

AMONG = "among "
"""Before a phrase: the candidates that an answer left, when it did not leave one."""


def phrase_text(phrase: NounPhrase) -> str:
    """A noun phrase without its article: *big red cup on the table*."""
    words = [*phrase.sizes, *phrase.colors, *phrase.words]
    if phrase.superlative is not None:
        words.insert(0, phrase.superlative)
    if phrase.rank is not None:
        words.insert(0, ("first", "second", "third", "fourth", "fifth")[phrase.rank - 1])
    if phrase.other:
        words.insert(0, "other")
    if phrase.quantity in (Quantity.SOME, Quantity.EXACTLY, Quantity.BOTH) and phrase.count:
        words.insert(0, str(phrase.count))
    if phrase.number is not None:
        words.append(str(phrase.number))
    for restriction in phrase.restrictions:
        if isinstance(restriction.reference, Pronoun) and restriction.relation == "of person":
            continue
        relation = {"of person": "of", "floor": "on the floor", "kind": "like", "is": ""}.get(
            restriction.relation, restriction.relation
        )
        words += [word for word in ("not" if restriction.negated else "", restriction.word or relation) if word]
        for reference in (restriction.reference, restriction.other):
            words += [] if reference is None else ["and"] if reference is restriction.other else []
            words += [] if reference is None else [_reference_text(reference)]
    for exception in phrase.exceptions:
        words.append(f"except {_reference_text(exception)}")
    return " ".join(words)


def _reference_text(reference: Reference) -> str:
    match reference:
        case NounPhrase():
            return f"the {phrase_text(reference)}"
        case Pronoun():
            return reference.word
        case Spot():
            return f"where {_reference_text(reference.thing)} {'was' if reference.past else 'is'}"


def describe(node_id: str, snapshot: Snapshot) -> str:
    """A candidate in words, with its place: "the blue bottle on the table in the kitchen"."""
    node = snapshot.get(node_id)
    name = name_of(node_id, snapshot)
    if isinstance(node, ObjectNode):
        place = place_phrase(node_id, snapshot)
        return name if place in name else f"{name} {place}"
    if isinstance(node, PersonNode):
        room = snapshot.room_of(node_id)
        return f"{name} in {name_of(room, snapshot)}" if room is not None else name
    return name


def place_phrase(object_id: str, snapshot: Snapshot) -> str:
    """Where an object is: "on the table in the kitchen", "in my gripper", "at a place I do not know"."""
    node = snapshot.get(object_id)
    if snapshot.robot is not None and snapshot.robot.holding == object_id:
        return "in my gripper"
    support, room = snapshot.support_of(object_id), snapshot.room_of(object_id)
    if support is not None:
        place = at(support, snapshot)
        named = f"in {name_of(room, snapshot)}" if room is not None else ""
        place = place if not named or place.endswith(named) else f"{place} {named}"
    else:
        place = f"in {name_of(room, snapshot)}" if room is not None else "at a place I do not know"
    lost = isinstance(node, ObjectNode) and node.state is ObjectState.MISSING
    return f"last known {place}" if lost else place


def which_question(ask: str, text: str, candidates: Sequence[str], snapshot: Snapshot) -> str:
    """A question that lists the candidates as a person would tell them apart; they can be answered by number, too."""
    options = told_apart(candidates[:MOST_LISTED], snapshot)
    more = f", or one of {len(candidates) - MOST_LISTED} more" if len(candidates) > MOST_LISTED else ""
    lead = f"“{text}” could be several things. " if text != "you" else ""
    return f"{lead}{ask}: {_ored(options)}{more}?"


def ambiguous(text: str, found: tuple[str, ...], context: Context, ask: str, snapshot: Snapshot) -> Grounded:
    """The one that an earlier answer has chosen, else the question which of ``found`` is meant."""
    chosen = tuple(i for i in context.choices.get(text, ()) if i in found)
    if chosen:
        return chosen
    found = tuple(i for i in context.choices.get(f"{AMONG}{text}", ()) if i in found) or found
    return Ambiguous(question=which_question(ask, text, found, snapshot), phrase=text, candidates=found)


def told_apart(candidates: Sequence[str], snapshot: Snapshot) -> list[str]:
    """Descriptions, with what is beside them where two are alike, and a count where that is alike as well."""
    told = [describe(i, snapshot) for i in candidates]
    told = [
        _with_company(i, text, snapshot) if told.count(text) > 1 else text
        for i, text in zip(candidates, told, strict=True)
    ]
    alike = {text for text in told if told.count(text) > 1}
    return [f"{text} (number {k})" if text in alike else text for k, text in enumerate(told, 1)]


def _with_company(node_id: str, text: str, snapshot: Snapshot) -> str:
    """A room by a person or a piece of furniture in it, a thing by what stands on it."""
    node = snapshot.get(node_id)
    if isinstance(node, RoomNode):
        there = [other for other in nodes_of(snapshot) if snapshot.room_of(other.id) == node_id]
        people = [other.name for other in there if isinstance(other, PersonNode) and other.name]
        objects = [bare_name(other) for other in there if isinstance(other, ObjectNode) and not other.graspable]
        marks = people or objects
    else:
        marks = [
            bare_name(other)
            for other in nodes_of(snapshot)
            if isinstance(other, ObjectNode) and snapshot.support_of(other.id) == node_id
        ]
    return f"{text} with {marks[0]}" if marks else text


def alternatives(phrase: NounPhrase, same: Sequence[str], snapshot: Snapshot) -> str:
    """Why a phrase names nothing, what there is instead, and what was not seen of the building."""
    unseen = " I have not seen the whole building yet." if parts_unseen(snapshot) else _not_gone_through(snapshot)
    return _alternatives(phrase, same, snapshot) + unseen


def _not_gone_through(snapshot: Snapshot) -> str:
    """In which rooms there are doors that the robot has given up, such as one before which somebody stands."""
    left = [d for d in snapshot.of_type(DoorNode) if d.rooms[1] is None and d.crossing is CrossingStatus.GIVEN_UP]
    rooms = list(dict.fromkeys(name_of(door.rooms[0], snapshot) for door in left if door.rooms[0] in snapshot))
    what = "There is a door" if len(left) == 1 else "There are doors"
    return f" {what} in {listed(rooms)} that I have not been through." if rooms else ""


def parts_unseen(snapshot: Snapshot) -> bool:
    """Whether exploration goes on: a door that nobody went through yet, something to look at, or not even a room."""
    doors, rooms = snapshot.of_type(DoorNode), snapshot.of_type(RoomNode)
    ahead = any(door.rooms[1] is None and door.crossing is CrossingStatus.UNCROSSED for door in doors)
    unmeasured = not rooms or any(room.status is RoomStatus.TEMPORARY for room in rooms)
    wanted = any(edge.is_open and edge.explores for edge in snapshot.intentions())
    return not snapshot.root.explored and (ahead or unmeasured or wanted)


def _alternatives(phrase: NounPhrase, same: Sequence[str], snapshot: Snapshot) -> str:
    text = phrase_text(phrase)
    head = singular(phrase.head)
    if phrase.person and not same:
        known = [name_of(node.id, snapshot) for node in snapshot.of_type(PersonNode)]
        others = f" I know {listed(known)}." if known else " I have not seen anybody yet."
        return f"I know nobody called {phrase.head}.{others}"
    if same:
        seen = listed(list(dict.fromkeys(article(described(i, snapshot)) for i in same[:3])))
        return f"I know of no {text}. I have seen {seen}."
    close = [] if is_known(head) else [label for label in similar(head, snapshot) if label != head]
    if close:
        return f"I know of no {text}. Did you mean {_ored(list(close))}?"
    labels = sorted({normal(node.label) for node in nodes_of(snapshot) if isinstance(node, ObjectNode)})
    known_things = f" Things I have seen: {', '.join(labels[:8])}." if labels else " I have not seen any objects yet."
    return f"I know of no {text}.{known_things}"


def described(node_id: str, snapshot: Snapshot) -> str:
    """A candidate without its article: "blue bottle on the table in the kitchen"."""
    return describe(node_id, snapshot).removeprefix("the ")


_PLACED = re.compile(r" (?:on|in|at|near|with) ")


def article(text: str) -> str:
    """With the indefinite article; names of rooms and people keep theirs, and *scissors on the bench* have none."""
    noun = _PLACED.split(text, maxsplit=1)[0].rsplit(" ", maxsplit=1)[-1]
    if noun in ALWAYS_PLURAL or is_plural(noun) or text[:1].isupper():
        return text
    return f"{'an' if text[:1].lower() in 'aeiou' else 'a'} {text}"


def _ored(options: Sequence[str]) -> str:
    if len(options) < 2:
        return "".join(options)
    return f"{', '.join(options[:-1])} or {options[-1]}"
