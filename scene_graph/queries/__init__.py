"""Questions to a snapshot: filters, ways, physical doors, the layout."""
