"""What the robot measures and believes, in MCAP files, and perception over such a file without the robot."""
