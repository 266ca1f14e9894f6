"""The house document: its fields, checks, colors and plane geometry (design, section 4)."""
