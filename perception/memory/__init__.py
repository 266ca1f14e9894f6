"""Long-term spatial memory: what happens when the robot passes from one room to another (Concepts, section 3.6)."""
