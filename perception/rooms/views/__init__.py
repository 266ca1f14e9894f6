"""What the LiDAR saw of walls: slices, corners, lines, and views from several places."""
