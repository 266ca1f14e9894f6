"""Measuring a room for the first time: where to look, what fits, when it suffices."""
