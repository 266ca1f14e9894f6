"""The door concept: gaps in the walls of the current room, and their agent (Concepts, section 3.5.2)."""
