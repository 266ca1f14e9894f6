"""What one LiDAR revolution says by itself: its slice of walls, lines and corners, rays and walls, noise."""
