"""Kinds of furniture and things: sizes, masses, and the shapes that they are made of."""
