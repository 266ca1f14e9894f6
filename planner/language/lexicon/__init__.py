"""Words: what each means, its forms, and the names of the live graph."""
