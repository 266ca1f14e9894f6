"""From a request to its sentences as terminals, courtesy dropped, and from a sentence to its clauses.

Lark's Earley parser takes its tokens from here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from planner.language.lexicon.lexicon import PHRASES, Lexicon
from planner.language.lexicon.politeness import ADVERBS
from planner.language.lexicon.settling import settled_uses
from planner.language.lexicon.terminals import ACTING, ASKING, Terminal
from planner.language.lexicon.words import NUMERALS
from planner.language.sentences.tagging import tagged
from planner.language.sentences.tokens import Word, words_of

NAMING_LEADS = (("name", "is"), ("is", "called"), ("called",), ("named",), ("known", "as"), ("call", "me"))
GIVING = frozenset({"bring", "give", "hand", "pass", "fetch", "get", "take", "lend", "offer", "show"})
"""Verbs that a receiver may follow, before the thing."""
DETERMINERS = frozenset({"the", "a", "an", "my", "his", "her", "our", "your", "their", "this", "that", "some", "any"})
HONORIFICS = frozenset(
    {"mister", "mr", "mr.", "mrs", "miss", "ms", "missus", "sir", "madam", "lady", "uncle", "aunt", "auntie"}
)
MAX_ROLE = 3
"""Words that tell what a person is, before the name."""


def sentences(text: str, lexicon: Lexicon) -> list[list[Terminal]]:
    """The sentences of a request, each as a list of terminals; courtesy is dropped."""
    typed_words = [Word(part, word.kind) for word in words_of(text) for part in _parted(word, lexicon)]
    typed_words = _respaced(typed_words, lexicon)
    words = [
        Word(_meant(typed_words, k, lexicon), "word") if word.kind == "word" and not _is_name(typed_words, k) else word
        for k, word in enumerate(typed_words)
    ]
    words = [word for word in _joined(words, lexicon) if word.kind != "word" or word.text not in ADVERBS]
    found: list[list[Terminal]] = [[]]
    for token in _owned(_by_name(settled_uses(tagged(words, lexicon), lexicon))):
        if token.type == "STOP":
            found.append([])
        elif token.type == "COMMA" and found[-1][-1:] and found[-1][-1].type == "COMMA":
            continue
        elif token.type not in ("FILLER", "FRAME"):
            found[-1].append(token)
    return [trimmed(sentence) for sentence in found if trimmed(sentence)]


def _meant(words: Sequence[Word], index: int, lexicon: Lexicon) -> str:
    """A word, or what it is a slip of; a small word is not looked for after an article."""
    typed_word = words[index].text
    slip = lexicon.meant(typed_word)
    if slip != typed_word:
        return typed_word if _is_stranger(words, index, slip, lexicon) else slip
    led = index > 0 and words[index - 1].text in DETERMINERS
    return typed_word if led else lexicon.small(typed_word)


def _respaced(words: Sequence[Word], lexicon: Lexicon) -> list[Word]:
    """*Bringt he*, *th estapler*: a space that came a letter too early or too late is put right."""
    kept: list[Word] = []
    for index, word in enumerate(words):
        pair = kept and kept[-1].kind == word.kind == "word" and not _is_name(words, index)
        one, other = lexicon.respaced(kept[-1].text, word.text) if pair else ("", word.text)
        kept[-1:] = [Word(one, "word")] if pair else kept[-1:]
        kept.append(Word(other, word.kind))
    return kept


def _is_name(words: Sequence[Word], index: int) -> bool:
    """Whether a word is what somebody or something is to be called: a name is taken as it was typed."""
    before = tuple(word.text for word in words[max(0, index - 3) : index])
    return any(before[-len(lead) :] == lead for lead in NAMING_LEADS)


def _is_stranger(words: Sequence[Word], index: int, slip: str, lexicon: Lexicon) -> bool:
    """*Bring Steve a muffin*, *and staple these*: who receives is no stove, and what is done no stapler."""
    given = index > 0 and words[index - 1].text in GIVING
    begins = index == 0 or words[index - 1].text in ("and", "then") or words[index - 1].kind != "word"
    thing = index + 1 < len(words) and words[index + 1].text in DETERMINERS | {"these", "those", "one"}
    named = lexicon.is_noun((slip,)) and (slip,) not in lexicon.persons
    return (given or begins) and thing and named and (slip,) not in PHRASES


def _joined(words: Sequence[Word], lexicon: Lexicon) -> list[Word]:
    """Compounds that were typed apart as one word each; *ward twelve* as *ward 12*."""
    kept: list[Word] = []
    for word in words:
        if kept and word.text in NUMERALS and lexicon.is_noun((kept[-1].text, NUMERALS[word.text])):
            kept.append(Word(NUMERALS[word.text], "word"))
            continue
        whole = lexicon.joined(kept[-1].text, word.text) if kept and kept[-1].kind == word.kind == "word" else ""
        kept[-1:] = [Word(whole, "word")] if whole else [*kept[-1:], word]
    return kept


def _parted(word: Word, lexicon: Lexicon) -> tuple[str, ...]:
    return lexicon.parted(word.text) if word.kind == "word" else (word.text,)


def _by_name(tokens: Sequence[Terminal]) -> list[Terminal]:
    """*My wife Rosa*, *the old porter Ben*, *mister Tom*: the name says who it is."""
    kept: list[Terminal] = []
    for token in tokens:
        if token.type == "NAME":
            start = len(kept)
            while (
                start > 0
                and len(kept) - start < MAX_ROLE
                and kept[start - 1].type in ("WORD", "PERSON", "SMALL", "BIG")
            ):
                start -= 1
            if start < len(kept) and start > 0 and kept[start - 1].type in ("THE", "MY", "HIS"):
                del kept[start - 1 :]
            elif kept and kept[-1].type == "WORD" and kept[-1].typed in HONORIFICS:
                kept.pop()
        kept.append(token)
    return kept


def _owned(tokens: Sequence[Terminal]) -> Iterator[Terminal]:
    """*Anna is in her office*: whose it is, when a name comes before."""
    name = ""
    for token in tokens:
        name = token.value if token.type == "NAME" else name
        yield Terminal("POSSESSIVE", f"{name}'s", token.typed) if token.type == "HIS" and name else token


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


def _starts_step(tokens: Sequence[Terminal], index: int) -> bool:
    """Whether a new step begins at ``index``: an action verb or a question word, after courtesy."""
    for place, token in enumerate(tokens[index:], start=index):
        if token.type in ("FILLER", "AND", "COMMA", "ALSO"):
            continue
        if token.type == "BACK" and place + 1 == len(tokens):
            return True
        if token.type == "BE" and place > index - 1 and tokens[index - 1].type == "AND" and not asks(tokens):
            return False
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
