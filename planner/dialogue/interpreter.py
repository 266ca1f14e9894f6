"""The front end that needs no language model: text to a checked interpretation by grammar, grounding and verifier."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from planner.answers.reports import ABILITIES
from planner.dialogue.discourse import Discourse, Stuck
from planner.dialogue.follow_up import continued, place_asked
from planner.dialogue.meaning import Meaning, without_steps_between
from planner.dialogue.note_form import spelled_out
from planner.dialogue.replies import (
    Reading,
    did_you_mean,
    is_open,
    not_understood_reply,
    reply,
    reply_to_trouble,
    reply_when_stuck,
    unable_reply,
)
from planner.dialogue.revision import Reviser, Revision, is_place, repair, restated, revision, thing_meant
from planner.dialogue.settings import DialogueSettings
from planner.grounding.context import Context
from planner.grounding.grounding import Grounding
from planner.grounding.matching import nouns_of
from planner.language.grammar.parser import (
    Background,
    CommandGrammar,
    NotUnderstood,
    ParsedStep,
    Unable,
    Understood,
    flattened,
)
from planner.language.grammar.syntax import Ask, Perhaps, Wanted
from planner.language.lexicon.lexicon import Lexicon
from planner.language.lexicon.vocabulary import normal
from planner.language.sentences.tokens import text_flaw
from planner.naming import listed, name_of
from planner.plan import Dialogue, Exchange, Interpretation, Kind
from planner.skill_planner.flaws import shut_doors
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import ObjectNode, PersonNode
from scene_graph.snapshot import Snapshot
from skills.skill import Skill

Choices = dict[str, tuple[str, ...]]
_PLEASE = re.compile(
    r"\b(?:please|pls|plz|asap|pronto|at once|right away|immediately|(?:as )?(?:quick|fast)(?:ly)? as you can|now|quick"
    r"|hurry|chop chop)\b|^(?:hey|oi|oy|yo|you|robot|majordomo)\b"
)
"""Shows that what has no verb is a request."""
DOUBT = "did you mean"
"""The phrase that is settled by *yes*."""


class Interpreter:
    """Interprets requests on a graph. Pure: the same text, graph and dialogue give the same interpretation."""

    def __init__(
        self, grammar: CommandGrammar, verifier: Verifier, settings: DialogueSettings = DialogueSettings()
    ) -> None:
        self._grammar, self._verifier, self.settings = grammar, verifier, settings
        self._verbs = door_verbs(verifier.skills)
        self._lexicon: tuple[Snapshot, Lexicon] | None = None
        self._grounding: tuple[Snapshot, Grounding] | None = None

    def read(
        self,
        text: str,
        snapshot: Snapshot,
        dialogue: Dialogue,
        choices: Choices | None = None,
        *,
        verbless: bool = True,
    ) -> Reading:
        """What ``text`` means; ``choices`` settles phrases that were asked about before; ``verbless`` as in _whole."""
        flaw = text_flaw(text)
        if flaw is not None:
            return reply(Kind.REFUSE, flaw)
        about = revision(text, self.settings)
        if about is not None and dialogue.earlier:
            revised = self._revised(about, snapshot, dialogue, choices or {})
            if revised is not None:
                return revised
        slip = repair(text, self.settings)
        if slip is not None:
            repaired = self._repaired(*slip, snapshot, dialogue, choices or {})
            if repaired is not None:
                return repaired
        return self._whole(text, snapshot, dialogue, choices, verbless=verbless)

    def _whole(
        self,
        text: str,
        snapshot: Snapshot,
        dialogue: Dialogue,
        choices: Choices | None = None,
        *,
        verbless: bool = True,
    ) -> Reading:
        """What ``text`` means when it is no remark about something said before.

        ``verbless``: *the cup on the desk* may be a request; after *no, …* it only says which cup.
        """
        steps = self._grammar.parse(text, self.lexicon(snapshot))
        if not verbless and not steps:
            return reply(Kind.CLARIFY, "Can you say it differently?", wholly=False)
        if not verbless and any(_is_verbless(step) for step in steps):
            return reply(Kind.CLARIFY, not_understood_reply(list(flattened(steps))), wholly=False)
        if not steps:
            return reply(Kind.ANSWER, f"What can I do for you? {ABILITIES}")
        every = list(flattened(steps))
        unable = [step for step in every if isinstance(step, Unable)]
        if unable:
            return reply(Kind.REFUSE, unable_reply(unable, len(every)))
        if any(isinstance(step, NotUnderstood) or is_open(step) for step in every):
            return reply(Kind.CLARIFY, not_understood_reply(every), wholly=False)
        choices = dict(choices or {})
        asked = [step for step in steps if not isinstance(step, Background)]
        if _PLEASE.search(text.casefold()) and all(map(_is_wish, asked)):
            choices[DOUBT] = (DOUBT,)
        return self._ground(steps, snapshot, dialogue, choices)

    def grounding(self, snapshot: Snapshot) -> Grounding:
        """References on ``snapshot``; those of the last graph asked for are kept."""
        if self._grounding is None or self._grounding[0] is not snapshot:
            self._grounding = (
                snapshot,
                Grounding(snapshot, self._verifier.state(snapshot), settings=self.settings.grounding),
            )
        return self._grounding[1]

    def lexicon(self, snapshot: Snapshot) -> Lexicon:
        """Nouns and names of the graph; those of the last graph asked for are kept."""
        if self._lexicon is None or self._lexicon[0] is not snapshot:
            names = [person.name for person in snapshot.of_type(PersonNode) if person.name]
            things = snapshot.of_type(ObjectNode)
            colors = {color for thing in things for color in (thing.color, *thing.accents) if color}
            self._lexicon = (snapshot, Lexicon.of(nouns_of(snapshot), names, self._verbs, colors))
        return self._lexicon[1]

    def _revised(self, about: Revision, snapshot: Snapshot, dialogue: Dialogue, choices: Choices) -> Reading | None:
        """A remark about the request before, if it is one; a whole request is read as such."""
        earlier, lexicon = dialogue.earlier[0], self.lexicon(snapshot)
        if not earlier.goals:
            again = self._asked_again(earlier.request, about.rest, snapshot, dialogue, choices)
            if again is not None:
                return again
            return self.read(about.rest, snapshot, replace(dialogue, earlier=())) if about.how == "correct" else None
        about = replace(about, rest=thing_meant(about.rest))
        reviser = Reviser(self.grounding(snapshot), _context(dialogue, choices, snapshot), self.settings)
        if about.how == "again":
            return self.checked([reviser.again(earlier)], snapshot, choices)
        phrases = self._grammar.phrase(about.rest, lexicon) or self._grammar.phrase(f"the {about.rest} one", lexicon)
        outcome = reviser.by_phrase(about.how, phrases, earlier)
        if outcome is None and about.how == "correct":
            steps = self._grammar.parse(f"put it {about.rest}", lexicon)
            understood = steps[0] if len(steps) == 1 and isinstance(steps[0], Understood) else None
            outcome = reviser.by_place(understood.readings, earlier) if understood is not None else None
        if outcome is None:
            alone = self._whole(about.rest, snapshot, dialogue, choices)
            if _settled(alone):
                return alone
            if about.how != "correct":
                verb = earlier.request.split(maxsplit=1)[0]  # *bring Ben the remote* | *and Anna the newspaper*
                same = self._whole(f"{verb} {about.rest}", snapshot, dialogue, choices)
                return same if same.interpretation.kind is Kind.PLAN else alone
            return self._restated(earlier.request, about.rest, snapshot, dialogue, choices) or alone
        return self.checked([outcome], snapshot, choices) if isinstance(outcome, Meaning) else reply_to_trouble(outcome)

    def _asked_again(
        self, request: str, rest: str, snapshot: Snapshot, dialogue: Dialogue, choices: Choices
    ) -> Reading | None:
        """The question before about something else: *and the book?*; None if there was none, or no such thing."""
        steps = self._grammar.parse(request, self.lexicon(snapshot))
        asked = steps[0].readings if len(steps) == 1 and isinstance(steps[0], Understood) else ()
        relation, words = place_asked(rest)
        phrases = self._grammar.phrase(words, self.lexicon(snapshot))
        readings = continued([r for r in asked if isinstance(r, Ask)], phrases, as_place=bool(relation))
        return (
            self._ground([Understood(text=rest, readings=readings)], snapshot, dialogue, choices) if readings else None
        )

    def _repaired(
        self, said: str, rest: str, snapshot: Snapshot, dialogue: Dialogue, choices: Choices
    ) -> Reading | None:
        """A request that corrects itself: as two requests, else with its end replaced; None if neither makes sense."""
        place, _, why = rest.partition(", ")
        if is_place(place) and why:  # *to Victor, Leo might hurt himself*
            return self._restated(said, place, snapshot, dialogue, choices)
        first = self._whole(said, snapshot, dialogue, choices).interpretation
        if first.kind is Kind.PLAN:
            earlier = Exchange(request=said, goals=first.goals, status="", explanation="")
            again = replace(
                dialogue, earlier=(earlier, *dialogue.earlier), mentioned=(*first.mentioned, *dialogue.mentioned)
            )
            revised = self._revised(Revision(how="correct", rest=rest), snapshot, again, choices)
            return revised if revised is not None and _settled(revised) else None
        if not is_place(rest):  # *to the office* is where something goes, and no request of its own
            spoken = replace(dialogue, mentioned=(*first.mentioned, *dialogue.mentioned))
            alone = self._whole(rest, snapshot, spoken, choices, verbless=False)
            asked = first.kind is not Kind.CLARIFY or first.mentioned
            if alone.interpretation.kind is Kind.PLAN or (asked and alone.interpretation.kind is Kind.ANSWER):
                return alone
        return self._restated(said, rest, snapshot, dialogue, choices)

    def _restated(
        self, said: str, rest: str, snapshot: Snapshot, dialogue: Dialogue, choices: Choices
    ) -> Reading | None:
        for wording in restated(said, rest, self.settings):
            reading = self._whole(wording, snapshot, dialogue, choices)
            asked = reading.interpretation.kind is Kind.ANSWER and reading.interpretation.query is not None
            if reading.interpretation.kind is Kind.PLAN or asked:
                return reading
        return None

    def _ground(self, steps: Sequence[ParsedStep], snapshot: Snapshot, dialogue: Dialogue, choices: Choices) -> Reading:
        context = _context(dialogue, choices, snapshot)
        steps = spelled_out(steps, self.grounding(snapshot), context)
        meanings = Discourse(self.grounding(snapshot), context, self.settings).meanings(steps)
        if isinstance(meanings, Stuck):
            return reply_when_stuck(meanings, steps)
        return self.checked(meanings, snapshot, choices)

    def checked(self, meanings: list[Meaning], snapshot: Snapshot, choices: Choices) -> Reading:
        """What steps mean together, if the verifier finds no flaw; what was not said as a request is asked about."""
        found = self._checked(meanings, snapshot)
        if meanings and all(meant.told for meant in meanings):
            said = listed([name_of(i, snapshot) for meant in meanings for i in meant.things or meant.places])
            return reply(Kind.CLARIFY, f"What shall I do with {said}?")
        doubtful = found.kind is Kind.PLAN or found.lessons
        if doubtful and any(meant.doubt for meant in meanings) and DOUBT not in choices:
            asked = Interpretation(kind=Kind.CLARIFY, reply=did_you_mean(found, snapshot), mentioned=found.mentioned)
            return Reading(interpretation=asked, asked=DOUBT)
        return Reading(interpretation=found)

    def _checked(self, meanings: list[Meaning], snapshot: Snapshot) -> Interpretation:
        goals = without_steps_between(meanings, self._verifier.state(snapshot))
        answers = " ".join([*(meant.answer for meant in meanings if meant.answer), *_waiting(meanings)])
        mentioned = tuple(dict.fromkeys(i for meant in reversed(meanings) for i in (*meant.things, *meant.places)))
        queries = [meant.query for meant in meanings if meant.query is not None]
        lessons = tuple(lesson for meant in meanings for lesson in meant.lessons)
        if not goals:
            query = queries[0] if queries else None
            return Interpretation(kind=Kind.ANSWER, reply=answers, query=query, mentioned=mentioned, lessons=lessons)
        flaws = self._verifier.verify_goals(goals, snapshot)
        if flaws:
            reasons = " ".join(flaw.message[:1].upper() + flaw.message[1:] for flaw in flaws[:3])
            closed = shut_doors(flaws, snapshot)
            return Interpretation(kind=Kind.REFUSE, reply=reasons, mentioned=mentioned, closed=closed)
        return Interpretation(kind=Kind.PLAN, goals=goals, reply=answers, mentioned=mentioned, lessons=lessons)


def door_verbs(skills: Mapping[str, Skill]) -> frozenset[str]:
    """What people say for skills of installed packages that take a door: *open*, of ``open {door}``."""
    found = {
        phrase.partition(" {")[0]
        for skill in skills.values()
        if len(skill.parameters) == 1 and "door" in skill.parameters[0].kinds
        for phrase in getattr(skill, "phrases", ())
    }
    return frozenset(verb for verb in found if verb.isalpha())


def _waiting(meanings: Sequence[Meaning]) -> list[str]:
    """What is said of *wait there*: it is done at the end, and declined between other things."""
    told = [meant.waiting for meant in meanings if meant.waiting]
    last = bool(meanings) and bool(meanings[-1].waiting)
    return [*(["I do not wait in between."] if told[: -1 if last else None] else []), *(told[-1:] if last else [])]


def _settled(reading: Reading) -> bool:
    """Whether every word was understood, and something is to be done, asked or said of it."""
    return reading.wholly and reading.interpretation.kind is not Kind.REFUSE


def _is_wish(step: ParsedStep) -> bool:
    """Whether a step is a request only by the *please* with it: *the bathroom, please*, *two cans here, please*."""
    return isinstance(step, Understood) and all(
        isinstance(reading, Wanted) or (isinstance(reading, Perhaps) and not reading.verbless)
        for reading in step.readings
    )


def _is_verbless(step: ParsedStep) -> bool:
    return isinstance(step, Understood) and all(
        isinstance(reading, Wanted) or (isinstance(reading, Perhaps) and reading.verbless and not reading.sure)
        for reading in step.readings
    )


def _context(dialogue: Dialogue, choices: Choices, snapshot: Snapshot) -> Context:
    spoken = [node for i in dialogue.mentioned if isinstance(node := snapshot.get(i), ObjectNode)]
    return Context(
        noun=normal(spoken[0].label) if spoken else "",
        speaker=dialogue.speaker,
        mentioned=dialogue.mentioned,
        choices=choices,
        origins=dialogue.origins,
        earlier=dialogue.earlier,
        last=dialogue.last,
        displaced=dialogue.displaced,
    )
