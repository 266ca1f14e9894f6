"""What may be in a text is spelled out by ranges; here it is compared with what Python knows of each character."""

from __future__ import annotations

import re
import sys
import unicodedata

import pytest
from pydantic import TypeAdapter, ValidationError

from app.http.documents.words import PRINTABLE_LINE, RequestText, TaughtWord

HIDING = {"Cc", "Zl", "Zp", "Zs"}
WORD, TEXT = TypeAdapter(TaughtWord), TypeAdapter(RequestText)


def everything():
    return (chr(code) for code in range(sys.maxunicode + 1) if not 0xD800 <= code < 0xE000)


def test_every_letter_mark_number_and_symbol_is_printable_and_nothing_that_hides_is():
    printable = re.compile(PRINTABLE_LINE)
    for character in everything():
        category, taken = unicodedata.category(character), printable.search(character) is not None
        if category[0] in "LMNPS":
            assert taken, hex(ord(character))
        assert not (taken and category in HIDING), hex(ord(character))


@pytest.mark.parametrize("turning", ["\u202e", "\u2066", "\u200f", "\u061c", "\u200b", "\ufeff", "\U000e0041"])
def test_what_turns_or_hides_other_characters_is_no_part_of_a_name(turning):
    for name in (turning, f"cup{turning}", f"{turning}cup"):
        with pytest.raises(ValidationError):
            WORD.validate_python(name)


@pytest.mark.parametrize("name", ["office", "Büro", "कमरा", "台所", "ห้อง", "🛋️ corner", "B–12"])
def test_names_of_all_scripts_are_taken_without_the_blanks_around_them(name):
    assert WORD.validate_python(f" \t{name}\r\n") == name


@pytest.mark.parametrize("type_", [WORD, TEXT])
def test_the_documents_pattern_is_what_is_checked(type_):
    shown = type_.json_schema()
    for text in ("a", " a ", "", " ", "\n", "\x00", "\x85", "\u2028", "\ufeff", "a\nb", "a" * 80, "a" * 81, "é\u0301"):
        fits = shown["minLength"] <= len(text) <= shown["maxLength"] and re.search(shown["pattern"], text)
        try:
            type_.validate_python(text)
        except ValidationError:
            assert not fits, repr(text)
        else:
            assert fits, repr(text)
