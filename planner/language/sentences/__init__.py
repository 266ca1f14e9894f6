"""From characters to sentences, clauses and steps."""
