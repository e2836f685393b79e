"""How light is carried from step to step, and what the shapes of Mueller matrices do to it."""
