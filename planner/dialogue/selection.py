"""Answers to the robot's questions: which of the candidates a person chose."""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner.dialogue.disambiguation import the_one_described
from planner.dialogue.interpreter import Interpreter
from planner.grounding.context import Context
from planner.language.grammar.parser import CommandGrammar
from planner.language.grammar.syntax import Quantity
from planner.language.sentences.tokens import words_of
from scene_graph.snapshot import Snapshot

_ORDINALS = {
    "former": 0,
    "1st": 0,
    "2nd": 1,
    "3rd": 2,
    "first": 0,
    "1": 0,
    "second": 1,
    "2": 1,
    "third": 2,
    "3": 2,
    "fourth": 3,
    "4": 3,
    "fifth": 4,
    "5": 4,
}
_ALL = {"all", "both", "all of them", "both of them", "everything", "every one"}
_ANY = {
    "any",
    "any of them",
    "either",
    "whichever",
    "does not matter",
    "it does not matter",
    "any one",
    "you choose",
    "either one",
    "either of them",
    "either will do",
    "any will do",
    "whichever one",
    "whatever",
    "whatever one",
    "i do not care",
    "i do not mind",
    "do not care",
    "do not mind",
    "no preference",
    "you pick",
    "you decide",
    "surprise me",
    "any one of them",
    "one of them",
    "it makes no difference",
}
_DROPPED = frozenset(
    {
        "you",
        "mentioned",
        "said",
        "named",
        "listed",
        "told",
        "me",
        "that",
        "please",
        "the",
        "one",
        "number",
        "take",
        "i",
        "mean",
        "meant",
        "bring",
        "option",
        "a",
        "an",
    }
)
_YES = {"yes", "yeah", "yep", "sure", "ok", "okay", "right", "correct", "exactly", "yes please", "please do", "do it",
        "that is right", "yes do it", "go ahead", "of course", "indeed", "yes that is right", "i did",
        "yes i did"}  # fmt: skip
_NO = {"no", "nope", "neither", "none", "none of them", "nothing", "no thanks", "neither of them", "never mind",
    "nevermind",
       "forget it", "do not", "none of those", "neither one", "no thank you", "not at all", "neither of those",
       "cancel",
       "none of these", "no one", "nothing thanks"}  # fmt: skip
NOTHING_THEN = "All right, I do nothing."
_LEFT_OUT = re.compile(
    r"^(?:(?:no|just|but|please|well|oh|h+m+|u+m+|u+h+|e+r+m?|ah|eh|definitely|certainly|surely|maybe|any(?:thing)?"
    r"|any one|all|whichever|the one)\b[\s,]*)*"
    r"(?:(?:that |which )?(?:is |it is |are )?(?:not|neither)(?! that)|isn't|it isn't|but|except(?: for)?|other than"
    r"|apart from|rather than)"
    r" (?P<what>[^,;.]+)(?:[\s,;]+(?:but )?(?:the|that) other(?: one)?)?[\s.!]*$"
)
_ANY_WILL_DO = re.compile(
    r"^(?:(?:(?:any|either|whichever|whatever)(?: one)?(?: of (?:them|those|these|the two))?"
    r"(?: (?:(?:is|are|would be|will be) (?:fine|ok|okay|good|all right|alright)|(?:will|would) do))?"
    r"|(?:it |that )?(?:really )?does not (?:really )?matter(?: which(?: one)?)?"
    r"|i (?:really )?do not (?:really )?(?:mind|care)(?: which(?: one)?)?|to me"
    r"|(?:just |you )*(?:pick|choose|take|grab|select) (?:one|any|either|whichever)(?: of them)?"
    r"|(?:you (?:can |may )?(?:choose|decide|pick)|your choice|up to you|it is up to you|as you (?:like|wish"
    r"|please)))(?: |$))+$"
)
_ADDED = re.compile(
    r"[\s,]+(?:of course,? what else|what else|who else|silly|dummy|you know|of course|obviously|naturally"
    r"|definitely|i (?:guess|think|suppose|mean)|please"
    r"|then|instead|if possible|thanks?)"
    r"(?=[\s.!]*$)"
)
_WHICHEVER = re.compile(
    r"^(?:whichever|the one that|the one which|that which)(?: one)? is (?:the )?(nearest"
    r"|closest|biggest|largest|smallest|nearer|closer|bigger|larger|smaller)\b(?: to (?:me|you|here))?"
)
_LIKED = re.compile(
    r"^(?:i think |i guess |maybe |perhaps |let us say |make it |let us take |go for |i (?:want"
    r"|would like|prefer|choose|pick|would prefer|will take|will have) |it is |that is )*"
    r"(?P<which>.+?)"
    r"(?:,? (?:would be|will be|is|would do|will do|sounds|seems|it is|i think|i guess|would suit me)"
    r"(?: (?:best|fine|good|great|better|nice|lovely|perfect|ok|okay|right|the one|my "
    r"(?:favou?rite|choice)|it|nicely|what i want|all right|alright|just fine))*)?[.! ]*$"
)
"""*The red one would be best*: which one, with the manner of choosing."""
_REASON = re.compile(
    r"^(?P<which>[^,;.]+)[,;.]+ (?:because |since |as )?(?:he|she|it|they|i|we) "
    r"(?:is|are|am|was|likes?|loves?|wants?|needs?|prefers?)\b[^,;.]*[.!]*$"
)
"""*The pink one, she likes these*: which one, and why."""
_STATED = re.compile(r"(?:i (?:think|guess) )?(?:(?:it|that|he|she|the \w+) )?(?:(?:is|should be)(?P<no> not)? ?)?"
                     r"(?P<state>open|closed)?(?: i think| yes)?")  # fmt: skip
