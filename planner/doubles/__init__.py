"""Made-up flats, skills and graphs for tests of the planner."""
