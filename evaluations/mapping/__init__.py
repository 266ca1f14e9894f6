"""How well rooms and doors are mapped, and the robot knows where it is."""
