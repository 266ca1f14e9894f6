"""One frame: pixels to points, and what each detection is and where (Filtering, section 3.1)."""
