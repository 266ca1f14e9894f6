"""One wording for many: sentence frames and set phrases are rewritten before words are told apart.

The rules of ``wording`` work on lower-case text with contractions written out. Each says the same in words that the
grammar knows.
"""

from __future__ import annotations

import re
from functools import lru_cache

from planner.language.paraphrase.carrying.amounts import AMOUNTS
from planner.language.paraphrase.carrying.bringing import BRINGING
from planner.language.paraphrase.carrying.discarding import DISCARDING
from planner.language.paraphrase.carrying.holding import HOLDING
from planner.language.paraphrase.carrying.placing import PLACING
from planner.language.paraphrase.carrying.returning import BACK, RETURNING
from planner.language.paraphrase.carrying.sorting import SORTING
from planner.language.paraphrase.carrying.undoing import TAKING_BACK
from planner.language.paraphrase.moving.going import FINDING, GOING
from planner.language.paraphrase.moving.sending import SENDING
from planner.language.paraphrase.moving.visiting import VISITING
from planner.language.paraphrase.questions.about_robot import ABOUT_ROBOT
from planner.language.paraphrase.questions.asking import ASKING
from planner.language.paraphrase.questions.beyond import BEYOND
from planner.language.paraphrase.questions.conditions import CONDITIONS
from planner.language.paraphrase.questions.inquiring import INQUIRING
from planner.language.paraphrase.questions.knowing import KNOWING
from planner.language.paraphrase.reference.choosing import CHOOSING
from planner.language.paraphrase.reference.coloring import COLORING
from planner.language.paraphrase.reference.naming import NAMING
from planner.language.paraphrase.reference.relating import RELATING
from planner.language.paraphrase.reference.renaming import RENAMING
from planner.language.paraphrase.talk.addressing import ADDRESSING
from planner.language.paraphrase.talk.courtesy import COURTESY, SLIPS, UNDOING
from planner.language.paraphrase.talk.dictating import DICTATING
from planner.language.paraphrase.talk.foreign import FOREIGN
from planner.language.paraphrase.talk.heading import HEADING
from planner.language.paraphrase.talk.learning import LEARNING
from planner.language.paraphrase.talk.motives import MOTIVES
from planner.language.paraphrase.talk.offhand import OFFHAND, SCOLDING
from planner.language.paraphrase.talk.slips import MISTYPED
from planner.language.paraphrase.talk.wishing import WISHING

RULES: tuple[tuple[str, str], ...] = (
    *(
        *MISTYPED,
        *SCOLDING,
        *DICTATING,
        *ADDRESSING,
        *OFFHAND,
        *BEYOND,
        *LEARNING,
        *FOREIGN,
        *TAKING_BACK,
        *AMOUNTS,
        *COLORING,
        *RETURNING,
        *SORTING,
        *SENDING,
        *VISITING,
        *HEADING,
        *SLIPS,
        *MOTIVES,
        *HOLDING,
        *PLACING,
        *RELATING,
        *COURTESY,
        *UNDOING,
        *ABOUT_ROBOT,
        *KNOWING,
        *INQUIRING,
        *WISHING,
        *DISCARDING,
        *BRINGING,
        *CHOOSING,
        *RENAMING,
        *NAMING,
        *ASKING,
        *FINDING,
        *GOING,
        *CONDITIONS,
    ),
)
"""Pattern and replacement, in the order in which they are tried."""
_MAX_CHARACTERS = 600
_COMPILED = tuple((re.compile(pattern), said) for pattern, said in RULES)


@lru_cache(maxsize=256)
def paraphrased(text: str) -> str:
    """``text`` in the words of the grammar, as far as the rules know."""
    if '"' in text or len(text) > _MAX_CHARACTERS:
        return text
    for pattern, said in _COMPILED:
        text = pattern.sub(said, text)
    text = BACK.sub(r"\1 back where it was", text)
    text = re.sub(r"\b(?:leave|set|place|drop) ([^,.;]+? back where it was)", r"put \1", text)
    text = re.sub(r"\b(back where it was), (?:in|on|at|to) [^,.;!?]+(?=$|[.!?])", r"\1", text)
    text = text.replace(" away back where it was", " back where it was")
    return " ".join(text.split()) if "\n" not in text else text
