"""The single-scattering model beside photons, pixel by pixel: figure 4."""

import os

import numpy as np
import pytest

import optipath as op
from optipath.lab.published.facet_comparison import FacetComparison

pytest.importorskip("numba")
pytest.importorskip("xarray")
LONG = pytest.mark.skipif("OPTIPATH_SETS" not in os.environ, reason="walks 30 million photons")


@pytest.fixture(scope="module")
def silver():
    sample = op.load_sample("wang-2017-figure-4")
    return {
        events: FacetComparison(op.measure(sample, "40 deg", 300_000, sensor=64, events=events))
        for events in (None, 1)
    }


def test_the_model_reflects_the_light_that_photons_reflect_once(silver):
    value, error = silver[1].excess(0)
    assert abs(value) < 5.0 * error + 2e-3


def test_s3_of_single_scattering_is_exactly_0_and_that_of_photons_is_not(silver):
    assert not np.nanmax(np.abs(silver[None].model[..., 3]))
    hemisphere = silver[None].hemisphere
    value, error = (each[0, :, :, 0, 3, 0] for each in hemisphere.mueller)
    lit = error > 0.0
    # Far more than chance: the sum of squares in units of the errors.
    assert np.sum((value[lit] / error[lit]) ** 2) > 3.0 * lit.sum()


@pytest.mark.parametrize("component", [0, 1, 2])
def test_the_model_is_slightly_below_the_simulation(silver, component):
    value, error = silver[None].excess(component)
    assert -0.1 < value < -2.0 * error


@LONG
def test_the_model_is_that_of_photons_after_one_event_beyond_30_deg_from_grazing():
    sample = op.load_sample("wang-2017-figure-4")
    once = op.measure(sample, "40 deg", 30_000_000, events=1)
    off, error = FacetComparison(once).largest_off()
    assert off < 2e-3 + 2.0 * error < 5e-3


def test_a_stack_is_not_compared():
    hemisphere = op.measure(op.load_sample("glass-on-glass"), "40 deg", 1000, sensor=8)
    with pytest.raises(op.SurfaceError, match="one interface of one alpha"):
        FacetComparison(hemisphere).excess(0)
