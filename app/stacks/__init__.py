"""What runs behind the interface: a robot with its agents, or a stored graph."""
