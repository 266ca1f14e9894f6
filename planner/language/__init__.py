"""The command grammar: plain English to readings, without a language model."""
