"""Furniture as the hand meets it: boards, seats, containers."""
