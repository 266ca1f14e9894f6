"""The door concept: gaps in the walls of the current room, and the agent that lives by them (Concepts, section 3.5.2)."""
