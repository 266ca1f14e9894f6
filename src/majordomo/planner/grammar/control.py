"""Words that act before anything else is thought about: stop, wait, go on, cancel."""

from __future__ import annotations

from enum import StrEnum

from majordomo.planner.grammar.tokens import words_of


class Control(StrEnum):
    """Closed set of control words."""

    STOP = "stop"
    PAUSE = "pause"
    RESUME = "resume"
    CANCEL = "cancel"


_PHRASES: dict[Control, tuple[str, ...]] = {
    Control.STOP: (
        "stop", "halt", "freeze", "emergency stop", "stop now", "stop it", "stop moving", "stop immediately",
        "stop right there", "do not move", "do not move any more", "stand still", "stop there", "stop that",
        "stop what you are doing",
    ),
    Control.PAUSE: ("wait", "pause", "hold on", "hang on", "wait a moment", "wait a second", "wait a minute",
    "one moment",
                    "hold it", "wait there", "wait here", "just a moment", "just a second"),
    Control.RESUME: ("resume", "go on", "continue", "carry on", "proceed", "keep going", "you can go on", "go ahead",
                     "you may continue", "you can continue", "unpause"),
    Control.CANCEL: ("cancel", "abort", "never mind", "nevermind", "forget it", "cancel that", "cancel it",
        "abort it",
                     "cancel the task", "abort the task", "leave it", "cancel the job", "cancel the order",
                     "cancel the request", "cancel the mission", "cancel my request",
                     "cancel everything", "cancel all", "cancel my last request", "abort the mission",
                     "abort mission",
                     "scratch that", "call it off", "leave it be", "cancel this", "forget about it", "drop it",
                     "drop the whole thing", "forget the whole thing", "cancel the whole thing"),
}  # fmt: skip
_COURTESY = frozenset(
    {
        "please",
        "robot",
        "whoa",
        "woah",
        "yo",
        "quick",
        "quickly",
        "sorry",
        "you",
        "can",
        "could",
        "majordomo",
        "butler",
        "now",
        "ok",
        "okay",
        "hey",
        "no",
        "oh",
        "immediately",
    }
)
_VAGUE = frozenset({"right", "a", "second", "moment", "minute", "sec", "just", "for", "at", "once", "bit",
    "everything",
                    "thanks", "then", "so", "well"})  # fmt: skip
"""Adds nothing after a control word, as in *hold on a second*."""
_MEANING = {phrase: control for control, phrases in _PHRASES.items() for phrase in phrases}
MAX_CHARACTERS = 200


def control_word(text: str) -> Control | None:
    """The control that the whole of ``text`` is, courtesy and repetition aside; None for anything else.

    *stop*, *Stop! Stop!*, *please wait* are controls. *stop at the kitchen* is not: it says more than the word does.
    """
    if len(text) > MAX_CHARACTERS:
        return None
    words = [word.text for word in words_of(text) if word.kind == "word" and word.text not in _COURTESY]
    return _one_control(words) or _one_control([word for word in words if word not in _VAGUE])


def _one_control(words: list[str]) -> Control | None:
    """The control that every part of ``words`` stands for: *stop, stop*, or *drop it, cancel the job*."""
    for length in range(len(words), 0, -1):
        control = _MEANING.get(" ".join(words[:length]))
        if control is not None and (length == len(words) or _one_control(words[length:]) is control):
            return control
    return None
