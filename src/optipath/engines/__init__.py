"""Engines: each does what a formula says, and knows nothing else."""
