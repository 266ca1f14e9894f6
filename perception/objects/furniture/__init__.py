"""Furniture as it was seen from all sides: surfaces, levels, backs, and how much of them was seen."""
