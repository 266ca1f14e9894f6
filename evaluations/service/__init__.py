"""What the service costs: time, memory, clients, recordings."""
