"""Engines: each runs a program's steps and knows nothing else."""

from optipath.engines import numpy_engine

__all__ = ["numpy_engine"]
