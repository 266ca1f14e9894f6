"""From parse trees to restrictions: *on the table*, *that is not red*, *nearest to the door*."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from lark import Token, Transformer

from planner.language.grammar.children import Children, has_word, tokens_of, values_of
from planner.language.grammar.syntax import NounPhrase, Reference, Restriction


class RestrictionReader(Transformer[Token, Any]):
    """One method a rule: how what narrows a noun phrase is read."""

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
        return Restriction(relation="state", word=str(children[-1]), negated=has_word(children, "NOT"))

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
        return Restriction(relation="sort", reference=values_of(children)[0], negated=has_word(children, "NOT"))

    def restricted_kind(self, children: Children) -> Restriction:
        return Restriction(relation="kind", reference=values_of(children)[0])

    def restricted_neither(self, children: Children) -> dict[str, Any]:
        colors = [str(token) for token in tokens_of(children) if token.type in ("COLOR", "ORANGE")]
        return {"restrictions": tuple(Restriction(relation="color", word=c, negated=True) for c in colors)}

    def restricted_nearest(self, children: Children) -> Restriction:
        return Restriction(relation="nearest", reference=values_of(children)[0])
