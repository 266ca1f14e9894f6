"""Robots that exist: each driver implements both ports."""
