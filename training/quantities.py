"""How much of everything the shipped network was made with."""

ROOM_PICTURES = 16_200
HOUSE_PICTURES = 23_100
STEPS = 22_700
"""Of 16 pictures; four hours on two cores."""
