"""Geometry of the plane that the robot drives on: poses, walls, polygons."""
