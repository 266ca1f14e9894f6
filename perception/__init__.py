"""Sensors to graph: LiDAR concepts (room, door), localization, RGB-D objects and relations, memory."""
