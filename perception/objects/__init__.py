"""RGB-D to object memory: masks become points, points become beliefs, beliefs become nodes (Filtering, section 3.1)."""
