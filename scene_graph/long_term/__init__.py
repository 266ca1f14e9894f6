"""Long-term spatial memory: what is known of rooms that working memory does not hold (Concepts, section 3.6)."""
