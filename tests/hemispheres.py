"""Hemispheres that tests of files are made of."""

import numpy as np
import pytest

pytest.importorskip("numba")
pytest.importorskip("xarray")

import optipath as op

PHOTONS = 8192


def measured(layers, incidence="40 deg", sensor=12, **more):
    sample = op.Sample(layers, cells=200, surfaces=2)
    return op.measure(sample, incidence, PHOTONS, sensor=sensor, **more)


def same_bits(first, second):
    """Whether two hemispheres are one, to the last bit of all that follows from them."""
    parts = zip(first.parts, second.parts, strict=True)
    return (
        all(one.dtype == other.dtype and np.array_equal(one, other) for one, other in parts)
        and np.array_equal(first.wavelengths, second.wavelengths, equal_nan=True)
        and first.dataset.identical(second.dataset)
        and first.sensor == second.sensor
        and first.seen.beam.states == second.seen.beam.states
        and (first.seen.beam.cos, first.seen.beam.sin)
        == (second.seen.beam.cos, second.seen.beam.sin)
    )
