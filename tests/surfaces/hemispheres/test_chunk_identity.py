"""What tells measurements from each other, to their last bit."""

from dataclasses import replace

import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from optipath.surfaces.hemispheres.chunk_identity import chunk_identity
from optipath.surfaces.hemispheres.sensed_beam import STATES, SensedBeam
from optipath.surfaces.walk.given_beam import given_beam

SAMPLE = op.Sample([(1.5, 0.3), (0.5 + 2.1j, (0.1, 0.2))])
HEIGHTS = np.zeros((4, 4))


def identity(sample=SAMPLE, incidence="50 deg", photons=100, when=(np.nan,), code="1", **options):
    sensor = options.pop("sensor", surfaces.Sensor(16))
    kinds = options.pop("polarized", "both"), options.pop("events", None)
    beam = replace(given_beam(sample, incidence, **options), states=STATES)
    return chunk_identity(SensedBeam(beam, sensor, *kinds), np.array(when), photons, code)


def with_heights(heights, size=3.0, **options):
    return op.Sample([(1.5, surfaces.HeightField.from_heights(heights, size, **options))])


@pytest.mark.parametrize(
    "other",
    [
        {"sample": op.Sample([(1.5, np.nextafter(0.3, 1.0)), (0.5 + 2.1j, (0.1, 0.2))])},
        {"sample": op.Sample([(1.5, 0.3), (0.5 + 2.1j, (0.2, 0.1))])},
        {"sample": op.Sample([(1.4, 0.3), (0.5 + 2.1j, (0.1, 0.2))])},
        {"sample": op.Sample([(1.5, 0.3), (0.5 + 2.2j, (0.1, 0.2))])},
        {"sample": op.Sample(SAMPLE.layers, outside=1.1)},
        {"sample": op.Sample(SAMPLE.layers, cells=700)},
        {"sample": op.Sample(SAMPLE.layers, surfaces=3)},
        {"sample": op.Sample(SAMPLE.layers, seed=1)},
        {"sample": op.Sample(SAMPLE.layers, periodic=False)},
        {"incidence": np.nextafter(np.radians(50.0), 1.0)},
        {"azimuth": 0.1},
        {"photons": 101},
        {"seed": 1},
        {"most_events": 7},
        {"sensor": surfaces.Sensor(17)},
        {"sensor": surfaces.Sensor(16, "equal-area")},
        {"sensor": surfaces.Sensor(16, parts=8)},
        {"polarized": "polarized"},
        {"events": 1},
        {"when": (5e-7,)},
        {"code": "2"},
    ],
)
def test_whatever_changes_the_bits_is_another_identity(other):
    assert identity(**other) != identity()


def test_heights_are_told_apart_by_all_that_they_are():
    higher = HEIGHTS.copy()
    higher[2, 1] = 1e-300
    others = [
        with_heights(HEIGHTS),
        with_heights(higher),
        with_heights(HEIGHTS, np.nextafter(3.0, 4.0)),
        with_heights(HEIGHTS, (3.0, 2.0)),
        with_heights(HEIGHTS, periodic=True),
        with_heights(np.zeros((4, 5))),
    ]
    assert len({identity(each) for each in others}) == len(others)


def test_an_index_by_name_is_the_numbers_that_it_has():
    glass = op.Material.cauchy([1.5])
    by_name = op.Sample([(glass, 0.3)])
    there = identity(by_name, wavelength="500 nm")
    assert there == identity(op.Sample([(1.5, 0.3)]))


def test_what_makes_no_difference_is_none():
    described = op.Sample(SAMPLE.layers, description="glass over metal")
    assert identity(described) == identity()
    assert identity(seed=np.int64(3)) == identity(seed=3)
    assert identity(sensor=surfaces.Sensor(np.int64(16))) == identity()
