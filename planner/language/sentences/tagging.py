"""From words to terminals: the longest phrase that starts at a word, or a name of the graph."""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner.language.lexicon.lexicon import LONGEST, PHRASES, Lexicon
from planner.language.lexicon.terminals import NO_NOUN_BEFORE, Terminal
from planner.language.lexicon.verbs import VERBS
from planner.language.lexicon.vocabulary import PERSON_WORDS, normal, singular
from planner.language.sentences.tokens import Word

IDENTIFIER = re.compile(r"[^\W_]+(?:_[^\W_]+)*_\d+")
_DOOR = frozenset({"door", "doors", "doorway", "doorways"})
_VERBS = tuple(words[0] for words, (kind, _) in PHRASES.items() if len(words) == 1 and kind in VERBS)


def tagged(words: Sequence[Word], lexicon: Lexicon) -> list[Terminal]:
    """One terminal for each longest phrase; what several uses have is settled later."""
    tokens: list[Terminal] = []
    index = 0
    while index < len(words):
        length, token = _longest(words, index, lexicon)
        if token.type == "WORD" and (not tokens or tokens[-1].type in NO_NOUN_BEFORE | {"FILLER", "CAN_YOU"}):
            token = _verb_meant(token)
        tokens.append(token)
        index += length
    return tokens


def _verb_meant(token: Terminal) -> Terminal:
    """*brng*: where a verb is due, the verb that an unknown word is a slip of, by a letter or two swapped."""
    found = [verb for verb in _VERBS if verb[0] == token.value[0] and _same_letters(token.value, verb)]
    return Terminal(PHRASES[(found[0],)][0], found[0], token.typed) if len(found) == 1 else token


def _same_letters(typed: str, verb: str) -> bool:
    if len(typed) < 3 or len(verb) < 4:
        return False
    lost = len(typed) == len(verb) - 1 and any(verb[:k] + verb[k + 1 :] == typed for k in range(len(verb)))
    added = len(typed) == len(verb) + 1 and any(typed[:k] + typed[k + 1 :] == verb for k in range(1, len(typed)))
    one_off = len(typed) == len(verb) > 4 and sum(a != b for a, b in zip(typed, verb, strict=True)) == 1
    return lost or added or one_off or (sorted(typed) == sorted(verb) and len(typed) == len(verb))


def _longest(words: Sequence[Word], index: int, lexicon: Lexicon) -> tuple[int, Terminal]:
    """The longest phrase that starts here; names of the graph win over closed-class words of the same length."""
    word = words[index]
    if word.kind != "word":
        return 1, _special(word)
    run: list[str] = []
    while len(run) < max(LONGEST, lexicon.longest) and index + len(run) < len(words):
        if words[index + len(run)].kind != "word":
            break
        run.append(words[index + len(run)].text)
    for length in range(len(run), 0, -1):
        token = _match(tuple(run[:length]), lexicon)
        if token is not None:
            return length, token
    return 1, _unknown(word.text)


def _match(words: tuple[str, ...], lexicon: Lexicon) -> Terminal | None:
    typed = " ".join(words)
    phrase = PHRASES.get(words)
    if phrase is None and (person := lexicon.person(words)):
        return Terminal("NAME", person, typed)
    if phrase is None and typed in lexicon.colors and not lexicon.is_noun(words):
        return Terminal("COLOR", typed, typed)
    if phrase is None and len(words) == 1 and (typed in PERSON_WORDS or singular(typed) in PERSON_WORDS):
        return Terminal("PERSON", typed, typed)
    owner = tuple(typed.removesuffix("'s").removesuffix("s'").split())
    if typed.endswith(("'s", "s'")) and lexicon.can_own(owner) and not lexicon.is_noun(words):
        return Terminal("POSSESSIVE", typed, typed)
    if (
        len(words) == 1
        and typed.endswith("s")
        and (typed[:-1],) in lexicon.persons
        and phrase is None
        and not lexicon.is_noun(words)
    ):
        return Terminal("POSSESSIVE", f"{typed[:-1]}'s", typed)
    if typed in _DOOR:
        return Terminal("DOOR", typed, typed)
    if lexicon.is_noun(words) and (phrase is None or len(words) > 1):
        return Terminal("NOUN", typed, typed)
    return None if phrase is None else Terminal(phrase[0], phrase[1], typed)


def _special(word: Word) -> Terminal:
    kind = {"quoted": "NOUN", "comma": "COMMA", "stop": "STOP"}.get(word.kind, "JUNK")
    return Terminal(kind, normal(word.text) if kind == "NOUN" else word.text, word.text)


def _unknown(word: str) -> Terminal:
    if IDENTIFIER.fullmatch(word):
        return Terminal("IDENTIFIER", word, word)
    if word.endswith("'s") and len(word) > 3:
        return Terminal("POSSESSIVE", word, word)
    return Terminal("NUMBER" if word.isdecimal() else "WORD", word, word)
