"""Where a photon meets facets, and which way it goes on."""

import itertools

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField
from rough_samples import drawn_sample, rough

pytest.importorskip("numba")

PHOTONS = 50


def events_of(sample, incidence=1.0, photons=PHOTONS):
    for number in range(photons):
        photon = sample.photon(number, incidence)
        fields = sample.fields(photon.surface)
        for event in photon.events:
            yield event, fields[event.layer]


@pytest.fixture(scope="module", params=[1, 3, 7], ids=str)
def met(request):
    """Events and their fields, of a sample of several layers."""
    return [*events_of(*drawn_sample(request.param))]


def corners(event, field):
    """The heights of the cell that is met: at (0, 0), (1, 0), (0, 1) and (1, 1)."""
    column, row, _ = event.facet
    (a, b), (c, d) = field.vertices()[row : row + 2, column : column + 2]
    return a, b, c, d


def rises(event, field):
    """How a facet rises over a cell, along x and along y."""
    a, b, c, d = corners(event, field)
    return (b - a, d - b) if event.facet[2] == 0 else (d - c, c - a)


def test_points_lie_on_the_mesh_of_their_layer(met):
    for event, field in met:
        u, v = event.on_mesh[:2] / field.spacing - event.facet[:2]
        assert min(u, v) > -1e-9
        assert max(u, v) < 1.0 + 1e-9
        assert (u - v > -1e-9) if event.facet[2] == 0 else (v - u > -1e-9)
        along_x, along_y = rises(event, field)
        height = corners(event, field)[0] + u * along_x + v * along_y
        assert event.on_mesh[2] == pytest.approx(height, abs=1e-9)


def test_normals_are_those_of_the_mesh_on_the_side_of_the_light(met):
    for event, field in met:
        normal = np.append(-np.divide(rises(event, field), field.spacing), 1.0)
        normal *= -np.sign(normal @ event.direction) / np.linalg.norm(normal)
        assert event.normal == pytest.approx(normal, abs=1e-12)


def test_incidences_are_the_angles_to_the_normals(met):
    for event, _ in met:
        assert event.cos == pytest.approx(-event.normal @ event.direction, abs=1e-12)
        across = np.linalg.norm(np.cross(event.normal, event.direction))
        assert event.incidence == pytest.approx(np.arctan2(across, event.cos), abs=1e-12)


def test_light_is_reflected_and_refracted_by_snells_law(met):
    """n k keeps its part along the facet, and has the length n, behind the facet or before it."""
    for event, _ in met:
        after = event.n1 if event.reflected else event.n2
        along = event.n1 * np.cross(event.normal, event.direction)
        assert after * np.cross(event.normal, event.onwards) == pytest.approx(along, abs=1e-11)
        assert np.linalg.norm(event.onwards) == pytest.approx(1.0, abs=1e-12)
        assert (event.onwards @ event.normal > 0.0) == event.reflected


def test_facets_reflect_as_often_as_the_mean_of_the_shares_of_s_and_p(met):
    for event, _ in met[:50]:
        face = op.Interface(event.n2, event.incidence, event.n1)
        port = "reflected" if event.reflected else "transmitted"
        mean = face.mueller("in", port).matrix[0, 0]
        expected = mean if np.isrealobj(event.n2) else 1.0
        assert event.probability == pytest.approx(expected, rel=1e-9)


def test_between_positions_light_goes_straight_on():
    sample = op.Sample([(1.5, rough(0.5)), (1j, rough(0.3, seed=1))])
    for number in range(PHOTONS):
        events = sample.photon(number, 0.7).events
        for one, other in itertools.pairwise(events):
            way = other.position - one.position
            assert np.linalg.norm(np.cross(way, one.onwards)) < 1e-9 * np.linalg.norm(way)
            assert way @ one.onwards > 0.0
            assert np.array_equal(one.onwards, other.direction)


def test_media_are_those_above_and_below_the_layer():
    sample = op.Sample([(1.5, rough(0.5)), (2.4, rough(0.3))])
    for event, _ in events_of(sample, 0.7):
        both = [1.0, 1.5, 2.4][event.layer : event.layer + 2]
        assert sorted((event.n1, event.n2)) == both
        from_above = event.normal[2] > 0.0
        assert event.n1 == both[0 if from_above else 1]


def test_turns_lead_to_the_line_across_the_plane_of_incidence():
    sample = op.Sample([(1.5, rough(0.5)), (1j, rough(0.3, seed=1))])
    for number in range(PHOTONS):
        photon = sample.photon(number, 0.7)
        x = photon.start.x
        for event in photon.events:
            s = np.cross(event.normal, event.direction) / event.sin
            y = np.cross(event.direction, x)
            turned = np.cos(event.turn) * x + np.sin(event.turn) * y
            # A frame turned by a half turn has the same numbers.
            assert abs(turned @ s) == pytest.approx(1.0, abs=1e-12)
            x = s


def test_points_on_a_finite_field_are_where_they_are():
    heights = np.random.default_rng(2).random((9, 11))
    field = HeightField.from_heights(heights, (5.0, 4.0))
    for event, _ in events_of(op.Sample([(1.5, field)]), 0.5):
        assert np.all((event.on_mesh[:2] >= 0.0) & (event.on_mesh[:2] <= field.size))
