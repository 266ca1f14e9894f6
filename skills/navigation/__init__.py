"""Driving within one room: obstacles around the robot, an occupancy grid on demand, a route on it, and following it."""
