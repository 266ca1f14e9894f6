"""Which sighting is which thing: known, moved, part of another, or new."""
