"""From words to terminals: closed-class phrases, names of the live graph, fillers dropped, steps separated.

Lark's Earley parser takes its tokens from here. A word gets one terminal, chosen by where it stands: *water* is a
verb at the start of a step, before a noun phrase, and a noun elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from majordomo.planner.grammar.spelling import closest
from majordomo.planner.grammar.tokens import Word, words_of
from majordomo.planner.grammar.words import ADVERBS, LYING, NOUNLIKE, POLITE_IF_VERB, VERBS, phrase_table
from majordomo.planner.vocabulary import PERSON_WORDS, known_nouns, normal, singular

IDENTIFIER = re.compile(r"[^\W_]+(?:_[^\W_]+)*_\d+")
_PHRASES = phrase_table()
_PHRASE_WORDS = frozenset(word for words in _PHRASES for word in words)
_LONGEST = max(len(words) for words in _PHRASES)
_KNOWN = frozenset(tuple(normal(noun).split()) for noun in known_nouns())
_KNOWN_WORDS = frozenset(word for words in _KNOWN for word in words)
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
    | {"DOING", "BATTERY", "YOUR_NAME", "DESCRIBE", "LOST", "LOCATION"}
)
"""Terminals that begin a question."""
_ASKED = frozenset(
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
ACTING = frozenset(VERBS) | {"UNABLE", "CALL"}
"""Terminals that begin a command."""
_NOMINAL = frozenset(
    {"NOUN", "WORD", "NAME", "PERSON", "IDENTIFIER", "ONE", "IT", "ME", "HIM", "DOOR", "ORANGE", "NUMBER"}
)
_RELATING = frozenset({"ON", "IN", "NEAR", "AT", "BESIDE", "BETWEEN", "OVER_THERE", "HERE", "THERE", "WITH"})
_NP_START = frozenset(
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
_NO_NOUN_BEFORE = frozenset({"", "THEN", "AND", "COMMA", "STOP", "OTHERWISE", "IF_SO", "IF_NOT", "BUT", "BUT_FIRST"})
_END = frozenset({"", "AND", "COMMA", "STOP", "THEN"})
_BEFORE_NOUN = frozenset(
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
_CLOSED_THAT_STAY = frozenset({"COLOR", "ORANGE", "ONE", "EVERYTHING", "NUMBER", "NAME", "PERSON", "ORDINAL", "DOOR"})
_DOOR = frozenset({"door", "doors", "doorway", "doorways"})
_SHUT = {"open": "open", "opened": "open", "closed": "closed", "shut": "closed"}
_SIDES = {"left": "LEFTMOST", "leftmost": "LEFTMOST", "left-hand": "LEFTMOST", "right": "RIGHTMOST",
          "rightmost": "RIGHTMOST", "right-hand": "RIGHTMOST"}  # fmt: skip
_AHEAD = 8
"""Words that the use of a word depends on."""
_LEADING = frozenset({"FRAME", "AFTER", "BEFORE", "WHEN"})
_VERBS = tuple(words[0] for words, (kind, _) in _PHRASES.items() if len(words) == 1 and kind in VERBS)
_PRESENT = {phrase: terminal for phrase, (terminal, _) in _PHRASES.items() if terminal in VERBS}


@dataclass(frozen=True)
class Terminal:
    """One token: its terminal, its canonical form, and the words as they were typed."""

    type: str
    value: str
    typed: str


@dataclass(frozen=True)
class Lexicon:
    """Names of the live graph as tuples of words: nouns (labels, taught names, rooms) and persons."""

    nouns: frozenset[tuple[str, ...]] = frozenset()
    persons: frozenset[tuple[str, ...]] = frozenset()
    longest: int = field(default=4)

    @classmethod
    def of(cls, nouns: Iterable[str], persons: Iterable[str] = ()) -> Lexicon:
        """From labels and names as they stand in the graph."""
        split = frozenset(tuple(normal(noun).split()) for noun in nouns if normal(noun))
        people = frozenset(tuple(normal(person).split()) for person in persons if normal(person))
        return cls(split, people, max((len(words) for words in split | people | _KNOWN), default=1))

    def meant(self, word: str) -> str:
        """``word``, or the one name of the graph that it is a slip of."""
        if (word,) in _PHRASES or self.is_noun((word,)) or word in _KNOWN_WORDS | _PHRASE_WORDS:
            return word
        parts = {part for words in self.nouns | self.persons for part in words}
        return word if word in parts or singular(word) in parts else closest(word, parts) or word

    def is_noun(self, words: tuple[str, ...]) -> bool:
        """Whether ``words`` name something here or in the vocabulary, in the singular or plural."""
        one = (*words[:-1], singular(words[-1]))
        return words in self.nouns or one in self.nouns or words in _KNOWN or one in _KNOWN


def sentences(text: str, lexicon: Lexicon) -> list[list[Terminal]]:
    """The sentences of a request, each as a list of terminals; courtesy is dropped."""
    words = [word for word in words_of(text) if word.kind != "word" or word.text not in ADVERBS]
    words = [Word(lexicon.meant(word.text), "word") if word.kind == "word" else word for word in words]
    found: list[list[Terminal]] = [[]]
    for token in _settle(_tag(words, lexicon), lexicon):
        if token.type == "STOP":
            found.append([])
        elif token.type not in ("FILLER", "FRAME"):
            found[-1].append(token)
    return [trimmed(sentence) for sentence in found if trimmed(sentence)]


def clauses(sentence: Sequence[Terminal]) -> list[list[Terminal]]:
    """The steps of a sentence: *do this, then that and another thing*."""
    steps: list[list[Terminal]] = [[]]
    for index, token in enumerate(sentence):
        if token.type == "THEN" or (token.type in ("AND", "COMMA") and _starts_step(sentence, index + 1)):
            steps.append([])
        else:
            steps[-1].append(token)
    return [trimmed(step) for step in steps if trimmed(step)]


def asks(step: Sequence[Terminal]) -> bool:
    """Whether a step begins as a question does: *where*, *is*, *on which table*."""
    return step[0].type in ASKING or (step[0].type in ("ON", "IN") and len(step) > 1 and step[1].type == "WHICH")


def _tag(words: Sequence[Word], lexicon: Lexicon) -> list[Terminal]:
    tokens: list[Terminal] = []
    index = 0
    while index < len(words):
        length, token = _longest(words, index, lexicon)
        if token.type == "WORD" and (not tokens or tokens[-1].type in _NO_NOUN_BEFORE | {"FILLER"}):
            token = _verb_meant(token)
        tokens.append(token)
        index += length
    return tokens


def _verb_meant(token: Terminal) -> Terminal:
    """*brng*: where a verb is due, the verb that an unknown word is a slip of, letters lost or swapped only."""
    found = [verb for verb in _VERBS if verb[0] == token.value[0] and _same_letters(token.value, verb)]
    return Terminal(_PHRASES[(found[0],)][0], found[0], token.typed) if len(found) == 1 else token


def _same_letters(typed: str, verb: str) -> bool:
    if len(typed) < 3 or len(verb) < 4:
        return False
    lost = len(typed) == len(verb) - 1 and any(verb[:k] + verb[k + 1 :] == typed for k in range(len(verb)))
    return lost or (sorted(typed) == sorted(verb) and len(typed) == len(verb))


def _longest(words: Sequence[Word], index: int, lexicon: Lexicon) -> tuple[int, Terminal]:
    """The longest phrase that starts here; names of the graph win over closed-class words of the same length."""
    word = words[index]
    if word.kind != "word":
        return 1, _special(word)
    run: list[str] = []
    while len(run) < max(_LONGEST, lexicon.longest) and index + len(run) < len(words):
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
    phrase = _PHRASES.get(words)
    if words in lexicon.persons and phrase is None:
        return Terminal("NAME", typed, typed)
    if phrase is None and len(words) == 1 and (typed in PERSON_WORDS or singular(typed) in PERSON_WORDS):
        return Terminal("PERSON", typed, typed)
    owner = tuple(typed.removesuffix("'s").removesuffix("s'").split())
    if typed.endswith(("'s", "s'")) and owner in lexicon.persons and not lexicon.is_noun(words):
        return Terminal("POSSESSIVE", typed, typed)
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
    return Terminal("NUMBER" if word.isdecimal() else "WORD", word, word)


def _settle(tokens: Sequence[Terminal], lexicon: Lexicon) -> list[Terminal]:
    """Choose among the uses of words that have several, from left to right."""
    settled: list[Terminal] = []
    led = False
    for index, token in enumerate(tokens):
        before = next((t.type for t in reversed(settled) if t.type != "FILLER"), "")
        following = [t for t in tokens[index + 1 : index + 1 + _AHEAD] if t.type != "FILLER"]
        led = led or token.type in _LEADING
        settled.append(_of_past(token, before, following, led=led) or _choose(token, before, following, lexicon))
        led = led and token.type != "STOP"
    return settled


def _of_past(token: Terminal, before: str, following: Sequence[Terminal], *, led: bool) -> Terminal | None:
    """*brought*: the verb after *once you have* or *I'd appreciate it if you*, else something that is told."""
    if token.type != "PAST" or (
        token.typed in LYING and before in _NOMINAL and following[:1] and following[0].type in _RELATING
    ):
        return None
    kind = _PRESENT[tuple(token.value.split())] if led else "MEANING"
    return Terminal(kind, token.value, token.typed)


