"""Ways of saying things, by the phenomenon of English that each shows, on the home of ``grammar_home``."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.interpreter import Interpreter
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Kind, Lesson
from planner.skill_planner.verifier import Verifier
from skills.registry import load_registry

PLANS = [
    ("clear the desk, everything can go on the couch", "on(bottle_2, couch_1) on(pen_1, couch_1)"),
    ("could you tidy up a bit: books on the desk please", "on(book_1, desk_1) on(book_2, desk_1) on(book_3, desk_1)"),
    ("tidy the bed: the blue book to the office, everything else on the desk", "in(book_2, room_4) on(book_3, desk_1)"),
    ("do not put the apple on the desk, put it on the couch", "on(apple_1, couch_1)"),
    ("could the key go on the desk", "on(key_1, desk_1)"),
    ("of the two bottles bring me the one that is not red", "given(bottle_1, person_2)"),
    ("roll on out to the bedroom and stay put there", "robot_at(room_5)"),
    ("bring me the key, it is getting late", "given(key_1, person_2)"),
    ("put the apple on the desk, then do the same with the key", "on(apple_1, desk_1) on(key_1, desk_1)"),
    ("drop the apple on the desk, would you see to that?", "on(apple_1, desk_1)"),
    ("the books from the bedroom go to the office", "in(book_2, room_4) in(book_3, room_4)"),
    ("the apple for Anna", "given(apple_1, person_1)"),
    ("Anna is hungry, bring her the apple", "given(apple_1, person_1)"),
    ("I would rather have the remote", "given(remote_1, person_2)"),
    ("go to Anna's", "robot_at(room_3)"),
    ("the key... no the apple goes to the office", "in(apple_1, room_4)"),
    ("could Anna get the apple", "given(apple_1, person_1)"),
    ("Anna needs the remote", "given(remote_1, person_1)"),
    ("Anna lost the key, take it to her", "given(key_1, person_1)"),
    ("Anna forgot the pen, bring it to her unless she is in the office", "given(pen_1, person_1)"),
    ("Anna needs the laptop, no wait, she needs the key", "given(key_1, person_1)"),
    ("the office please", "robot_at(room_4)"),
    ("the apple, please", "given(apple_1, person_2)"),
    ("apple to the desk", "on(apple_1, desk_1)"),
    ("the apple and the red cup to the office", "in(apple_1, room_4) in(cup_1, room_4)"),
    (
        "cups on the desk and bottles on the couch",
        "on(cup_1, desk_1) on(cup_2, desk_1) on(cup_3, desk_1) on(bottle_1, couch_1) on(bottle_2, couch_1)",
    ),
    (
        "books in the box, bottles on the couch",
        "in(book_1, box_1) in(book_2, box_1) in(book_3, box_1) on(bottle_1, couch_1) on(bottle_2, couch_1)",
    ),
    ("all the books onto the desk", "on(book_1, desk_1) on(book_2, desk_1) on(book_3, desk_1)"),
    ("take the apple to the desk and the remote too", "on(apple_1, desk_1) on(remote_1, desk_1)"),
    (
        "put the remote in the kitchen as well as the book on the bed that is blue",
        "in(remote_1, room_1) in(book_2, room_1)",
    ),
    ("leave the remote on the desk for me", "on(remote_1, desk_1)"),
    ("get the apple off the counter and onto the desk", "on(apple_1, desk_1)"),
    ("supply Anna with the pen", "given(pen_1, person_1)"),
    ("provide me with the remote", "given(remote_1, person_2)"),
    ("equip Anna with the key", "given(key_1, person_1)"),
    ("lend Anna the pen", "given(pen_1, person_1)"),
    ("offer Anna the apple", "given(apple_1, person_1)"),
    (
        "start in the kitchen, continue to the bedroom, end up in the office",
        "robot_at(room_1) robot_at(room_5) robot_at(room_4)",
    ),
    ("the remote to Anna first, and only then the apple to me", "given(remote_1, person_1) given(apple_1, person_2)"),
    ("Anna is asking for the apple", "given(apple_1, person_1)"),
    ("Anna could do with the remote", "given(remote_1, person_1)"),
    ("make sure Anna gets the remote", "given(remote_1, person_1)"),
    ("Anna has asked for the green cup, take it to her", "given(cup_2, person_1)"),
    ("there is a remote on the couch, take it to the kitchen", "in(remote_1, room_1)"),
    ("there's an apple in the kitchen, bring it to Anna", "given(apple_1, person_1)"),
    ("my phone is on the nightstand, get it", "given(phone_1, person_2)"),
    ("Anna lost the key, find it", "found(key_1)"),
    ("the phone is gone, look for it", "found(phone_1)"),
    ("bring me the cup furthest from the couch", "given(cup_2, person_2)"),
    ("bring me the cup nearest the laptop", "given(cup_1, person_2)"),
    ("go to the table farthest from the desk", "robot_at(table_1)"),
    ("bring me the bottle of red color", "given(bottle_2, person_2)"),
    ("bring me the bottle that is on the desk and red", "given(bottle_2, person_2)"),
    ("bring me the book with the yellow cover", "given(book_3, person_2)"),
    ("the yellow-covered book goes on the couch", "on(book_3, couch_1)"),
    ("get whatever cup is on the table and white", "given(cup_3, person_2)"),
    ("bring me the smaller of the two bottles", "given(bottle_1, person_2)"),
    ("bring me whichever cup is nearer", "given(cup_1, person_2)"),
    ("bring me any two cups", "given(cup_1, person_2) given(cup_3, person_2)"),
    ("bring me a book that is neither blue nor yellow", "given(book_1, person_2)"),
    ("I want a bottle, neither blue nor green", "given(bottle_2, person_2)"),
    ("bring me the cup that's not on the counter or the kitchen table", "given(cup_3, person_2)"),
    ("bring me a cup except the red one", "given(cup_3, person_2)"),
    ("I don't want the red bottle, bring the other", "given(bottle_1, person_2)"),
    ("not the blue bottle, the other one to the couch", "on(bottle_2, couch_1)"),
    ("without touching the red cup, put the cups on the desk", "on(cup_2, desk_1) on(cup_3, desk_1)"),
    ("put the bottles on the couch, but do not take the red one", "on(bottle_1, couch_1)"),
    ("put the book on the desk, the yellow one", "on(book_3, desk_1)"),
    ("put the bottle in the box... the red one", "in(bottle_2, box_1)"),
    ("bring me the red cup, err, the green one", "given(cup_2, person_2)"),
    ("bring me the red cup - oh no, the green one", "given(cup_2, person_2)"),
    ("bring me two cups, make that three", "given(cup_1, person_2) given(cup_3, person_2) given(cup_2, person_2)"),
    ("put the apple on the desk, no wait, on the couch", "on(apple_1, couch_1)"),
    ("give me the red bottle, I mean the blue one", "given(bottle_1, person_2)"),
    ("go to Anna in her room", "robot_at(person_1)"),
    ("put the pen on Anna's table", "on(pen_1, table_2)"),
    ("put the pen on the bedroom's nightstand", "on(pen_1, nightstand_1)"),
    ("bring me the books of the bedroom", "given(book_2, person_2) given(book_3, person_2)"),
    ("bring me what is on the desk next to the pen", "given(bottle_2, person_2)"),
    (
        "take the cups on the table and the counter to the office",
        "in(cup_1, room_4) in(cup_2, room_4) in(cup_3, room_4)",
    ),
    ("take the sock on the floor to the bedroom", "in(sock_1, room_5)"),
    ("if Anna's in the living room, give her the remote", "given(remote_1, person_1)"),
    ("if you are in the hall, go to the kitchen", "robot_at(room_1)"),
    ("if the box has a book, bring it, otherwise bring the apple", "given(apple_1, person_2)"),
    (
        "if the red cup is in the kitchen take it to Anna, if it is in the office take it to the bedroom",
        "given(cup_1, person_1)",
    ),
    ("either bring me the phone or, if it's gone, the remote", "given(phone_1, person_2)"),
    ("can you get into the bathroom? if not, go to the office", "robot_at(room_4)"),
    ("trip to the office and back", "robot_at(room_4) robot_at(room_2)"),
    ("take a peek into the bedroom and return", "robot_at(room_5) robot_at(person_2)"),
    ("off to the office with you", "robot_at(room_4)"),
    ("the bedroom is where I want you", "robot_at(room_5)"),
    ("find yourself a spot in the office", "robot_at(room_4)"),
    ("go join Anna", "robot_at(person_1)"),
    ("wait with Anna", "robot_at(person_1)"),
    (
        "clear the table in the kitchen onto the counter",
        "on(bottle_1, counter_1) on(cup_1, counter_1) on(key_1, counter_1)",
    ),
    ("empty the kitchen table into the box", "in(bottle_1, box_1) in(cup_1, box_1) in(key_1, box_1)"),
    ("tidy the bedroom: books on the desk, the phone stays", "on(book_2, desk_1) on(book_3, desk_1)"),
    ("bring apple anna", "given(apple_1, person_1)"),
    ("plaese brign me the rde cup", "given(cup_1, person_2)"),
    ("putthe apple on the dsek", "on(apple_1, desk_1)"),
    ("take the apple 2 anna", "given(apple_1, person_1)"),
    ("could you like bring me the apple or something", "given(apple_1, person_2)"),
    (
        "take the cups on the table and the counter to the office",
        "in(cup_1, room_4) in(cup_2, room_4) in(cup_3, room_4)",
    ),
    ("bring me the bottle that is on the desk and red", "given(bottle_2, person_2)"),
    ("bring me the cup that's not on the counter or the kitchen table", "given(cup_3, person_2)"),
    ("Anna has asked for the green cup, take it to her", "given(cup_2, person_1)"),
    ("if the table has at least two cups, go to the office", "robot_at(room_4)"),
    ("if the counter has at least one cup, go to the office", "robot_at(room_4)"),
]

ASKED = [
    ("put the apple away", "Where should I put"),
    ("Anna is hungry", "What shall I do"),
    ("bring me the cup that isn't the red one", "green cup"),
    ("the apple on the counter", "Did you mean"),
    ("there is an apple on the counter", "What shall I do with the red apple?"),
    ("leave the apple where it is", "I will not"),
    ("take the red cup, the green cup, to the office", "understand"),
    ("get the kitchen in order: the bottle on the counter, the cup in the box", "cup"),
]

REFUSED = [
    ("if she is in the living room, bring me the apple", "whom you mean"),
    ("there is a banana on the couch, bring it to Anna", "banana"),
    ("open the door", "cannot open"),
    ("open the door to the bathroom, please", "cannot open"),
    ("could you open the bathroom", "cannot open"),
    ("put the apple on the floor", "not on the floor"),
    ("put Grandma's cup on the desk", "grandma"),
]

ANSWERS = [
    ("could you check whether the bathroom is open and tell me", "No"),
    ("who knows where the remote is", "couch"),
    ("where are the books kept", "shelf"),
    ("where's the key gone", "table"),
    ("in what room would I find the phone", "bedroom"),
    ("what do we have to drink", "bottle"),
    ("got any apples?", "Yes"),
    ("which of the cups are white", "table in the living room"),
    ("does Anna have a remote on her couch", "Yes"),
    ("is the bathroom locked or open", "closed"),
    ("is it possible to get into the bathroom", "No"),
    ("how would I get to the office from the kitchen", "hall"),
    ("where's the key gone", "table"),
]

TAUGHT = [
    ("this here is the den", Lesson(node="room_2", label="den")),
    ("my cup is the green one", Lesson(node="cup_2", name="my cup")),
    ("we are calling the living room the salon", Lesson(node="room_3", label="salon")),
    ("the red cup is Tim's cup", Lesson(node="cup_1", name="tim's cup")),
    ("the thing on the counter that looks like fruit is called Newton", Lesson(node="apple_1", name="newton")),
]

SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))


def read(text):
    return INTERPRETER.read(text, SNAPSHOT, Dialogue()).interpretation


@pytest.mark.parametrize(("text", "goals"), PLANS)
def test_a_request_becomes_these_goals(text, goals):
    found = read(text)
    assert (found.kind, " ".join(map(str, found.goals))) == (Kind.PLAN, goals), found.reply


@pytest.mark.parametrize(("text", "part"), ASKED)
def test_what_is_not_clear_is_asked_about_and_nothing_is_done(text, part):
    found = read(text)
    assert (found.kind, found.goals) == (Kind.CLARIFY, ())
    assert part in found.reply


@pytest.mark.parametrize(("text", "part"), REFUSED)
def test_what_cannot_be_done_is_refused_by_name(text, part):
    found = read(text)
    assert (found.kind, found.goals) == (Kind.REFUSE, ())
    assert part in found.reply


@pytest.mark.parametrize(("text", "part"), ANSWERS)
def test_a_question_is_answered(text, part):
    found = read(text)
    assert (found.kind, found.goals) == (Kind.ANSWER, ())
    assert part in found.reply


@pytest.mark.parametrize(("text", "lesson"), TAUGHT)
def test_a_lesson_is_learned(text, lesson):
    found = read(text)
    assert (found.kind, found.goals, found.lessons) == (Kind.ANSWER, (), (lesson,))
