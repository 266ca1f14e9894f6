"""Words to nodes: which things of the graph a phrase names."""
