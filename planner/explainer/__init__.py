"""The Explainer: what failed, on what evidence, and what to try next."""
