"""``evaluate missions``: requests carried out in physics while people interfere, judged by the simulator's truth."""
