"""The Executor: carries out the granted intention, action by action."""
