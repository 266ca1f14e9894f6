"""The routes of the interface, one module a group of calls."""
