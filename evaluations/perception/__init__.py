"""How well things are recognized, tracked and kept."""
