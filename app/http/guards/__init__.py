"""Who may call, how often, and how much: what stands before every route."""
