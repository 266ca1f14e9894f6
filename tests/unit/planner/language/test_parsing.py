"""A sentence is parsed as it was typed: all readings of a word are kept until the sentence settles them."""

from __future__ import annotations

from itertools import permutations

import pytest

from planner.language.grammar.parser import Background, Choice, NotUnderstood, Refrain, Unable, Understood
from planner.language.grammar.syntax import Ask, Carry, Go, NounPhrase, Perhaps, Pronoun, Swap
from planner.language.lexicon.lexicon import Lexicon
from planner.language.parsing.chart import Chart, Entry
from planner.language.parsing.parser import RequestGrammar
from planner.language.parsing.rules import Rules
from planner.language.parsing.things import knowledge, stems
from planner.language.parsing.tokens import sentences, tokens_of, typed
from planner.language.parsing.words import english, expanded, gerund, participles, third_person
from planner.plan import QueryKind

LEXICON = Lexicon.of(
    ["cup", "table", "desk", "apple", "bottle", "kitchen", "office"], ["Anna", "Ben"], (), ["red", "blue"]
)


def steps(text):
    return RequestGrammar().parse(text, LEXICON)


def only(text):
    (step,) = steps(text)
    assert isinstance(step, Understood), step
    return step.readings


def things(reading):
    return [thing.head if isinstance(thing, NounPhrase) else thing.word for thing in reading.things]


@pytest.mark.parametrize(
    "text",
    [
        "bring the red cup to the desk",
        "Bring, the red cup to the desk 🙏",
        "bring the\u200b red cup to the desk",
        "please would you mind bringing the red cup to the desk, thanks",
        "conduct the relocation of the red cup to the desk",
        "the red cup should be moved to the desk",
        "bring cup red to desk",
    ],
)
def test_the_same_is_said_in_many_ways(text):
    readings = only(text)
    assert {tuple(things(reading)) for reading in readings} == {("cup",)}
    assert {reading.things[0].colors for reading in readings} == {("red",)}
    assert {reading.destination.reference.head for reading in readings} == {"desk"}


@pytest.mark.parametrize("word", ["not", "except", "away", "second", "only", "if", "unless"])
@pytest.mark.parametrize("place", range(1, 7))
def test_a_word_that_changes_a_request_never_leaves_it_the_same(word, place):
    words = ["bring", "the", "red", "cup", "to", "the", "desk"]
    changed = " ".join([*words[:place], word, *words[place:]])
    assert steps(changed) != steps(" ".join(words))
    assert not any(
        isinstance(step, Understood) and step.readings == only(" ".join(words)) for step in steps(changed)
    ), changed


def test_two_things_change_places_however_it_is_said():
    ways = ("swap the cup and the bottle", "let the cup and the bottle trade places", "the cup and the bottle: swap")
    for text in ways:
        (reading,) = only(text)
        assert isinstance(reading, Swap)
        assert things(reading) == ["cup", "bottle"]


def test_what_is_only_taken_up_is_put_where_they_are_put_together():
    readings = only("Take the cup and the apple off the table. Then put them on the desk.")
    assert all(isinstance(reading, Carry) for reading in readings)
    assert {tuple(things(reading)) for reading in readings} == {("cup", "apple")}


def test_a_condition_a_refusal_and_what_is_only_told_are_told_apart():
    (choice,) = steps("if the cup is on the table, bring it to Anna, otherwise go to the kitchen")
    assert isinstance(choice, Choice)
    assert isinstance(choice.condition[0], Ask)
    assert isinstance(choice.then[0].readings[0], Carry)
    assert isinstance(choice.otherwise[0].readings[0], Go)
    assert isinstance(steps("do not bring the apple")[0], Refrain)
    assert isinstance(steps("wash the cup")[0], Unable)
    told, done = steps("It is raining, bring me the cup")
    assert isinstance(told, Background)
    assert isinstance(done, Understood)


def test_who_gets_something_may_be_told_by_where_he_is():
    (reading,) = only("the man in the kitchen needs the cup")
    assert reading.destination.reference.person
    assert reading.destination.reference.restrictions[0].reference.head == "kitchen"


def test_what_cannot_be_seen_is_asked_about_as_such():
    (reading,) = only("is the bottle empty?")
    assert (reading.kind, reading.word) == (QueryKind.UNKNOWABLE, "is empty")


def test_a_thing_may_be_named_by_what_it_is_for():
    (reading,) = only("bring me something to cut paper with")
    assert reading.things[0].restrictions[0].word == "cut paper with"
    labels = ["scissors", "apple", "thermometer", "umbrella"]
    assert knowledge().meant(labels, "cut paper with") == {"scissors"}
    assert knowledge().meant(labels, "measures temperature") == {"thermometer"}
    assert not knowledge().meant(labels, "play chess")
    assert stems("cutting paper") == stems("to cut papers")


def test_what_no_rule_covers_is_not_understood():
    assert isinstance(steps("the of bring table")[0], NotUnderstood)
    assert steps("please, thanks!") == []


def test_a_statement_without_a_verb_may_be_a_request():
    assert any(isinstance(reading, Perhaps) for reading in only("all cups onto the desk"))


def test_a_phrase_alone_is_read_for_answers():
    (phrase,) = RequestGrammar().phrase("the red one", LEXICON)
    assert (phrase.words, phrase.colors) == (("one",), ("red",))
    assert isinstance(only("bring it to Ben")[0].things[0], Pronoun)


def test_words_are_split_at_marks_and_none_is_lost():
    tokens = tokens_of("Don't move 0.2 m, Anna's \"old mug\"… ok?", english().contractions)
    assert [token.text for token in tokens if token.kind != "mark"] == [
        "do", "not", "move", "0.2", "m", ",", "anna's", "old mug", "...", "ok", "?",
    ]  # fmt: skip
    assert [typed(part) for part in sentences(tokens)] == ["Don't move 0.2 m, Anna's old mug", "ok"]


def test_forms_of_verbs_follow_from_the_plain_one():
    assert [gerund("put down"), third_person("carry"), third_person("go")] == ["putting down", "carries", "goes"]
    assert participles("relocate", {}) + participles("bring", {"bring": ["brought"]}) == ["relocated", "brought"]
    assert set(expanded("(could|can) you [please]")) == {"could you please", "could you", "can you please", "can you"}


AMBIGUOUS = """
start: pair | pair A
pair: A A | single A
single: A
%declare A
"""


def test_every_derivation_is_found_whatever_the_order_of_the_entries():
    rules = Rules(AMBIGUOUS, ("start",))
    entries = [Entry(symbol=rules.numbers["A"], start=i, end=i + 1, value=f"a{i}", cost=i) for i in range(3)]
    found = {
        frozenset((reading.cost, reading.value) for reading in Chart(rules, _bracketed, order, 3, "start").readings())
        for order in permutations(entries)
    }
    assert found == {frozenset({(3, "start(pair(a0 a1) a2)"), (3, "start(pair(single(a0) a1) a2)")})}


def test_a_grammar_that_comes_back_to_a_symbol_is_refused():
    with pytest.raises(ValueError, match="by single parts"):
        _ = Rules("start: a\na: b | A\nb: a\n%declare A", ("start",)).ranks


def _bracketed(name, children):
    return f"{name}({' '.join(children)})"
