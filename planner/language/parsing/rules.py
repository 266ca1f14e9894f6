"""A grammar in Lark's notation as a chart parser wants it: its rules by what they begin with, symbols as numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from lark import Lark
from lark.grammar import Rule as LarkRule
from lark.lexer import Lexer, PatternStr


@dataclass(frozen=True, kw_only=True)
class Rule:
    """One rule without alternatives.

    ``left``: the symbol it makes. ``right``: what it is made of. ``action``: the name of its meaning, empty where what
    it is made of stands for itself. ``kept``: which of ``right`` the meaning sees; words that only hold a construction
    together are not among them. ``inlined``: its parts become parts of whatever it is a part of. ``cost``: how
    far-fetched it is.
    """

    left: int
    right: tuple[int, ...]
    action: str
    kept: tuple[bool, ...]
    inlined: bool
    cost: int


class _NoLexer(Lexer):
    """Lark reads the grammar and never a text."""

    __future_interface__ = 1

    def __init__(self, lexer_conf: Any) -> None:
        pass

    def lex(self, lexer_state: Any, parser_state: Any = None) -> Iterator[Any]:
        del lexer_state, parser_state
        return iter(())


class Rules:
    """All rules of a grammar. No rule is empty, and none comes back to its own symbol by single parts."""

    def __init__(self, source: str, starts: Iterable[str], packed: Iterable[str] = ()) -> None:
        """Reads ``source``; a priority in it, ``rule.3``, is the cost of the rule. ``packed``: see ``chart.Packed``."""
        lark = Lark(
            source,
            parser="earley",
            lexer=_NoLexer,
            start=list(starts),
            maybe_placeholders=False,
            priority="normal",
        )
        self.packed = frozenset(packed)
        names = sorted({symbol.name for rule in lark.rules for symbol in (rule.origin, *rule.expansion)})
        self.numbers: Mapping[str, int] = {name: number for number, name in enumerate(names)}
        self.names = names
        literals = {terminal.name: terminal.pattern for terminal in lark.terminals}
        self.literals: Mapping[str, int] = {
            pattern.value: self.numbers[name]
            for name, pattern in literals.items()
            if isinstance(pattern, PatternStr) and name in self.numbers
        }
        self.rules = tuple(self._rule(rule) for rule in lark.rules)

    def _rule(self, rule: LarkRule) -> Rule:
        name = rule.alias or rule.origin.name
        single = rule.options.expand1 and len(rule.expansion) == 1 and not rule.alias
        inlined = rule.origin.name.startswith("_")
        return Rule(
            left=self.numbers[rule.origin.name],
            right=tuple(self.numbers[symbol.name] for symbol in rule.expansion),
            action="" if inlined or single else name,
            kept=tuple(not getattr(symbol, "filter_out", False) for symbol in rule.expansion),
            inlined=inlined,
            cost=rule.options.priority or 0,
        )

    @cached_property
    def made(self) -> frozenset[int]:
        """The symbols that rules make, which are no words."""
        return frozenset(rule.left for rule in self.rules)

    @cached_property
    def beginning(self) -> Mapping[int, tuple[tuple[int, int], ...]]:
        """By the symbol that rules begin with: their numbers and the symbols that they make."""
        found: dict[int, list[tuple[int, int]]] = {}
        for number, rule in enumerate(self.rules):
            found.setdefault(rule.right[0], []).append((number, rule.left))
        return {symbol: tuple(rules) for symbol, rules in found.items()}

    @cached_property
    def inlined(self) -> frozenset[int]:
        """Symbols whose parts become parts of whatever they are a part of."""
        return frozenset(symbol for symbol in self.made if self.names[symbol].startswith("_"))

    @cached_property
    def corners(self) -> tuple[int, ...]:
        """For each symbol, as bits, every symbol that it may begin with, itself among them."""
        below = [1 << number for number in range(len(self.names))]
        changed = True
        while changed:
            changed = False
            for rule in self.rules:
                wider = below[rule.left] | below[rule.right[0]]
                changed = changed or wider != below[rule.left]
                below[rule.left] = wider
        return tuple(below)

    @cached_property
    def ranks(self) -> tuple[int, ...]:
        """For each symbol how many single steps of rules lie below it: the order in which a span is completed."""
        single: dict[int, list[int]] = {}
        for rule in self.rules:
            if len(rule.right) == 1:
                single.setdefault(rule.left, []).append(rule.right[0])
        ranks: dict[int, int] = {}

        def rank(symbol: int, above: tuple[int, ...] = ()) -> int:
            if symbol in above:
                chain = " → ".join(self.names[number] for number in (*above, symbol))
                raise ValueError(f"the grammar comes back to a symbol by single parts: {chain}")
            if symbol not in ranks:
                ranks[symbol] = 1 + max((rank(part, (*above, symbol)) for part in single.get(symbol, ())), default=-1)
            return ranks[symbol]

        return tuple(rank(symbol) for symbol in range(len(self.names)))
