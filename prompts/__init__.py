"""The texts that a language model reads, and nothing else."""
