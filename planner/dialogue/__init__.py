"""From what was said, before and now, to what is meant."""
