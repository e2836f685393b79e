"""Sweeps in chunks: Dask arrays, of which each block is a run of its own."""
