"""PLACE: finding a free spot and putting down what the gripper holds."""
