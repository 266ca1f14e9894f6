"""From characters to words: quotes, contractions, punctuation; nothing is dropped that could carry meaning."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from planner.language.lexicon.words import CONTRACTIONS
from planner.language.paraphrase.paraphrase import paraphrased
from planner.language.sentences.tidying import spelled_out

MAX_CHARACTERS = 10_000

_TOKEN = re.compile(
    r"""
    "(?P<quoted>[^"]{1,80})"                  # a name in quotation marks is one noun
  | (?P<word>[^\W_]+(?:[_'\-][^\W_]+)*'?)     # letters and digits, joined by _ ' -
  | (?P<comma>,)
  | (?P<stop>[.;!?:]+|\n)
  | (?P<junk>\S)
    """,
    re.VERBOSE,
)
_MYSELF = re.compile(r"\b[Ii](?:'m| am) (?=[A-Z][a-z]+(?:[.,!]|$| by the way))")
"""*I'm Henry*, with a capital: a name, not how one feels."""
_WORD = re.compile(r"[^\W_]+(?:[_'\-][^\W_]+)*'?")
_NON = re.compile(r"\bnon-(?=\w)")
_COLORED = re.compile(r"(?<=\w)[- ](?:colou?red|covered|bound|lidded|label(?:l)?ed|capped|painted)\b")
_LISTED = re.compile(r"(?:(?<=^)|(?<=[\s.,;:]))(\d{1,2}[.)]|[-*•])\s+(?=[^\W\d_])")
_QUOTES = str.maketrans({"’": "'", "‘": "'", "“": '"', "”": '"', "„": '"', "`": "'"})


@dataclass(frozen=True)
class Word:
    """One word of a request in lower case; ``kind`` is ``word``, ``quoted``, ``comma``, ``stop`` or ``junk``."""

    text: str
    kind: str


def text_flaw(text: str) -> str | None:
    """What forbids reading ``text`` at all: empty, too long, or control characters; a sentence, or None."""
    if not text.strip():
        return "The request is empty. Tell me what to do, or ask a question."
    if len(text) > MAX_CHARACTERS:
        return f"The request has {len(text)} characters; I read at most {MAX_CHARACTERS}. Please say it shorter."
    if any(unicodedata.category(char) in ("Cc", "Cs", "Co") and char not in "\n\r\t" for char in text):
        return "The request contains control characters. Please send plain text."
    return None


def words_of(text: str) -> list[Word]:
    """Split ``text`` into words, lower case, contractions written out."""
    clean = unicodedata.normalize("NFKC", text).translate(_QUOTES)
    clean = _MYSELF.sub("my name is ", clean).casefold().strip()
    if clean.count('"') == 2 and clean.startswith('"') and clean.endswith('"'):
        clean = clean[1:-1]
    clean = _COLORED.sub("", _NON.sub("not ", clean))
    clean = paraphrased(_WORD.sub(lambda found: CONTRACTIONS.get(found[0], found[0]), clean))
    clean = spelled_out(clean)
    if len(_LISTED.findall(clean)) > 1:
        clean = _LISTED.sub("; ", clean)
    words: list[Word] = []
    for match in _TOKEN.finditer(clean):
        kind = match.lastgroup or "junk"
        content = match.group(kind)
        if kind == "word":
            words += [Word(part, "word") for part in CONTRACTIONS.get(content, content).split()]
        else:
            words.append(Word(" ".join(content.split()), kind))
    return words
