"""Tracks to the graph and back: nodes, edges, persons, and what the graph remembers."""
