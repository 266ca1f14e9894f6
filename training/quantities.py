"""How much of everything the shipped network was made with."""

ROOM_PICTURES = 30_000
HOUSE_PICTURES = 24_000
STEPS = 36_000
"""Of 16 pictures; four hours on two cores."""
