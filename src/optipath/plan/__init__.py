"""What a composed path can be asked: a run, matrices, bounds, light paths, an explanation."""
