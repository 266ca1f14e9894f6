"""From seeded random scenes to the network that ships with Majordomo: ``python -m training --help``."""
