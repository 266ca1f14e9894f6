"""The symbolic state that conditions and effects speak about."""
