"""The default robot: its body, camera, LiDAR and their noise."""
