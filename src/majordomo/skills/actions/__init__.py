"""Actions, one module for each family: driving, doors, looking, watching, the arm, grasping, placing."""
