"""From a sentence to its steps: what comes first, what depends on what, what is left unsaid and what is forbidden."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from planner.language.lexicon.terminals import ACTING, RELATING, Terminal
from planner.language.sentences.asides import apart
from planner.language.sentences.background import is_told
from planner.language.sentences.inquiry import plainly
from planner.language.sentences.lexer import asks, clauses, trimmed

Tokens = Sequence[Terminal]
Parses = Callable[[str, Tokens], bool]
"""Whether the grammar reads these terminals as a ``command``, a ``question`` or a ``condition``."""

_IF = frozenset({"WHETHER", "UNLESS", "PROVIDED"})
_RECIPIENTS = frozenset({"ME", "HIM", "NAME"})


@dataclass(frozen=True, kw_only=True)
class Clause:
    """One step, by its terminals; ``elliptic``: its verb is that of the step before."""

    tokens: tuple[Terminal, ...]
    elliptic: bool = False


@dataclass(frozen=True, kw_only=True)
class Forbidden:
    """What is not to be done: *do not bring the apple*."""

    tokens: tuple[Terminal, ...]


@dataclass(frozen=True, kw_only=True)
class Fork:
    """*If the door is open, go to the kitchen, otherwise come back.*

    ``condition`` empty: ``otherwise`` is for when ``then`` has no referent. ``negated``: *unless*.
    """

    condition: tuple[Terminal, ...]
    negated: bool = False
    then: tuple[Part, ...] = ()
    otherwise: tuple[Part, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Unclear:
    """Terminals whose order or condition cannot be made out."""

    tokens: tuple[Terminal, ...]


Part = Clause | Forbidden | Fork | Unclear


@dataclass
class Structure:
    """Takes the sentences of a request apart, one after the other."""

    parses: Parses
    parts: list[Part] = field(default_factory=list)

    def add(self, sentence: Tokens) -> None:
        """Append the parts of the next sentence; *if so* and *otherwise* at its start belong to the one before."""
        first, rest = sentence[0].type, trimmed(sentence[1:])
        before = self.parts[-1] if self.parts else None
        if first == "OTHERWISE" and isinstance(before, Clause) and asks(before.tokens):
            first = "IF_NOT" if self._is_condition(before.tokens) else first
        if first in ("IF_SO", "IF_NOT") and isinstance(before, Clause) and self._is_condition(before.tokens):
            then, otherwise = self._cut(rest, ("OTHERWISE", "IF_NOT"))
            self.parts[-1] = Fork(
                condition=before.tokens,
                negated=first == "IF_NOT",
                then=self._inner(then),
                otherwise=self._inner(otherwise),
            )
        elif first in ("OTHERWISE", "IF_NOT") and isinstance(before, Fork) and not before.otherwise:
            done = before.then[-1].tokens if before.then and isinstance(before.then[-1], Clause) else ()
            instead = self._inner(self._with_verb(rest, done))
            self.parts[-1] = Fork(
                condition=before.condition,
                negated=before.negated,
                then=before.then,
                otherwise=instead,
            )
        elif first in ("OTHERWISE", "IF_NOT") and isinstance(before, Clause):
            instead = self._inner(self._with_verb(rest, before.tokens))
            self.parts[-1] = Fork(condition=(), then=(before,), otherwise=instead)
        elif first == "BUT_FIRST" and before is not None:
            self.parts[-1:] = [*self._inner(rest), before]
        else:
            self.parts += self._of(sentence)

    def _inner(self, tokens: Tokens) -> tuple[Part, ...]:
        inner = Structure(self.parses)
        if tokens:
            inner.parts = inner._of(tokens)
        return tuple(inner.parts)

    def _of(self, sentence: Tokens) -> list[Part]:
        plain = [] if self._asks(sentence) else plainly(sentence, self.parses)
        if plain:
            return [Clause(tokens=tuple(plain))]
        main, alternative = self._cut(sentence, ("OTHERWISE", "IF_NOT"))
        if alternative or main != trimmed(sentence):
            return [self._fork(main, alternative)] if main and alternative else [Unclear(tokens=tuple(sentence))]
        late, soon = self._cut(sentence, ("BUT_FIRST",))
        if soon and late:
            return [*self._of(soon), *self._of(late)]
        if any(token.type in ("IF_SO", "IF_NOT") for token in sentence):
            return [Unclear(tokens=tuple(sentence))]
        if self._asks(sentence):
            return self._steps(sentence)
        told = self._told_first(sentence)
        if told:
            return [Clause(tokens=tuple(sentence[:told])), *self._of(trimmed(sentence[told:]))]
        again = _second_if(sentence)
        if again is not None:
            return [*self._of(trimmed(sentence[:again])), *self._of(sentence[again:])]
        for index, token in enumerate(sentence):
            if token.type in _IF and not _is_told(sentence, index):
                return [self._fork(sentence, ())]
            if token.type in ("BEFORE", "AFTER") or (token.type == "WHEN" and _is_done(sentence, index)):
                return self._ordered(sentence, index)
        return self._steps(sentence)

    def _told_first(self, sentence: Tokens) -> int:
        """How long what is only told is, that comes before a request with a condition; 0 if there is none."""
        first = clauses(sentence)[0]
        conditional = any(token.type in _IF for token in sentence[len(first) :])
        return len(first) if conditional and sentence[0].type not in _IF and self.parses("narrated", first) else 0

    def _asks(self, sentence: Tokens) -> bool:
        return sentence[0].type != "WHETHER" and asks(sentence) and self.parses("question", sentence)

    def _fork(self, main: Tokens, alternative: Tokens) -> Part:
        index = next((k for k, t in enumerate(main) if t.type in _IF and not _is_told(main, k)), None)
        otherwise = self._inner(self._with_verb(alternative, main))
        if index is None:
            then = tuple(self._steps(main))
            return Fork(condition=(), then=then, otherwise=otherwise) if len(then) == 1 else Unclear(tokens=tuple(main))
        negated = main[index].type == "UNLESS"
        if index > 0:
            condition, deeds = trimmed(main[index + 1 :]), self._steps(main[:index])
            if len(deeds) != 1 or not self._is_condition(condition):
                return Unclear(tokens=tuple(main))
            return Fork(condition=tuple(condition), negated=negated, then=tuple(deeds), otherwise=otherwise)
        for split in range(2, len(main)):
            if main[split].type in ("COMMA", "THEN") or main[split].type in ACTING or _is_forbidding(main[split:]):
                condition, rest = trimmed(main[1:split]), trimmed(main[split:])
                if rest and self._is_condition(condition):
                    return Fork(
                        condition=tuple(condition),
                        negated=negated,
                        then=self._inner(rest),
                        otherwise=otherwise,
                    )
        return Unclear(tokens=tuple(main))

    def _with_verb(self, alternative: Tokens, main: Tokens) -> Tokens:
        """*Bring me the red cup if it is there, otherwise the blue one*: the verb is that of the main part."""
        verb = next((_verb_of(main[k:]) for k, token in enumerate(main) if token.type in ACTING), [])
        return self._completed(list(alternative), verb) if alternative else alternative

    def _ordered(self, sentence: Tokens, index: int) -> list[Part]:
        """*Before you go, bring it*; *go after you have brought it*: in the order of doing."""
        before = sentence[index].type == "BEFORE"
        if index > 0:
            one, other = trimmed(sentence[:index]), trimmed(sentence[index + 1 :])
            if before and one and is_told(other):
                return [*self._of(one), Clause(tokens=tuple(other))]
            if not self._is_command(other):
                return [Unclear(tokens=tuple(sentence[index:]))]
            return [*self._of(one), *self._of(other)] if before else [*self._of(other), *self._of(one)]
        for split in range(2, len(sentence)):
            if sentence[split].type in ("COMMA", "THEN") or sentence[split].type in ACTING:
                inner, rest = trimmed(sentence[1:split]), trimmed(sentence[split:])
                if rest and self._is_command(inner):
                    return [*self._of(rest), *self._of(inner)] if before else [*self._of(inner), *self._of(rest)]
        return [Unclear(tokens=tuple(sentence))]

    def _steps(self, sentence: Tokens) -> list[Part]:
        found: list[Part] = []
        verb: list[Terminal] = []
        for step in clauses(sentence):
            if _is_forbidding(step):
                found.append(Forbidden(tokens=tuple(step)))
                continue
            if verb and verb[0].type in _CARRYING and _is_leaving(step):
                found.append(Forbidden(tokens=(_MOVE, *step[1:])))
                continue
            going = not self.parts or _goes(self.parts[-1])
            whither = step[0].type in ("TO", "INTO") and not (verb or found) and going
            asked = [] if not asks(step) or self.parses("question", step) else plainly(step, self.parses)
            if asked:
                found.append(Clause(tokens=tuple(asked)))
                continue
            full = [_GO, *step] if whither else self._completed(step, verb)
            elliptic = bool(found) and not whither and len(full) > len(step)
            verb = _verb_of(full) or verb
            found += self._parted(full, verb, elliptic=elliptic)
        return found

    def _parted(self, step: list[Terminal], verb: list[Terminal], *, elliptic: bool) -> list[Clause]:
        """*Cups in the sink, books on the shelf*: steps that no verb tells apart, each of which makes sense."""
        whole = [Clause(tokens=tuple(step), elliptic=elliptic)]
        if asks(step) or self.parses("command", step) or self.parses("narrated", step):
            return whole
        if not RELATING & {token.type for token in step} and self.parses("topic", step):
            return whole
        if told := apart(step, self.parses):
            return [Clause(tokens=tuple(part)) for part in told]
        for index, token in enumerate(step):
            if index == 0 or not (token.type in ("COMMA", "AND") or token.type in ACTING):
                continue
            first = Clause(tokens=tuple(step[:index]), elliptic=elliptic)
            if token.type == "COMMA" and is_told(step[:index]) and self.parses("command", trimmed(step[index:])):
                return [first, Clause(tokens=tuple(trimmed(step[index:])))]
            if not (self.parses("command", step[:index]) or self.parses("topic", step[:index])):
                continue
            if token.type == "COMMA" and is_told(trimmed(step[index:])):
                return [first, Clause(tokens=tuple(trimmed(step[index:])))]
            said = trimmed(step[index:])
            rest = self._completed(said, verb)
            parts = self._parted(rest, verb, elliptic=len(rest) > len(said)) if rest else []
            if parts and all(self.parses("command", part.tokens) for part in parts):
                return [first, *parts]
        return whole

    def _completed(self, step: list[Terminal], verb: list[Terminal]) -> list[Terminal]:
        """*Go to the kitchen, then to the office*: a step without a verb has the one before it."""
        if not verb or step[0].type in ACTING or asks(step) or self.parses("deed", step):
            return step
        recipients = (verb, verb[:1]) if len(verb) > 1 else (verb, [*verb, _TO])
        return next(([*lead, *step] for lead in recipients if self.parses("deed", [*lead, *step])), step)

    def _is_condition(self, tokens: Tokens) -> bool:
        return bool(tokens) and self.parses("condition", tokens)

    def _is_command(self, tokens: Tokens) -> bool:
        return bool(tokens) and tokens[0].type in ACTING and self.parses("command", tokens)

    def _cut(self, tokens: Tokens, kinds: Sequence[str]) -> tuple[list[Terminal], list[Terminal]]:
        """What stands before and after the first terminal of ``kinds``."""
        index = next((k for k, token in enumerate(tokens) if token.type in kinds), None)
        if index is None:
            return trimmed(tokens), []
        return trimmed(tokens[:index]), trimmed(tokens[index + 1 :])


_GO, _TO, _MOVE = Terminal("GO", "go", "go"), Terminal("TO", "to", "to"), Terminal("MOVE", "move", "leave")
_GOING = frozenset({"GO", "VISIT", "COME", "FIND"})
_CARRYING = frozenset({"BRING", "GET", "TAKE", "CARRY", "MOVE", "RETURN", "GIVE", "PUT", "WANT"})


def _second_if(sentence: Tokens) -> int | None:
    """Where the second condition begins: *if it is red, take it to Ben, if it is green, to Anna*."""
    if sentence[0].type not in _IF:
        return None
    breaks = ("COMMA", "AND", "THEN")
    return next(
        (k for k in range(3, len(sentence)) if sentence[k].type in _IF and sentence[k - 1].type in breaks),
        None,
    )


def _goes(part: Part) -> bool:
    return isinstance(part, Clause) and part.tokens[0].type == "GO"


def _is_told(sentence: Tokens, index: int) -> bool:
    """Whether *if* at ``index`` only introduces a question: *tell me if*, *do you know if*."""
    if index == 0 or sentence[index].type != "WHETHER":
        return False
    lead = ("TELL", "SEE", "UNABLE", "COMMA")
    return sentence[index - 1].type in lead and sentence[0].type in ("TELL", "CAN_YOU", "UNABLE")


def _is_done(sentence: Tokens, index: int) -> bool:
    """Whether *when* means *once*: *when you have brought it*."""
    return index + 1 < len(sentence) and sentence[index + 1].type in ACTING


def _is_forbidding(step: Tokens) -> bool:
    kinds = [token.type for token in step[:3]]
    return kinds[:1] == ["NOT"] or kinds[:2] == ["DO", "NOT"]


def _is_leaving(step: Tokens) -> bool:
    """Whether a step after one that carries names what is to stay: *bring me the cup and leave the book*."""
    places = RELATING | {"INTO", "ONTO", "TO", "FLOOR", "FOR", "IT", "WHERE"}
    return step[0].typed == "leave" and len(step) > 1 and not places & {token.type for token in step}


def _verb_of(step: Tokens) -> list[Terminal]:
    """The verb of a command, with the recipient that follows one of giving."""
    if not step or step[0].type not in ACTING:
        return []
    given = len(step) > 1 and step[1].type in _RECIPIENTS and step[0].type not in _GOING
    return list(step[: 2 if given else 1])
