"""A house in the physics client: walls, things, people, and what happens to them."""