def _choose(token: Terminal, before: str, following: Sequence[Terminal], lexicon: Lexicon) -> Terminal:
    after = following[0].type if following else ""
    kind, value = token.type, token.value
    if token.typed in _SHUT and _is_adjective(before, after):
        kind, value = "STATE", _SHUT[token.typed]
    elif token.typed in _SIDES and before in ("THE", "MY", "THAT") and after not in _END:
        kind = _SIDES[token.typed]
    elif token.typed in LYING and before in _NOMINAL | {"BE"} and after in _RELATING:
        kind = "FILLER"
    elif kind not in _CLOSED_THAT_STAY and before in _BEFORE_NOUN and lexicon.is_noun((token.typed,)):
        kind = "NOUN"
    elif (
        token.typed in ("check", "see", "look", "find", "find out") and after in _ASKED - {"IN"} and before != "CAN_YOU"
    ):
        kind = "TELL"
    elif kind == "TELL" and after not in _ASKED:
        return Terminal("UNABLE", token.typed.split()[0], token.typed)
    elif token.typed == "first" and (before in ("", "THEN", "STOP", "AND", "COMMA")):
        kind = "THEN"
    elif kind == "NEXT":
        kind = "THEN" if before in _NO_NOUN_BEFORE else "FILLER" if after in _END else "MEANING"
    elif kind == "BUT":
        kind = "EXCEPT" if after in _NP_START else "AND"
    elif token.typed in POLITE_IF_VERB and _is_polite(token.typed, following):
        kind = "THEN" if token.typed == "to" and before in _NOMINAL else "FILLER"
    elif kind in ACTING and token.typed in NOUNLIKE and not _is_verb_here(before, after):
        kind = "NOUN"
    return Terminal(kind, token.typed if kind == "NOUN" else value, token.typed)


