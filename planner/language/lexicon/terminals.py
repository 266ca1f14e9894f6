"""Terminals: what the parser takes, and which of them may begin or end what."""

from __future__ import annotations

from dataclasses import dataclass

from planner.language.lexicon.verbs import VERBS

ASKING = frozenset(
    {
        "WHERE",
        "WHAT",
        "WHICH",
        "WHO",
        "HOW_MANY",
        "COUNT",
        "LIST",
        "TELL",
        "BE",
        "DO",
        "HAVE",
        "CAN",
        "CAN_YOU",
        "WHICH_ROOM",
    }
    | {"WHICH_ROOMS", "LIST_ROOMS", "WHETHER", "HELP", "HOW_FAR", "HOW_BIG", "WAY_TO", "WAY", "WHEN", "DONE", "FAILED"}
    | {
        "DOING",
        "EXPLORED",
        "BATTERY",
        "WELL_BEING",
        "SOURCE",
        "ASKED",
        "HOW_LONG",
        "YOUR_NAME",
        "DESCRIBE",
        "LOST",
        "LOCATION",
    }
)
"""Terminals that begin a question."""
ASKED = frozenset(
    {
        "WHERE",
        "WHAT",
        "WHICH",
        "WHO",
        "HOW_MANY",
        "WHETHER",
        "IN",
        "WHICH_ROOM",
        "LOCATION",
        "HOW_FAR",
        "HOW_BIG",
        "WHEN",
    }
)
ACTING = frozenset(VERBS) | {"UNABLE", "CALL", "OPERATE"}
"""Terminals that begin a command."""
NOMINAL = frozenset(
    {"NOUN", "WORD", "NAME", "PERSON", "IDENTIFIER", "ONE", "IT", "ME", "HIM", "DOOR", "ORANGE", "NUMBER"}
)
RELATING = frozenset({"ON", "IN", "NEAR", "AT", "BESIDE", "BETWEEN", "OVER_THERE", "HERE", "THERE", "WITH"})
NP_START = frozenset(
    [
        "THE",
        "MY",
        "POSSESSIVE",
        "A",
        "THIS",
        "THAT",
        "ALL",
        "BOTH",
        "EVERYTHING",
        "NUMBER",
        "ONE",
        "ME",
        "IT",
        "HIM",
        "NOUN",
        "WORD",
        "NAME",
        "IDENTIFIER",
        "COLOR",
        "ORANGE",
        "BIG",
        "SMALL",
        "OTHER",
        "ORDINAL",
        "LARGEST",
        "SMALLEST",
        "NEAREST",
        "DOOR",
    ]
)
NO_NOUN_BEFORE = frozenset({"", "THEN", "AND", "COMMA", "STOP", "OTHERWISE", "IF_SO", "IF_NOT", "BUT", "BUT_FIRST"})
MODIFYING = frozenset({"COLOR", "BIG", "SMALL", "OTHER", "ORDINAL", "NEAREST", "LARGEST", "SMALLEST", "FARTHEST"})
END = frozenset({"", "AND", "COMMA", "STOP", "THEN"})
BEFORE_NOUN = frozenset(
    {
        "THE",
        "MY",
        "A",
        "THIS",
        "THAT",
        "COLOR",
        "BIG",
        "SMALL",
        "NEAREST",
        "LARGEST",
        "SMALLEST",
        "NUMBER",
        "OTHER",
        "ORDINAL",
    }
    | {"FARTHEST", "LEFTMOST", "RIGHTMOST", "STATE", "ALL", "BOTH", "NO", "WHICH", "HOW_MANY"}
)
CLOSED_THAT_STAY = frozenset({"COLOR", "ORANGE", "ONE", "EVERYTHING", "NUMBER", "NAME", "PERSON", "ORDINAL", "DOOR"})


@dataclass(frozen=True)
class Terminal:
    """One token: its terminal, its canonical form, and the words as they were typed."""

    type: str
    value: str
    typed: str
