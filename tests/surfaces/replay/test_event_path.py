"""The way of a photon as a path, whose light is that of the photon."""

import os

import numpy as np
import pytest

import optipath as op
from rough_samples import drawn_sample, polarised, rough

pytest.importorskip("numba")

SETS = 200 if "OPTIPATH_SETS" in os.environ else 20
PHOTONS = 100 if "OPTIPATH_SETS" in os.environ else 6


@pytest.mark.parametrize("seed", range(SETS))
def test_the_path_has_the_light_of_the_walk(seed):
    sample, incidence = drawn_sample(seed)
    for number in range(PHOTONS):
        photon = sample.photon(number, incidence, seed=seed, stokes=polarised(seed))
        light = photon.path().trace()
        assert np.all(np.abs(light.stokes - photon.stokes) <= 1e-12 * photon.stokes[0])


def test_the_light_next_to_the_critical_angle_is_that_of_the_walk():
    """Light that has been refracted within a millionth of total reflection, searched for."""
    index, apart = 1.5, 1e-6
    sample = op.Sample([(1.0, 0.0)], outside=index)
    incidence = np.arcsin(1.0 / index) - apart
    photons = (sample.photon(number, incidence) for number in range(2000))
    photon = next(each for each in photons if each.end == "down")
    stokes = photon.path().trace().stokes
    assert np.all(np.abs(stokes - photon.stokes) <= 1e-13 * photon.stokes[0])


def test_the_light_of_a_refraction_along_a_facet_is_that_of_the_walk():
    sample = op.Sample([(1.5, 0.0)])
    photons = (sample.photon(number, np.pi / 2 - 1e-3) for number in range(2000))
    photon = next(each for each in photons if each.end == "down")
    stokes = photon.path().trace().stokes
    assert np.all(np.abs(stokes - photon.stokes) <= 1e-12 * photon.stokes[0])


def test_the_light_of_a_long_way_is_that_of_the_walk():
    """Light that is held between a mirror and diamond, and meets some hundred facets."""
    sample = op.Sample([(2.4, rough(0.1)), (1j, rough(0.1, seed=1))])
    photons = (sample.photon(number, 0.5) for number in range(2000))
    photon = next(each for each in photons if len(each.events) > 100)
    stokes = photon.path().trace().stokes
    assert np.all(np.abs(stokes - photon.stokes) <= 1e-12 * photon.stokes[0])


def test_nodes_are_called_by_the_order_of_events():
    photon = op.Sample([(1.5, 0.0), (1j, 0.0)]).photon(1, "50 deg")
    path = photon.path()
    facets = [f"facet-{number}" for number in range(1, len(photon.events) + 1)]
    assert [*path] == ["source", *facets, "detector"]
    assert path.element("facet-2").index == 1j


def test_what_a_facet_does_is_seen_on_the_way():
    photon = op.Sample([(1.5, 0.0), (1j, 0.0)]).photon(1, "50 deg")
    kept = photon.path().trace(keep="all")
    ports = ["reflected" if event.reflected else "transmitted" for event in photon.events]
    links = [name.partition(" -> ")[0] for name in kept if " -> " in name]
    assert links == ["source.out", *(f"facet-{n}.{port}" for n, port in enumerate(ports, 1))]
