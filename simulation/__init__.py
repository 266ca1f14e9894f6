"""A PyBullet house in a process of its own; implements both ports; truth and disturbances for scoring."""
