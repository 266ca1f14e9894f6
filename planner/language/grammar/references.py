"""From parse trees to references: noun phrases, pronouns and restrictions of ``commands.lark``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token, Transformer

from planner.language.grammar.agreement import apposed, may_except, may_follow
from planner.language.grammar.syntax import NounPhrase, Pronoun, Quantity, Reference, Restriction, Spot
from planner.language.lexicon.vocabulary import is_plural, singular

Children = list[Any]
_SIZE = {"BIG": "big", "SMALL": "small"}
SUPERLATIVE = {
    "NEAREST": "nearest",
    "FARTHEST": "farthest",
    "LARGEST": "largest",
    "SMALLEST": "smallest",
    "LEFTMOST": "leftmost",
    "RIGHTMOST": "rightmost",
}
_COMPARATIVE = {
    "bigger": "largest",
    "larger": "largest",
    "taller": "largest",
    "smaller": "smallest",
    "shorter": "smallest",
}
ORDINALS = {
    "first": 1, "1st": 1, "second": 2, "2nd": 2, "third": 3, "3rd": 3, "fourth": 4, "4th": 4, "fifth": 5, "5th": 5,
}  # fmt: skip


def values_of(children: Children) -> Children:
    """What has been read already, without the words."""
    return [child for child in children if not isinstance(child, Token)]


def tokens_of(children: Children) -> list[Token]:
    """The words, without what has been read already."""
    return [child for child in children if isinstance(child, Token)]


class PhraseReader(Transformer[Token, Any]):
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
        return {"quantity": Quantity.SOME, "count": _number(children)}

    def half(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.SOME, "share": "half"}

    def all_but(self, children: Children) -> dict[str, Any]:
        left = next(token for token in tokens_of(children) if token.type in ("NUMBER", "ONE"))
        return {"quantity": Quantity.SOME, "share": f"all but {'1' if left.type == 'ONE' else left}"}

    def exactly(self, children: Children) -> dict[str, Any]:
        return {"quantity": Quantity.EXACTLY, "count": _number(children)}

    def modifier(self, children: Children) -> dict[str, Any]:
        (token,) = children
        if token.type in _SIZE:
            return {"sizes": (str(token) if str(token) in _COMPARATIVE else _SIZE[token.type],)}
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
        return {"colors": colors, "either": True, **({} if _has(children, "NOR") else {"quantity": Quantity.ALL})}

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
        phrase = NounPhrase(words=("one",), quantity=Quantity.A if _has(children, "A") else Quantity.THE)
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
        if _has(children, "AND"):
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

    def relation(self, children: Children) -> str:
        token = children[0]
        names: dict[str, str] = {"ONTO": "on", "INTO": "in", "OFF": "from", "BESIDE": str(token)}
        if str(token) == "out of":
            return "out of"
        return names.get(token.type, str(token.type).lower())

    def restriction(self, children: Children) -> Restriction:
        relation, reference = values_of(children)
        return Restriction(relation=relation, reference=reference)

    def told(self, children: Children) -> Restriction:
        """*the book Ben left on the desk*: who left it there says nothing about where it is."""
        relation = str(tokens_of(children)[-1].type).lower()
        return Restriction(relation=relation, reference=values_of(children)[0])

    def things_two(self, children: Children) -> tuple[Reference, Reference]:
        one, other = values_of(children)
        return one, other

    def restricted_between(self, children: Children) -> Restriction:
        relation, (one, other) = values_of(children)
        return Restriction(relation=relation, reference=one, other=other)

    def restricted_not(self, children: Children) -> Restriction:
        return replace(self.restriction(children), negated=True)

    def restricted_nor(self, children: Children) -> dict[str, Any]:
        """*that is not on the counter or in the box*."""
        relations = [value for value in values_of(children) if isinstance(value, str)]
        references = [value for value in values_of(children) if not isinstance(value, str)]
        pairs = zip((relations[0], relations[-1]), references, strict=True)
        return {"restrictions": tuple(Restriction(relation=r, reference=x, negated=True) for r, x in pairs)}

    def restricted_and_color(self, children: Children) -> dict[str, Any]:
        """*that is on the desk and red*."""
        color = Restriction(relation="color", word=str(tokens_of(children)[-1]))
        return {"restrictions": (self.restriction(children), color)}

    def restricted_color(self, children: Children) -> Restriction:
        token = next(child for child in children if child.type in ("COLOR", "ORANGE"))
        return Restriction(relation="color", word=str(token))

    def restricted_not_color(self, children: Children) -> Restriction:
        return replace(self.restricted_color(children), negated=True)

    def restricted_state(self, children: Children) -> Restriction:
        return Restriction(relation="state", word=str(children[-1]), negated=_has(children, "NOT"))

    def restricted_with(self, children: Children) -> Restriction:
        return Restriction(relation="with", reference=values_of(children)[0])

    def restricted_without(self, children: Children) -> Restriction:
        """*The bedroom where Ben is not*."""
        return replace(self.restricted_with(children), negated=True)

    def restricted_same_room(self, children: Children) -> Restriction:
        return Restriction(relation="same room", reference=values_of(children)[0])

    def restricted_here(self, _: Children) -> Restriction:
        return Restriction(relation="here")

    def restricted_there(self, _: Children) -> Restriction:
        return Restriction(relation="there")

    def restricted_held(self, _: Children) -> Restriction:
        return Restriction(relation="held")

    def restricted_floor(self, _: Children) -> Restriction:
        return Restriction(relation="floor")

    def restricted_farthest(self, children: Children) -> Restriction:
        return Restriction(relation="farthest", reference=values_of(children)[0])

    def owner(self, children: Children) -> Reference:
        return self.recipient(children)

    def restricted_owned(self, children: Children) -> Restriction:
        return Restriction(relation="of person", reference=values_of(children)[0])

    def restricted_is(self, children: Children) -> Restriction:
        return Restriction(relation="is", reference=values_of(children)[0])

    def restricted_is_not(self, children: Children) -> Restriction:
        return replace(self.restricted_is(children), negated=True)

    def sort(self, children: Children) -> NounPhrase:
        return NounPhrase(words=tuple(str(token) for token in children if token.type != "A"))

    def restricted_sort(self, children: Children) -> Restriction:
        """*Everything that is a can*, *a fruit that is not a banana*."""
        return Restriction(relation="sort", reference=values_of(children)[0], negated=_has(children, "NOT"))

    def restricted_kind(self, children: Children) -> Restriction:
        return Restriction(relation="kind", reference=values_of(children)[0])

    def restricted_neither(self, children: Children) -> dict[str, Any]:
        colors = [str(token) for token in tokens_of(children) if token.type in ("COLOR", "ORANGE")]
        return {"restrictions": tuple(Restriction(relation="color", word=c, negated=True) for c in colors)}

    def restricted_nearest(self, children: Children) -> Restriction:
        return Restriction(relation="nearest", reference=values_of(children)[0])

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
        if _has(children, "HALF"):
            return replace(several, share="half")
        return replace(several, words=("thing",), quantity=Quantity.A, count=1)

    def it(self, children: Children) -> Pronoun:
        if len(children) > 1:
            return Pronoun(word="both" if _has(children, "BOTH") else "them")
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


def _has(children: Children, kind: str) -> bool:
    return any(isinstance(child, Token) and child.type == kind for child in children)


def _of_several(phrase: NounPhrase) -> dict[str, Any]:
    """*The bigger of the two cups*: one of them; of a comparative, the one at that end."""
    one = {"words": (*phrase.words[:-1], singular(phrase.words[-1]))} if phrase.words else {}
    comparative = {"big": "largest", "small": "smallest", **_COMPARATIVE}
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


def _number(children: Children) -> int:
    return next(int(token) for token in tokens_of(children) if token.type == "NUMBER")
