"""Houses from a seed: a program of rooms, a layout, doors, furniture; whole millimeters until the house is turned."""
