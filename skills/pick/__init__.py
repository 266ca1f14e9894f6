"""PICK: taking hold of a thing."""
