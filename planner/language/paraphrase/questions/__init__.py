"""Wordings of questions and conditions."""
