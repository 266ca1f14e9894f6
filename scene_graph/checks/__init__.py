"""What always holds in the graph, and the draft that is checked."""
