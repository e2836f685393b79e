"""Hemispheres of a few photons on small samples, measured once each."""

from functools import cache

import pytest

import optipath as op
from optipath.surfaces import Sensor
from rough_samples import rough

_SAMPLES = {
    "glass on glass": [(1.5, rough(0.3)), (2.4, rough(0.3, seed=1))],
    "clear": [(1.5, rough(0.3))],
    "silver": [(0.5 + 2.1j, rough(0.5))],
    "mirror": [(1j, rough(0.3))],
}


@cache
def measured(name, projection="equidistant", events=None):
    """A hemisphere of 16 x 16 pixels at an incidence of 60 deg, by 24,000 photons."""
    pytest.importorskip("numba")
    pytest.importorskip("xarray")
    given = {"sensor": Sensor(16, projection), "events": events, "threads": 1}
    if name == "gold":
        gold = op.Material.tabulated(["400 nm", "700 nm"], [1.5, 0.2], [1.9, 4.1])
        layers = [(gold, rough(0.3))]
        given["wavelengths"] = ["500 nm", "600 nm"]
    else:
        layers = _SAMPLES[name]
    return op.measure(op.Sample(layers), "60 deg", 24_000, **given)
