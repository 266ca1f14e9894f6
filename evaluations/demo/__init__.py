"""The demonstration under several seeds."""
