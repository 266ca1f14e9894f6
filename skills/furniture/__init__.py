"""Furniture as the hand meets it: surfaces, ways in, obstacles."""
