"""Looking: at a place, around, and until perception confirms what was done."""
