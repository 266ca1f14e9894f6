"""Random rooms to learn from: what stands in them, and pictures of them."""
