"""What is exchanged with other programs: stored graphs, and tools for a language model."""
