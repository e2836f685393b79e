"""The axes of a sweep: what is given for them, and the grid that they span."""
