"""Documents, pictures and metrics of how things stand, made from one snapshot."""
