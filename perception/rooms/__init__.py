"""The room concept: corners, pose graph, outline, and the agent that lives by them (Concepts, section 3.5.1)."""
