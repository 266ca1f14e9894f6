"""One thing over time: place, existence, relations (Filtering, algorithm 1)."""
