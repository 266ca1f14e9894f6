"""Which of several candidates is spoken of, in whatever sentence: *I think it was yellow*, *she likes pink*."""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner.dialogue.settings import DialogueSettings
from planner.grounding.grounding import Grounding
from planner.language.lexicon.lexicon import Lexicon
from planner.language.lexicon.verbs import VERBS
from planner.language.lexicon.vocabulary import COLORS, normal, singular
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot

_ACTING = frozenset(phrase for phrases in VERBS.values() for phrase in phrases if " " not in phrase) - {"like", "pass"}
_UNDECIDED = frozenset(
    {"not", "no", "never", "nor", "neither", "either", "or", "and", "but", "except", "both", "all", "none", "other",
     "another", "instead", "if", "where", "what", "who", "how", "why", "which", "when", "than", "without", "dislikes",
     "hates", "hate", "dislike", "doesn't", "don't", "isn't", "wasn't", "cannot", "can't", "won't", "didn't", "aren't"}
)  # fmt: skip
"""Words that deny, join, ask or compare: nothing is chosen by a sentence with one of them."""
_EMPTY = frozenset({"one", "ones", "thing", "things", "it", "that", "this", "these", "those", "place"})


def the_one_described(
    answer: str,
    candidates: Sequence[str],
    lexicon: Lexicon,
    grounding: Grounding,
    settings: DialogueSettings = DialogueSettings(),
) -> tuple[str, ...]:
    """The one candidate that fits every color, thing, room and person in ``answer``; empty if there is not just one."""
    fitting = described(answer, candidates, lexicon, grounding, settings)
    return fitting if len(fitting) == 1 else ()


def described(
    answer: str,
    candidates: Sequence[str],
    lexicon: Lexicon,
    grounding: Grounding,
    settings: DialogueSettings = DialogueSettings(),
) -> tuple[str, ...]:
    """All candidates that fit every color, thing, room and person in ``answer``.

    An answer that acts, denies, joins or asks chooses nothing; nor does one that speaks of nothing that is known.
    """
    words = re.findall(r"[a-z']+", answer.casefold().replace("’", "'"))
    if len(words) > settings.choice_words or _UNDECIDED & set(words) or _ACTING & set(words):
        return ()
    telling = [word for word in words if word not in _EMPTY and _tells(word, lexicon)]
    return tuple(i for i in candidates if all(_fits(word, i, grounding) for word in telling)) if telling else ()


def _tells(word: str, lexicon: Lexicon) -> bool:
    """Whether a word may name or describe something of the graph or the vocabulary."""
    known = lexicon.is_noun((word,)) or word in lexicon.parts or singular(word) in lexicon.parts
    return known or word in COLORS or (word,) in lexicon.persons


def _fits(word: str, node_id: str, grounding: Grounding) -> bool:
    """Whether a word says something true of a node, or of what it stands on or in."""
    snapshot = grounding.snapshot
    around = (node_id, snapshot.support_of(node_id), grounding.state.room_of(node_id))
    told = {part for i in around if i is not None for part in _words_for(i, snapshot)}
    color = COLORS.get(word)
    if color is not None and color in told:
        return True
    named = grounding.names.named(word, None, widely=True)
    return bool({word, singular(word)} & told) or any(i in named for i in around if i is not None)


def _words_for(node_id: str, snapshot: Snapshot) -> set[str]:
    node = snapshot.get(node_id)
    if isinstance(node, ObjectNode):
        told = " ".join((node.color, *node.accents, node.label, node.name))
    elif isinstance(node, RoomNode):
        told = node.label or ""
    else:
        told = node.name if isinstance(node, PersonNode) else ""
    return {COLORS.get(word, word) for word in normal(told).split()}
