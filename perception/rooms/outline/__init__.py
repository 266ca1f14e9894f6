"""From lines to the outline of a room: cells, openings, free forms."""
