"""Wordings that people use for one thing, and the one that the grammar knows; a module for each field of life."""
