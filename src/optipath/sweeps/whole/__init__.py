"""Sweeps in memory: one run of the whole grid, with views of its light."""
