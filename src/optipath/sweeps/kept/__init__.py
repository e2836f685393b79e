"""Sweeps that are kept: stores of Zarr and files of NetCDF, written block by block."""
