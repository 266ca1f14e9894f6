"""What happened, in order: the event log, the stream for clients, and the agent that fills both."""
