"""The command grammar: from tokens to readings."""
