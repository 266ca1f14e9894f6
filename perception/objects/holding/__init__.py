"""The thing in the gripper: what the fingers feel, and where it went."""
