"""How much of everything the shipped network was made with."""

ROOM_PICTURES = 11_400
HOUSE_PICTURES = 9_000
STEPS = 11_000
"""Of 16 pictures; an hour and a half on two cores."""
