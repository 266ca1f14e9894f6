"""From parse trees to references: noun phrases and pronouns of ``commands.lark``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token

from planner.language.grammar.agreement import apposed, may_except, may_follow
from planner.language.grammar.children import Children, has_word, number_of, tokens_of, values_of
from planner.language.grammar.restrictions import RestrictionReader
from planner.language.grammar.syntax import NounPhrase, Pronoun, Quantity, Reference, Restriction, Spot
from planner.language.lexicon.vocabulary import is_plural, singular

_SIZE = {"BIG": "big", "SMALL": "small"}
SUPERLATIVE = {
    "NEAREST": "nearest",
    "FARTHEST": "farthest",
    "LARGEST": "largest",
    "SMALLEST": "smallest",
    "LEFTMOST": "leftmost",
    "RIGHTMOST": "rightmost",
}
COMPARATIVE = {
    "bigger": "largest",
    "larger": "largest",
    "taller": "largest",
    "smaller": "smallest",
    "shorter": "smallest",
}
ORDINALS = {
    "first": 1, "1st": 1, "second": 2, "2nd": 2, "third": 3, "3rd": 3, "fourth": 4, "4th": 4, "fifth": 5, "5th": 5,
}  # fmt: skip


class PhraseReader(RestrictionReader):
    """One method a rule: how references are read."""

    def np(self, children: Children) -> NounPhrase:
        phrase = NounPhrase(words=())
        for part in values_of(children):
            phrase = replace(phrase, **_merged(phrase, part))
        if any(isinstance(child, Token) and child.type in ("OF", "ONE") for child in children):
            phrase = replace(phrase, quantity=Quantity.THE, count=None, **_of_several(phrase))
        return phrase if may_except(phrase) else replace(phrase, words=())

    def door_to(self, children: Children) -> NounPhrase:
        phrase = NounPhrase(words=("door",))
        *parts, reference = values_of(children)
        for part in parts:
            phrase = replace(phrase, **_merged(phrase, part))
        return replace(phrase, restrictions=(Restriction(relation="to", reference=reference),))

    def the(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.THE}

    def his(self, _: Children) -> dict[str, Any]:
        whose = Restriction(relation="of person", reference=Pronoun(word="him"))
        return {"quantity": Quantity.THE, "restrictions": (whose,)}

    def all_owned(self, children: Children) -> dict[str, Any]:
        return {**self.owned([child for child in children if child.type == "POSSESSIVE"]), "quantity": Quantity.ALL}

    def a(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.A, "count": 1}

    def this(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.THIS}

    def owned(self, children: Children) -> dict[str, Any]:
        owner = str(children[-1]).removesuffix("'s").removesuffix("'")
        reference = NounPhrase(words=tuple(owner.split()), quantity=Quantity.THE)
        return {"quantity": Quantity.THE, "restrictions": (Restriction(relation="of", reference=reference),)}

    def all_of(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.ALL}

    def both(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.BOTH, "count": 2}

    def some(self, children: Children) -> dict[str, Any]:
        return {"quantity": Quantity.SOME, "count": number_of(children)}

    def half(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.SOME, "share": "half"}

    def all_but(self, children: Children) -> dict[str, Any]:
        left = next(token for token in tokens_of(children) if token.type in ("NUMBER", "ONE"))
        return {"quantity": Quantity.SOME, "share": f"all but {'1' if left.type == 'ONE' else left}"}

    def exactly(self, children: Children) -> dict[str, Any]:
        return {"quantity": Quantity.EXACTLY, "count": number_of(children)}

    def modifier(self, children: Children) -> dict[str, Any]:
        (token,) = children
        if token.type in _SIZE:
            return {"sizes": (str(token) if str(token) in COMPARATIVE else _SIZE[token.type],)}
        if token.type in SUPERLATIVE:
            return {"superlative": SUPERLATIVE[token.type]}
        if token.type == "ORDINAL":
            return {"rank": ORDINALS[str(token)]}
        if token.type == "OTHER":
            return {"other": True}
        if token.type == "STATE":
            return {"restrictions": (Restriction(relation="state", word=str(token)),)}
        return {"colors": (str(token),)}

    def modifier_not(self, children: Children) -> dict[str, Any]:
        return {"restrictions": (Restriction(relation="color", word=str(children[-1]), negated=True),)}

    def modifier_either(self, children: Children) -> dict[str, Any]:
        colors = tuple(str(token) for token in children if token.type == "COLOR")
        return {"colors": colors, "either": True, **({} if has_word(children, "NOR") else {"quantity": Quantity.ALL})}

    def one_head(self, children: Children) -> dict[str, Any]:
        return {"words": (str(children[0]),)}

    def head(self, children: Children) -> dict[str, Any]:
        numbers = [int(token) for token in children if token.type == "NUMBER"]
        words = tuple(str(token) for token in children if token.type != "NUMBER")
        person = any(token.type in ("PERSON", "NAME") for token in children)
        return {"words": words, "number": numbers[0] if numbers else None, "person": person}

    def everything(self, children: Children) -> NounPhrase:
        phrase = NounPhrase(words=("things",), quantity=Quantity.ALL)
        for part in values_of(children):
            phrase = replace(phrase, **_merged(phrase, part))
        return phrase

    def headless(self, children: Children) -> NounPhrase:
        phrase = NounPhrase(words=("one",), quantity=Quantity.A if has_word(children, "A") else Quantity.THE)
        parts = values_of(children) or [{"other": True}]
        for part in parts:
            phrase = replace(phrase, **_merged(phrase, part))
        lone_orange = phrase.colors == ("orange",) and len(parts) == 1  # the fruit, not the color
        return replace(phrase, words=()) if lone_orange else phrase

    def bare_color(self, children: Children) -> NounPhrase:
        """*Except red*: those of that color."""
        return NounPhrase(words=("one",), quantity=Quantity.ALL, colors=(str(children[0]),))

    def whatever(self, children: Children) -> NounPhrase:
        phrase = NounPhrase(words=("things",), quantity=Quantity.THE)
        parts = values_of(children)
        if any(isinstance(part, dict) and "words" in part for part in parts):
            phrase = replace(phrase, quantity=Quantity.ALL)
        for part in parts:
            phrase = replace(phrase, **_merged(phrase, part))
        if has_word(children, "AND"):
            color = Restriction(relation="color", word=str(tokens_of(children)[-1]))
            phrase = replace(phrase, restrictions=(*phrase.restrictions, color))
        return phrase

    def whichever(self, children: Children) -> NounPhrase:
        """*whichever bedroom is nearest*."""
        phrase = NounPhrase(words=(), quantity=Quantity.THE)
        for part in values_of(children):
            phrase = replace(phrase, **_merged(phrase, part))
        return phrase

    def apposed(self, children: Children) -> NounPhrase:
        """*the cup, the red one*: one thing, said twice."""
        first, *rest = apposed(*values_of(children))
        return first if isinstance(first, NounPhrase) and not rest else NounPhrase(words=())

    def exception(self, children: Children) -> tuple[str, tuple[Reference, ...]]:
        return ("exceptions", tuple(values_of(children)))

    def spot(self, children: Children) -> Spot:
        return Spot(thing=values_of(children)[0], past="was" in tokens_of(children) or "were" in tokens_of(children))

    def held(self, _: Children) -> NounPhrase:
        return NounPhrase(words=("thing",), quantity=Quantity.THE, restrictions=(Restriction(relation="held"),))

    def owner(self, children: Children) -> Reference:
        return self.recipient(children)

    def pronoun(self, children: Children) -> Pronoun:
        several = str(children[0]) in ("them", "they", "those ones", "these ones")
        return Pronoun(word="them" if several else children[0].type.lower())

    def person_at(self, children: Children) -> NounPhrase:
        """*To me at the reception*: the person, who is known to be there."""
        tokens = tokens_of(children)
        where = Restriction(relation=str(tokens[-1].type).lower(), reference=values_of(children)[0])
        return NounPhrase(words=(tokens[0].type.lower(),), quantity=Quantity.THE, person=True, restrictions=(where,))

    def of_them(self, children: Children) -> NounPhrase:
        """*Two of them*: any two of what was spoken of."""
        spoken = (Restriction(relation="spoken", reference=Pronoun(word="them")),)
        several = NounPhrase(words=("things",), quantity=Quantity.SOME, restrictions=spoken)
        number = next((int(token) for token in tokens_of(children) if token.type == "NUMBER"), None)
        if number is not None:
            return replace(several, count=number)
        if has_word(children, "HALF"):
            return replace(several, share="half")
        return replace(several, words=("thing",), quantity=Quantity.A, count=1)

    def it(self, children: Children) -> Pronoun:
        if len(children) > 1:
            return Pronoun(word="both" if has_word(children, "BOTH") else "them")
        if children[0].type == "IT":
            return self.pronoun(children)
        return Pronoun(word={"THIS": "that", "BOTH": "both", "ALL": "all"}.get(children[0].type, "it"))

    def things(self, children: Children) -> tuple[Reference, ...]:
        values = values_of(children)
        kinds = [token.type for token in tokens_of(children)]
        if kinds[:1] == ["BOTH"] and isinstance(values[0], NounPhrase) and is_plural(values[0].head):
            return (NounPhrase(words=()),)
        if kinds == ["COMMA"] and len(values) == 2:
            return apposed(*values) if may_follow(*values) else (NounPhrase(words=()),)
        return tuple(values)

    def recipient(self, children: Children) -> Reference:
        token = children[-1]
        if token.type in ("ME", "HIM"):
            return Pronoun(word=token.type.lower())
        return NounPhrase(words=(str(token),), quantity=Quantity.THE, person=True)

    def stranger(self, children: Children) -> NounPhrase:
        return NounPhrase(words=tuple(map(str, children)), quantity=Quantity.THE, person=True)


def _of_several(phrase: NounPhrase) -> dict[str, Any]:
    """*The bigger of the two cups*: one of them; of a comparative, the one at that end."""
    one = {"words": (*phrase.words[:-1], singular(phrase.words[-1]))} if phrase.words else {}
    comparative = {"big": "largest", "small": "smallest", **COMPARATIVE}
    ends = [comparative[size] for size in phrase.sizes if size in comparative]
    return one | ({"superlative": ends[0], "sizes": ()} if ends else {})


def _merged(phrase: NounPhrase, part: Any) -> dict[str, Any]:
    if isinstance(part, Restriction):
        return {"restrictions": (*phrase.restrictions, part)}
    if isinstance(part, tuple):
        return {part[0]: part[1]}
    merged = dict(part)
    for name in ("colors", "sizes", "restrictions"):
        if name in merged:
            merged[name] = (*getattr(phrase, name), *merged[name])
    return merged
