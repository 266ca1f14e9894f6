"""From parse trees to references: noun phrases, pronouns and restrictions of ``commands.lark``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token, Transformer

from majordomo.planner.grammar.syntax import NounPhrase, Pronoun, Quantity, Reference, Restriction
from majordomo.planner.vocabulary import is_plural

Children = list[Any]
_SIZE = {"BIG": "big", "SMALL": "small"}
_SUPERLATIVE = {"NEAREST": "nearest", "LARGEST": "largest", "SMALLEST": "smallest"}


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
        for part in children:
            phrase = replace(phrase, **_merged(phrase, part))
        return phrase

    def the(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.THE}

    def a(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.A, "count": 1}

    def this(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.THIS}

    def all_of(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.ALL}

    def both(self, _: Children) -> dict[str, Any]:
        return {"quantity": Quantity.BOTH, "count": 2}

    def some(self, children: Children) -> dict[str, Any]:
        return {"quantity": Quantity.SOME, "count": _number(children)}

    def exactly(self, children: Children) -> dict[str, Any]:
        return {"quantity": Quantity.EXACTLY, "count": _number(children)}

    def modifier(self, children: Children) -> dict[str, Any]:
        (token,) = children
        if token.type in _SIZE:
            return {"sizes": (_SIZE[token.type],)}
        if token.type in _SUPERLATIVE:
            return {"superlative": _SUPERLATIVE[token.type]}
        return {"colors": (str(token),)}

    def head(self, children: Children) -> dict[str, Any]:
        numbers = [int(token) for token in children if token.type == "NUMBER"]
        words = tuple(str(token) for token in children if token.type != "NUMBER")
        person = any(token.type in ("PERSON", "NAME") for token in children)
        return {"words": words, "number": numbers[0] if numbers else None, "person": person}

    def everything(self, children: Children) -> NounPhrase:
        restrictions = values_of(children)
        return NounPhrase(
            words=("things",), quantity=Quantity.ALL, restriction=restrictions[0] if restrictions else None
        )

    def held(self, _: Children) -> NounPhrase:
        return NounPhrase(words=("thing",), quantity=Quantity.THE, restriction=Restriction(relation="held"))

    def relation(self, children: Children) -> str:
        token = children[0]
        names: dict[str, str] = {"ONTO": "on", "INTO": "in", "BESIDE": str(token)}
        return names.get(token.type, str(token.type).lower())

    def restriction(self, children: Children) -> Restriction:
        relation, reference = values_of(children)
        return Restriction(relation=relation, reference=reference)

    def restricted_here(self, _: Children) -> Restriction:
        return Restriction(relation="here")

    def restricted_there(self, _: Children) -> Restriction:
        return Restriction(relation="there")

    def restricted_held(self, _: Children) -> Restriction:
        return Restriction(relation="held")

    def restricted_nearest(self, children: Children) -> Restriction:
        return Restriction(relation="nearest", reference=values_of(children)[0])

    def pronoun(self, children: Children) -> Pronoun:
        return Pronoun(word=children[0].type.lower())

    def it(self, _: Children) -> Pronoun:
        return Pronoun(word="it")

    def things(self, children: Children) -> tuple[Reference, ...]:
        return tuple(values_of(children))

    def recipient(self, children: Children) -> Reference:
        token = children[-1]
        if token.type in ("ME", "HIM"):
            return Pronoun(word=token.type.lower())
        return NounPhrase(words=(str(token),), quantity=Quantity.THE, person=True)

    def stranger(self, children: Children) -> NounPhrase:
        return NounPhrase(words=(str(children[0]),), quantity=Quantity.THE, person=True)


def _merged(phrase: NounPhrase, part: dict[str, Any] | Restriction) -> dict[str, Any]:
    if isinstance(part, Restriction):
        return {"restriction": part}
    merged = dict(part)
    for name in ("colors", "sizes"):
        if name in merged:
            merged[name] = (*getattr(phrase, name), *merged[name])
    return merged


def _number(children: Children) -> int:
    return next(int(token) for token in tokens_of(children) if token.type == "NUMBER")


def is_sensible(phrase: NounPhrase) -> bool:
    """Whether number and noun agree: *both the cup* is not English, so such a reading is dropped."""
    if phrase.quantity in (Quantity.BOTH, Quantity.EXACTLY) and (phrase.count or 0) > 1:
        return is_plural(phrase.words[-1]) or phrase.words[-1] in ("ones", "people")
    return True
