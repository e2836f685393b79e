"""A program of steps: what it is, its loops, and the order in which it is executed."""
