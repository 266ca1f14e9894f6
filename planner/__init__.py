"""From a request to an outcome: goals, verified plans, execution, monitoring, explanation."""
