"""GOTO: to a room, a thing, a person, or through a door."""
