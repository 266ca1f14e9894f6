"""A robot behind rosbridge: both ports over one websocket, for any robot that ROS 1 or 2 runs. See docs/robot.md."""
