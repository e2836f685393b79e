"""The ways of photons over meshes: on one side of the surface, from facet to facet."""

import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from rays_over_meshes import crossings, first_meeting, height_above

pytest.importorskip("numba")

from optipath.surfaces.walk import walk_layout as layout
from optipath.surfaces.walk.given_beam import given_beam

PERIODS = pytest.mark.parametrize("periodic", [True, False])
INDICES = pytest.mark.parametrize("index", [1.5, 1j])
SPACING = np.array([0.5, 0.8])


def steep_field(seed, *, periodic):
    heights = np.random.default_rng(seed).normal(size=(8, 6))
    cells = np.array([6, 8]) - (not periodic)
    return surfaces.HeightField(heights, tuple(SPACING * cells), periodic)


def first_photon(field, index, seed):
    """Events of the first photon of a seed, and where on the mesh it starts, in cells."""
    beam = given_beam(op.Sample([(index, field)]), 0.8, 0.4, seed=seed)
    record = beam.block(0, wanted=0).record
    stream = np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(0,)))
    start = np.random.Generator(stream).random(2) * field.cells
    return record[0], record[1 : 1 + int(record[0, layout.EVENTS])], start


def in_cells(vector):
    return vector / [*SPACING, 1.0]


@PERIODS
@INDICES
def test_photons_stay_on_their_side_of_the_surface_from_event_to_event(periodic, index):
    met = 0
    for seed in range(80):
        field = steep_field(seed, periodic=periodic)
        end, events, start = first_photon(field, index, seed)
        place = np.array([*start, field.heights.max()])
        along = in_cells(end[layout.FIRST_K : layout.FIRST_K + 3])
        if first_meeting(field, place, along, 1.0) is None:
            continue  # No photon: another start was drawn.
        for event in events:
            there = in_cells(event[layout.POINT : layout.POINT + 3]) + np.array([*start, 0.0])
            above = height_above(field, place, there - place)
            inside = [t for t in crossings(field, place, there - place) if t < 1]
            assert all(event[layout.SIDE] * above(t) > -1e-12 for t in inside)
            assert abs(float(above(1))) < 1e-12
            place, met = there, met + 1
    assert met > 20


@INDICES
def test_light_changes_sides_where_it_is_refracted(index):
    for seed in range(30):
        _, events, _ = first_photon(steep_field(seed, periodic=True), index, seed)
        side = 1.0
        for event in events:
            assert event[layout.SIDE] == side
            along = event[layout.DIRECTION : layout.DIRECTION + 3]
            normal = event[layout.NORMAL : layout.NORMAL + 3]
            assert along @ normal < 0.0
            assert side * normal[2] > 0.0
            media = (1.0, index.real) if side > 0.0 else (index.real, 1.0)
            assert tuple(event[[layout.N1, layout.N2]]) == media
            side *= 1.0 if event[layout.REFLECTED] else -1.0


def test_a_photon_that_meets_more_facets_than_allowed_is_stuck():
    found = surfaces.photon_ends(
        op.Sample([(1j, steep_field(0, periodic=True))]), 0.8, 1000, most_events=2
    )
    assert set(found.ends) == {"up", "stuck"}
    assert np.all(found.events[found.ends == "stuck"] == 2)


def test_light_that_leaves_a_finite_field_at_its_side_is_gone_sideways():
    found = surfaces.photon_ends(op.Sample([(1.5, steep_field(0, periodic=False))]), 0.8, 1000)
    assert set(found.ends) == {"up", "down", "sideways"}


def test_light_that_never_comes_down_is_lost_and_counted_as_stuck():
    ridges = surfaces.HeightField(
        [[0.0, 0.0], [0.0, 0.0], [1.0, 1.0], [0.0, 0.0]], 4.0, periodic=True
    )
    found = surfaces.energy(
        op.Sample([(1.5, ridges)]), np.pi / 2 - 1e-11, photons=3, azimuth=0.0, threads=1, seed=1
    )
    assert found.stuck + found.sideways == found.stuck > 0
    assert found.lost == pytest.approx(found.stuck / 3, rel=1e-12)


def test_normals_of_cliffs_are_of_length_1():
    cliffs = surfaces.HeightField(1e6 * (np.indices((8, 8)).sum(axis=0) % 2), 8.0, periodic=True)
    beam = given_beam(op.Sample([(1j, cliffs)]), 0.1)
    record = beam.block(0, wanted=50).record
    normals = record[1 : 1 + int(record[0, layout.EVENTS]), layout.NORMAL : layout.NORMAL + 3]
    assert np.linalg.norm(normals, axis=-1) == pytest.approx(1.0, abs=1e-15)
