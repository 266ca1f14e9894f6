"""The Skill Planner: goals to verified plans, steps to actions."""
