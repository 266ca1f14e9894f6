"""What a person teaches in words: *this room is the office*, *that is my mug*, *my name is Ben*."""

from __future__ import annotations

from planner.dialogue.meaning import Meaning
from planner.grounding.context import Ambiguous, Context, Grounded, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.language.grammar.syntax import NounPhrase, Pronoun, Teach
from planner.language.lexicon.vocabulary import is_known, is_room_label, words_for
from planner.naming import name_of
from planner.plan import Lesson
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode


class Teaching:
    """Understands ``Teach`` steps on one graph."""

    def __init__(self, grounding: Grounding) -> None:
        self._grounding, self._snapshot = grounding, grounding.snapshot

    def of(self, step: Teach, context: Context) -> Meaning | Trouble:
        """The lesson, or a question about which node is meant and whether this is meant to be its name."""
        said = " ".join(step.words)
        found = self._target(step, said, context)
        if not isinstance(found, tuple):
            return found
        if len(found) != 1:
            return Ambiguous(question=f"Which one is to be called “{said}”?", phrase="", candidates=found)
        if not isinstance(self._snapshot.get(found[0]), RoomNode | ObjectNode | PersonNode):
            return NoReferent(reason=f"I can give names to rooms, things and people only, not to {said}.")
        lesson, reply = self._lesson(found[0], said, step)
        doubt = (not step.named and not is_known(said)) or self._is_remark(found[0], said, step, context)
        return Meaning(answer=reply, lessons=(lesson,), things=found, doubt=doubt)

    def _target(self, step: Teach, said: str, context: Context) -> Grounded:
        if isinstance(step.target, NounPhrase):
            place = step.target.words[-1] in ("room", "thing", "object")
            resolve = self._grounding.place if place else self._grounding.things
            return resolve(step.target, context)
        if isinstance(step.target, Pronoun) and step.target.word == "me":
            return self._grounding.speaker(context)
        spoken = [i for i in context.fresh if isinstance(self._snapshot.get(i), RoomNode)]
        if isinstance(step.target, Pronoun) and step.target.word == "that" and len(spoken) == 1:
            return tuple(spoken)
        here = self._snapshot.current_room
        if is_room_label(said) or (step.named and not step.mine and not is_known(said) and self._says_this(step)):
            return (here,) if here is not None else NoReferent(reason="I do not know which room I am in.")
        objects = [i for i in (self._grounding.state.holding, *context.fresh) if i is not None]
        if len(set(objects)) == 1:
            return tuple(objects[:1])
        if spoken_of := self._spoken_of_last(said, context):
            return spoken_of
        return NoReferent(reason=f"I do not see what you point at. Tell me which thing is “{said}”.", asks=True)

    def _spoken_of_last(self, said: str, context: Context) -> tuple[str, ...]:
        """The one thing that the request before moved; else the last one spoken of that is what it is said to be."""
        goals = context.earlier[0].goals if context.earlier else ()
        moved = {goal.object_id for goal in goals if goal.object_id is not None}
        objects = [i for i in context.mentioned if isinstance(self._snapshot.get(i), ObjectNode)]
        spoken = [i for i in objects if i in moved] if len(moved) == 1 else []
        return tuple(spoken or [i for i in objects if self._is_sort(i, said)])[:1]

    def _is_sort(self, node_id: str, said: str) -> bool:
        """Whether a thing is what the last word of its name says: a cup called *my mug*."""
        node = self._snapshot.get(node_id)
        sorts = words_for(said.rpartition(" ")[2])
        return isinstance(node, ObjectNode) and bool(sorts & words_for(node.label or ""))

    def _is_remark(self, node_id: str, said: str, step: Teach, context: Context) -> bool:
        """*That is the wrong cup*, of what was brought: it may be a name, or only said about the thing."""
        if not isinstance(step.target, Pronoun) or not isinstance(self._snapshot.get(node_id), ObjectNode):
            return False
        if step.called or node_id in (self._grounding.state.holding, *context.fresh):
            return False
        owned = step.mine or step.words[0].endswith("'s")
        return not (owned and self._is_sort(node_id, said))

    def _says_this(self, step: Teach) -> bool:
        return isinstance(step.target, Pronoun) and step.target.word == "this"

    def _lesson(self, node_id: str, said: str, step: Teach) -> tuple[Lesson, str]:
        node, name = self._snapshot.node(node_id), name_of(node_id, self._snapshot)
        match node:
            case RoomNode():
                return Lesson(node=node_id, label=said), f"From now on {self._room(node_id)} is the {said}."
            case ObjectNode() if not step.mine and (not step.named or is_known(said)):
                return Lesson(node=node_id, label=said), f"From now on {name} is a {said} to me."
            case ObjectNode():
                called = f"my {said}" if step.mine else said
                return Lesson(node=node_id, name=called), f"From now on {name} is “{called}”."
            case PersonNode():
                return Lesson(node=node_id, name=said.title()), f"From now on I call {name} {said.title()}."
            case _:
                return Lesson(node=node_id, label=said), f"From now on {name} is “{said}”."

    def _room(self, node_id: str) -> str:
        """A room without its identifier; the one that the robot is in as *this room*."""
        named = bool(self._snapshot.room(node_id).label)
        return "this room" if node_id == self._snapshot.current_room or not named else name_of(node_id, self._snapshot)
