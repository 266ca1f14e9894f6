"""The scene graph as a JSON document, and back (design, section 9)."""
