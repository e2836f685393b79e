"""One photon is the one that was counted, and what cannot be is told."""

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField
from rough_samples import rough

pytest.importorskip("numba")

from optipath.surfaces.ends.photon_ends import photon_ends
from optipath.surfaces.energies.energy import energy
from optipath.surfaces.walk.photon_beam import BLOCK, PORTION

STOKES = [1.0, 0.3, -0.5, 0.2]


def brushed(index=1.5):
    """A sample that is not isotropic, whose directions are as it lies."""
    return op.Sample([(1.8, rough(0.4, 0.3)), (index, rough(0.3, 0.5, seed=1))])


def test_the_sum_over_photons_is_the_energy():
    sample, photons = brushed(), 100
    found = energy(sample, 0.8, photons, stokes=STOKES, seed=3)
    each = [sample.photon(number, 0.8, stokes=STOKES, seed=3) for number in range(photons)]
    for end, share, scalar in [("up", found.R, found.scalar.R), ("down", found.T, found.scalar.T)]:
        there = [photon for photon in each if photon.end == end]
        total = sum(photon.stokes[0] for photon in there)
        assert total / photons == pytest.approx(float(share), rel=1e-13)
        without = sum(photon.scalar for photon in there)
        assert without / photons == pytest.approx(float(scalar), rel=1e-13)


def test_a_photon_ends_where_it_ended_among_all():
    sample, photons = brushed(0.5 + 2.1j), 100
    found = photon_ends(sample, 0.8, photons, azimuth=0.4, stokes=STOKES)
    for number in range(photons):
        photon = sample.photon(number, 0.8, azimuth=0.4, stokes=STOKES)
        assert photon.end == found.ends[number]
        assert len(photon.events) == found.events[number]
        assert photon.frame.z == pytest.approx(found.directions[number], abs=1e-14)
        assert photon.stokes[0] == pytest.approx(found.stokes[number, 0], rel=1e-14)
        assert photon.scalar == found.scalar[number]


def test_light_and_frame_are_those_among_all():
    """Turned to the frame of those, across the meridional plane, it has their Stokes vector."""
    sample, photons = brushed(0.5 + 2.1j), 50
    found = photon_ends(sample, 0.8, photons, stokes=STOKES)
    for number in range(photons):
        photon = sample.photon(number, 0.8, stokes=STOKES)
        frame = op.Frame.from_direction(photon.frame.z, found.x[number])
        light = op.Light(photon.stokes, frame=photon.frame).in_frame(frame)
        assert light.stokes == pytest.approx(found.stokes[number], abs=1e-12)


def test_photons_of_other_portions_and_blocks_are_on_other_surfaces():
    sample = op.Sample([(1.5, (0.3, 0.2))], cells=200, surfaces=2)
    number = BLOCK + PORTION + 5
    photon = sample.photon(number, 0.8)
    assert photon.surface == 1
    assert photon.frame.z == pytest.approx(
        photon_ends(sample, 0.8, number + 1).directions[number], abs=1e-14
    )


def test_a_photon_keeps_what_it_is_replayed_by():
    sample = brushed()
    photon = sample.photon(7, 0.8, seed=5)
    again = photon.sample.photon(photon.number, 0.8, seed=photon.seed)
    assert photon.sample is sample
    assert np.array_equal(again.stokes, photon.stokes)


def test_a_photon_is_given_up_after_the_most_events():
    sample = op.Sample([(1.5, 0.0), (1j, 0.0)])
    photons = (sample.photon(number, 0.8, most_events=2) for number in range(100))
    photon = next(each for each in photons if each.end == "stuck")
    assert len(photon.events) == 2
    assert photon.path().trace().stokes == pytest.approx(photon.stokes, abs=1e-13)


@pytest.mark.parametrize("number", [-1, 0.5, True, "3", None])
def test_a_number_that_is_none_is_refused(number):
    with pytest.raises(op.SurfaceError, match="number must be a whole number of 0 or more"):
        op.Sample([(1.5, 0.0)]).photon(number)


def test_all_faults_are_told_at_once():
    with pytest.raises(op.SurfaceError) as told:
        op.Sample([(1.5, 0.0)]).photon(-1, "95 deg", seed=-1, wavelength="550 nm")
    assert len(told.value.faults) == 4


def test_more_events_than_there_is_memory_for_are_refused():
    with pytest.raises(op.SurfaceError, match="fewer most_events"):
        op.Sample([(1.5, 0.0)]).photon(0, most_events=10**15)


def test_a_photon_where_none_meets_anything_is_refused():
    """Light along a finite mirror with a wall at its far end, a hundred thousandth wide."""
    heights = np.zeros((10**5, 3))
    heights[:2, -1] = 1.0
    field = HeightField.from_heights(heights, (1.0, 1.0))
    with pytest.raises(op.SurfaceError, match="photons meet nothing of the sample"):
        op.Sample([(1j, field)]).photon(0, "89.99 deg")
