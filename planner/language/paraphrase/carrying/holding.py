"""Ways of asking the robot to hold something: *take it in your hand and keep hold of it*."""

from __future__ import annotations

_HAND = r"your (?:\w+ )?(?:hands?|grippers?|claws?|fingers|arms?|fists?|grips?|pincers?)"
_KEEP = (
    r"(?:keep (?:hold of|holding|a (?:firm |tight )?(?:hold|grip) (?:of|on)|it in your "
    r"\w+)|hold(?: on to| onto| tight| on)?|"
    r"hang on to|do not (?:drop|let go of|put down))"
)

HOLDING: tuple[tuple[str, str], ...] = (
    (
        r"\bhold ([^,.;]+?) for (?:me|us)(?: please| now| a (?:second|moment|minute|bit|while))*(?=[.!]*$)",
        r"pick up \1",
    ),
    (
        (
            rf"(?:(?<=^)|(?<=[.,;!] )|(?<=\band )|(?<=\bthen )|(?<=\bplease )|(?<=\byou )|(?<=\bto ))"
            rf"(?:take|get|hold|put|keep|grab|pick up|grip|carry) (?!.* (?:to|and) )([^,.;!]+?)"
            rf" (?:in|into|with|between) {_HAND}"
        ),
        r"pick up \1",
    ),
    (
        (
            rf"\b(?:take|pick up|grab|lift|hold|get|grasp) ([^,.;!]+?)(?:,| and)+ (?:then "
            rf")?(?:please )?{_KEEP}(?: (?:it|them|that|"
            rf"the \w+))?(?: (?:until|till|for|while|tight|firmly|there|up|please|in your hand)\b[^.;!]*)?(?=[.!]*$)"
        ),
        r"pick up \1",
    ),
    (r"\b(?:grab|catch|lay|seize|take|get)(?: a)? hold of ", "pick up "),
    (
        (
            r"\b(?:pick up|grab|hold|lift|take) ([^,.;!]+?) (?:until|till) (?:i|we|you)"
            r" (?:tell|say|come|need|ask|am|get|call|give|"
            r"hear)\b[^.;!]*(?=[.!]*$)"
        ),
        r"pick up \1",
    ),
)
"""In the order in which they are tried."""
