"""Wordings of carrying, putting away and bringing back."""
