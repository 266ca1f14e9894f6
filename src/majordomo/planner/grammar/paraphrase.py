"""One wording for many: sentence frames and set phrases are rewritten before words are told apart.

The rules of ``wording`` work on lower-case text with contractions written out. Each says the same in words that the
grammar knows.
"""

from __future__ import annotations

import re
from functools import lru_cache

from majordomo.planner.grammar.wording.about_robot import ABOUT_ROBOT
from majordomo.planner.grammar.wording.addressing import ADDRESSING
from majordomo.planner.grammar.wording.amounts import AMOUNTS
from majordomo.planner.grammar.wording.asking import ASKING
from majordomo.planner.grammar.wording.beyond import BEYOND
from majordomo.planner.grammar.wording.bringing import BRINGING
from majordomo.planner.grammar.wording.choosing import CHOOSING
from majordomo.planner.grammar.wording.coloring import COLORING
from majordomo.planner.grammar.wording.conditions import CONDITIONS
from majordomo.planner.grammar.wording.courtesy import COURTESY, SLIPS, UNDOING
from majordomo.planner.grammar.wording.dictating import DICTATING
from majordomo.planner.grammar.wording.discarding import DISCARDING
from majordomo.planner.grammar.wording.foreign import FOREIGN
from majordomo.planner.grammar.wording.going import FINDING, GOING
from majordomo.planner.grammar.wording.heading import HEADING
from majordomo.planner.grammar.wording.holding import HOLDING
from majordomo.planner.grammar.wording.inquiring import INQUIRING
from majordomo.planner.grammar.wording.knowing import KNOWING
from majordomo.planner.grammar.wording.learning import LEARNING
from majordomo.planner.grammar.wording.motives import MOTIVES
from majordomo.planner.grammar.wording.naming import NAMING
from majordomo.planner.grammar.wording.offhand import OFFHAND, SCOLDING
from majordomo.planner.grammar.wording.placing import PLACING
from majordomo.planner.grammar.wording.relating import RELATING
from majordomo.planner.grammar.wording.renaming import RENAMING
from majordomo.planner.grammar.wording.returning import BACK, RETURNING
from majordomo.planner.grammar.wording.sending import SENDING
from majordomo.planner.grammar.wording.slips import MISTYPED
from majordomo.planner.grammar.wording.sorting import SORTING
from majordomo.planner.grammar.wording.undoing import TAKING_BACK
from majordomo.planner.grammar.wording.visiting import VISITING
from majordomo.planner.grammar.wording.wishing import WISHING

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
