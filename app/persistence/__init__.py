"""What is kept over a restart: the building, and what became of each node."""
