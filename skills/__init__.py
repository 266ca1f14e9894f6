"""What the robot can do: GOTO, PICK, PLACE, with conditions, effects and actions; the body port."""
