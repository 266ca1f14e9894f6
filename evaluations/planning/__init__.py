"""``evaluate planning``: buildings, requests about them, what each should lead to, and what it did lead to."""
