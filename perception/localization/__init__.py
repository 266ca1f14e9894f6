"""Where the robot is in its current room: alignment of scans with the outline, and the energy optimizer."""
