"""Wordings of which thing is meant."""
