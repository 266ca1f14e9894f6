"""Wordings that mean the same: what is typed on the left is read as what stands on the right."""

from __future__ import annotations

import re

import pytest

from planner.language.paraphrase.paraphrase import RULES, paraphrased
from wordings import MORE
from wordings_of_deeds import DEEDS
from wordings_of_errands import SAME
from wordings_of_talk import TALK
from wordings_rough import ROUGH
from wordings_spoken import SPOKEN

UNCHANGED = [
    "do not bring me the milk",
    "bring me the cup",
    "put the red cup on the table in the kitchen",
    "bring me 2 of the cups",
    "would you like a cup",
    "the cup should stay",
    "go to the second room",
    "where is the cup and the book",
]


WORDINGS = [*SAME, *MORE, *TALK, *SPOKEN, *DEEDS, *ROUGH]
NOUN = re.compile(r"\b(?:cup|book|box|vase|remote)\b")
OF_THINGS = [typed for typed, _ in WORDINGS if NOUN.search(typed) and not re.search(r"\bcan\b", typed)]


@pytest.mark.parametrize(("typed", "said"), WORDINGS)
def test_a_wording_is_read_as_the_one_that_the_grammar_knows(typed, said):
    assert paraphrased(typed) == said


@pytest.mark.parametrize("typed", OF_THINGS)
def test_a_can_is_a_thing_like_any_other_though_it_is_a_verb_too(typed):
    assert paraphrased(NOUN.sub("can", typed)) == NOUN.sub("can", paraphrased(typed))


@pytest.mark.parametrize("text", UNCHANGED)
def test_plain_words_stay_as_they_are(text):
    assert paraphrased(text) == text


COMPILED = [(re.compile(pattern), said) for pattern, said in RULES]


def changed_by(text):
    changed = set()
    for number, (pattern, said) in enumerate(COMPILED):
        after = pattern.sub(said, text)
        if after != text:
            changed.add(number)
        text = after
    return changed


def test_every_rule_has_an_example_here():
    used = set().union(*(changed_by(typed) for typed, _ in WORDINGS))
    assert [RULES[number] for number in range(len(RULES)) if number not in used] == []