_EITHER_OF = re.compile(r"\b(?:n?or|and)\b")


def agrees(answer: str) -> bool:
    """Whether an answer is *yes*."""
    return _said(answer) in _YES


def declines(answer: str) -> bool:
    """Whether an answer is *no*, *neither*, *never mind*."""
    return _said(answer) in _NO


def confirms(answer: str, asked: str) -> bool | None:
    """Whether an answer says that ``asked`` is so: *yes*, *it is not*, *open*; None when it says neither."""
    said = _said(answer).removeprefix("yes ").removeprefix("no ")
    found = _STATED.fullmatch(said)
    if found and found["state"]:
        same = found["state"] in asked.split()
        return same != bool(found["no"])
    return not found["no"] if found and said else True if said in _YES else False if said in _NO else None


def left_out(answer: str) -> tuple[str, ...]:
    """What an answer says it is not: *not the one in the box*, *neither the red nor the blue*; empty of others."""
    found = _LEFT_OUT.match(" ".join(answer.casefold().replace("’", "'").split()))
    return tuple(part for each in _EITHER_OF.split(found["what"]) if (part := each.strip())) if found else ()


def _said(answer: str) -> str:
    return " ".join(word.text for word in words_of(answer) if word.kind == "word" and word.text != "please")


def select(
    answer: str, candidates: Sequence[str], snapshot: Snapshot, interpreter: Interpreter, grammar: CommandGrammar
) -> tuple[str, ...]:
    """The candidates that ``answer`` chooses: by identifier, number, *both*, *any*, description; empty when unclear.

    What an answer leaves out is never chosen: one candidate must be left.
    """
    negated = left_out(answer)
    if negated:
        out = [select(part, candidates, snapshot, interpreter, grammar) for part in negated]
        rest = tuple(i for i in candidates if not any(i in some for some in out))
        return rest if len(rest) == 1 and all(out) else ()
    reasoned = _REASON.match(answer.casefold())
    answer = reasoned["which"] if reasoned else answer
    answer = _WHICHEVER.sub(r"the \1 one", _ADDED.sub("", answer.casefold()))
    liked = _LIKED.match(answer.casefold())
    if liked and liked["which"] != answer.casefold().strip(" .!"):
        chosen = _chosen(liked["which"], candidates, snapshot, interpreter, grammar)
        if chosen:
            return chosen
    chosen = _chosen(answer, candidates, snapshot, interpreter, grammar)
    known = tuple(i for i in candidates if i in snapshot)
    return chosen or the_one_described(answer, known, interpreter.lexicon(snapshot), interpreter.grounding(snapshot))


def _chosen(
    answer: str, candidates: Sequence[str], snapshot: Snapshot, interpreter: Interpreter, grammar: CommandGrammar
) -> tuple[str, ...]:
    """As ``select``, for an answer that leaves nothing out and gives no reason."""
    words = [word.text for word in words_of(answer) if word.kind == "word"]
    said = " ".join(words)
    if said in candidates:
        return (said,)
    if said in _ALL:
        return tuple(candidates)
    if said in _ANY or _ANY_WILL_DO.match(said):
        return tuple(candidates[:1])
    short = [word for word in words if word not in _DROPPED]
    if len(short) == 1 and short[0] in _ORDINALS and _ORDINALS[short[0]] < len(candidates):
        return (candidates[_ORDINALS[short[0]]],)
    if short in (["last"], ["latter"]):
        return tuple(candidates[-1:])
    return _described(said, tuple(i for i in candidates if i in snapshot), snapshot, interpreter, grammar)


def _described(
    said: str, candidates: Sequence[str], snapshot: Snapshot, interpreter: Interpreter, grammar: CommandGrammar
) -> tuple[str, ...]:
    """By noun phrase: *the blue one*, *blue*, *on the table*, *the one in the kitchen*, *anna*."""
    grounding = interpreter.grounding(snapshot)
    for wording in (said, f"{said} one", f"the one {said}", f"the one in {said}", f"the one on {said}"):
        for phrase in grammar.phrase(wording, interpreter.lexicon(snapshot)):
            fitting = grounding.matches(phrase, Context(noun=""))
            if phrase.words in (("one",), ("ones",)):
                fitting = grounding.among(candidates, phrase)
            chosen = tuple(i for i in candidates if i in fitting)
            if chosen and len(chosen) < len(candidates):
                return chosen[:1] if len(chosen) == 1 or phrase.quantity is Quantity.A else ()
    return ()
