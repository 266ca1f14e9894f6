"""Texts that clients send. One pattern and one length check a text and stand in the document; a sentence refuses it."""

from __future__ import annotations

from typing import Annotated

from pydantic import StringConstraints, ValidationError, ValidationInfo, ValidatorFunctionWrapHandler, WrapValidator
from pydantic_core import PydanticCustomError

from app.http.documents.problems import WHOLE_SENTENCE

MAX_REQUEST_CHARACTERS = 10_000
MAX_NAME_CHARACTERS = 80
_UNSEEN = (
    r"\u0000-\u001F\u007F-\u00A0\u00AD\u061C\u1680\u180E\u2000-\u200F\u2028-\u202F\u205F-\u206F"
    r"\u3000\uFEFF\uFFF9-\uFFFB"
    "\U000e0001\U000e0020-\U000e007f"
)
"""What controls text or shows nothing of its own, other than the space. Spelled out, not as classes such as ``\\s`` and
``\\p{C}``: of these every engine of regular expressions has its own idea."""
SOMETHING_VISIBLE = f"[^ {_UNSEEN}]"
PRINTABLE_LINE = rf"^[ \t\r\n]*[^ {_UNSEEN}][^{_UNSEEN}]*[ \t\r\n]*$"
_EMPTY = "The {what} is empty. Please say in plain words what you want."
_LONG = "The {what} has {length} characters, and I read at most {most}. Please say it in fewer words."


def _refused_in(kind: str, most: int, **sentences: str) -> WrapValidator:
    """Takes the blanks around a text that fits; tells one that does not by the sentence for what is wrong with it."""

    def check(value: object, fitting: ValidatorFunctionWrapHandler, info: ValidationInfo) -> str:
        try:
            text: str = fitting(value)
        except ValidationError as error:
            flaw = error.errors()[0]["type"]
            if flaw not in sentences:
                raise
            said = {"what": info.field_name, "length": len(str(value)), "most": most}
            raise PydanticCustomError(kind, sentences[flaw], said) from None
        return text.strip()

    return WrapValidator(check)


RequestText = Annotated[
    str,
    StringConstraints(min_length=1, max_length=MAX_REQUEST_CHARACTERS, pattern=SOMETHING_VISIBLE),
    _refused_in(
        WHOLE_SENTENCE,
        MAX_REQUEST_CHARACTERS,
        string_too_short=_EMPTY,
        string_pattern_mismatch=_EMPTY,
        string_too_long=_LONG,
    ),
]
"""What a person says to the robot; what is wrong with it is said in the robot's own words."""

TaughtWord = Annotated[
    str,
    StringConstraints(min_length=1, max_length=MAX_NAME_CHARACTERS, pattern=PRINTABLE_LINE),
    _refused_in("unprintable", MAX_NAME_CHARACTERS, string_pattern_mismatch="use printable characters on one line"),
]
"""A label or a name that a person gives: printable characters on one line."""
