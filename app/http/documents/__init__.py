"""What goes over the wire: requests, answers, problems, and examples of each."""
