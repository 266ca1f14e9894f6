"""Further corridors for a building, seeded: many rooms of a kind, stocked with what is usual there."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

FIRST = 100
"""Numbers of rooms and things of the extension begin here, so that those written by hand keep theirs."""
COLORS = ("red", "blue", "green", "black", "white", "gray", "yellow", "brown", "silver")
ROOMS_PER_CORRIDOR = 24


@dataclass(frozen=True, kw_only=True)
class Furnishing:
    """How a kind of room is furnished: pieces of furniture, each with the kinds and the greatest number of things."""

    label: str
    pieces: tuple[tuple[str, str, int], ...]
    numbered: bool = True


OFFICE = (
    *(
        Furnishing(
            label="office",
            pieces=(("desk", "pen pencil notebook folder book clipboard", 5), ("shelf", "folder book", 4)),
        ),
    )
    * 6,
    Furnishing(label="bathroom", pieces=(("sink", "soap towel", 2),), numbered=False),
)
SCHOOL = (
    *(
        Furnishing(
            label="classroom",
            pieces=(*(("table", "book pencil pen notebook bottle cup", 5),) * 6, ("shelf", "book folder", 6)),
        ),
    )
    * 4,
    Furnishing(label="bathroom", pieces=(("sink", "soap towel", 2),), numbered=False),
)
HOSPITAL = (
    *(
        Furnishing(
            label="ward",
            pieces=(*(("bed", "book phone", 1), ("nightstand", "cup bottle book medicine phone", 4)) * 3,),
        ),
    )
    * 5,
    Furnishing(label="storage", pieces=(("shelf", "towel soap pen bottle", 6),) * 4, numbered=False),
    Furnishing(label="bathroom", pieces=(("sink", "soap towel", 2), ("cabinet", "towel", 3)), numbered=False),
)
EXTENSIONS = {"office": OFFICE, "school": SCHOOL, "hospital": HOSPITAL}


def extension_lines(kind: str, nodes: int, seed: int) -> Iterator[str]:
    """Lines of a floor plan with about ``nodes`` more nodes; the same seed, the same lines."""
    random, numbers = Random(f"{kind} {seed}"), Counter[str]()
    rooms, furnishings = 0, EXTENSIONS[kind]
    while nodes > 0:
        if rooms % ROOMS_PER_CORRIDOR == 0:
            wing = rooms // ROOMS_PER_CORRIDOR
            yield f"corridor room_{FIRST + 1000 * wing} corridor {chr(ord('B') + wing)}"
            nodes -= 2
        furnishing = furnishings[rooms % len(furnishings)]
        rooms += 1
        numbers[furnishing.label] += 1
        number = f" {numbers[furnishing.label]}" if furnishing.numbered else ""
        wing = (rooms - 1) // ROOMS_PER_CORRIDOR
        yield f"room room_{FIRST + 1000 * wing + 1 + (rooms - 1) % ROOMS_PER_CORRIDOR} {furnishing.label}{number}"
        nodes -= 2
        for piece, sorts, most in furnishing.pieces:
            things = [_numbered(random.choice(sorts.split()), numbers, random) for _ in range(random.randint(1, most))]
            yield f"  {_numbered(piece, numbers, random)}: {', '.join(things)}"
            nodes -= 1 + len(things)


def _numbered(label: str, numbers: Counter[str], random: Random) -> str:
    numbers[label] += 1
    return f"{label}_{FIRST + numbers[label]} {random.choice(COLORS)}"
