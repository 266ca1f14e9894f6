"""A camera and its network in an analytic room, for tests."""
