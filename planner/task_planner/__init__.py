"""The Task Planner: a request to goals, an answer, a question or a refusal."""
