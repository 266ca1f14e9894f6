"""Answers to questions, read from the graph."""
