"""A room that stands: does it still fit, which wall is off, when is it taken back."""
