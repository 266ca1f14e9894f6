"""HTTP interface, version 1 (design, section 9)."""
