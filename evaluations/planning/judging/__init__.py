"""What is expected of a request, and whether the outcome is that."""
