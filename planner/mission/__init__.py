"""One task from its words to its outcome."""
