"""The arm: kinematics, ways of the hand, grasps, and where to stand for them."""
