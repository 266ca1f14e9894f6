"""How much of everything the shipped network was made with."""

ROOM_PICTURES = 30_000
HOUSE_PICTURES = 24_000
MINUTES = 120.0
"""On two cores; a machine with more of them may take less."""
