"""Wordings of courtesy, motives and other talk around a request."""