def _is_adjective(before: str, after: str) -> bool:
    """Whether *open* or *closed* says how a door is: *is it open*, *the open door*, *the door is not open*."""
    if before in ("BE", "NOT", "DOOR"):
        return True
    return before not in _NO_NOUN_BEFORE and (after == "DOOR" or (after in _END and before in _NOMINAL))


def _is_polite(words: str, following: Sequence[Terminal]) -> bool:
    after = following[0].type if following else ""
    if words == "to":
        return after in ACTING and _is_phrase(following[1:])
    return after in ACTING or after == "PAST" or (after == "TELL" and words.endswith("you"))


def _is_phrase(following: Sequence[Terminal]) -> bool:
    return bool(following) and following[0].type in _NP_START


def _is_verb_here(before: str, after: str) -> bool:
    """A verb that is a noun as well starts a step, and something follows it, unless it is the whole request."""
    return before in _NO_NOUN_BEFORE and (after not in _END or before in ("", "THEN", "STOP"))


def _starts_step(tokens: Sequence[Terminal], index: int) -> bool:
    """Whether a new step begins at ``index``: an action verb or a question word, after courtesy."""
    for place, token in enumerate(tokens[index:], start=index):
        if token.type in ("FILLER", "AND", "COMMA", "ALSO"):
            continue
        if token.type == "BACK" and place + 1 == len(tokens):
            return True
        return token.type in ACTING or token.type in ASKING or token.type == "THEN"
    return False


def trimmed(step: Sequence[Terminal]) -> list[Terminal]:
    """A step without leading or trailing conjunctions."""
    start, end = 0, len(step)
    while start < end and step[start].type in ("AND", "COMMA", "ALSO", "THEN"):
        start += 1
    while end > start and step[end - 1].type in ("AND", "COMMA", "ALSO", "THEN"):
        end -= 1
    return list(step[start:end])


def typed(step: Sequence[Terminal] | Mapping[int, Terminal]) -> str:
    """The words of a step as they were typed."""
    tokens = step.values() if isinstance(step, Mapping) else step
    return " ".join(token.typed for token in tokens).replace(" ,", ",")
