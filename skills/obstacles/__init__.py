"""What is in the way: by the graph and by what was hit lately, as a map of the room."""
