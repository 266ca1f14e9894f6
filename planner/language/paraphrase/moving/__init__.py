"""Wordings of going somewhere."""
