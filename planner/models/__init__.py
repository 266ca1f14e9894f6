"""Language models behind one protocol; what they answer is checked by the planner, never trusted."""
