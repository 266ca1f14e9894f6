"""What a rule of ``commands.lark`` is made of: words, and what has been read of it already."""

from __future__ import annotations

from typing import Any

from lark import Token

Children = list[Any]


def values_of(children: Children) -> Children:
    """What has been read already, without the words."""
    return [child for child in children if not isinstance(child, Token)]


def tokens_of(children: Children) -> list[Token]:
    """The words, without what has been read already."""
    return [child for child in children if isinstance(child, Token)]


def has_word(children: Children, kind: str) -> bool:
    """Whether a word of this kind is among them."""
    return any(isinstance(child, Token) and child.type == kind for child in children)


def number_of(children: Children) -> int:
    """The first number among them."""
    return next(int(token) for token in tokens_of(children) if token.type == "NUMBER")
