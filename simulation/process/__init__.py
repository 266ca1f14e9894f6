"""The simulator in a process of its own, and the robot as the service sees it."""
