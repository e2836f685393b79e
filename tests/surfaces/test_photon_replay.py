"""One photon: its events, its path, and that it is the one that was counted."""

import itertools

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField
from optipath.surfaces.photon import PhotonEvent, event_path, event_table
from rough_samples import drawn_sample, fresnel, polarised, rough
from tables import rows, slow

pytest.importorskip("numba")

from optipath.surfaces.ends import photon_ends
from optipath.surfaces.energy_shares import energy
from optipath.surfaces.walk.beam import BLOCK, PORTION


def events_of(sample, incidence=1.0):
    for number in range(50):
        photon = sample.photon(number, incidence)
        fields = sample.fields(photon.surface)
        for event in photon.events:
            yield event, fields[event.layer]


FINITE = HeightField.from_heights(np.random.default_rng(2).random((9, 11)), (5.0, 4.0))


@pytest.fixture(scope="module")
def met():
    """Events and their fields, of samples of several layers and of a finite one."""
    drawn = [each for seed in (1, 3, 7) for each in events_of(*drawn_sample(seed))]
    return [*drawn, *events_of(op.Sample([(1.5, FINITE)]), 0.5)]


def facet_of(event, field):
    """The first corner of the cell that is met, and how its facet rises along x and along y."""
    column, row, half = event.facet
    (a, b), (c, d) = field.vertices()[row : row + 2, column : column + 2]
    return a, (b - a, d - b) if half == 0 else (d - c, c - a)


def test_points_and_normals_are_those_of_the_mesh_of_their_layer(met):
    for event, field in met:
        u, v = event.on_mesh[:2] / field.spacing - event.facet[:2]
        assert -1e-9 < min(u, v) <= max(u, v) < 1.0 + 1e-9
        assert (u - v > -1e-9) if event.facet[2] == 0 else (v - u > -1e-9)
        low, rises = facet_of(event, field)
        assert event.on_mesh[2] == pytest.approx(low + u * rises[0] + v * rises[1], abs=1e-9)
        normal = np.append(-np.divide(rises, field.spacing), 1.0)
        # On the side of the light.
        normal *= -np.sign(normal @ event.direction) / np.linalg.norm(normal)
        assert event.normal == pytest.approx(normal, abs=1e-12)
        # The incidence is the angle to it.
        assert event.cos == pytest.approx(-event.normal @ event.direction, abs=1e-12)
        across = np.linalg.norm(np.cross(event.normal, event.direction))
        assert event.incidence == pytest.approx(np.arctan2(across, event.cos), abs=1e-12)
        on_it = (event.on_mesh[:2] >= 0.0) & (event.on_mesh[:2] <= field.size)
        assert field.periodic or np.all(on_it)


def test_light_is_reflected_and_refracted_by_snells_law_as_often_as_the_mean_share_of_s_and_p(met):
    """n k keeps its part along the facet, and has the length n, behind the facet or before it."""
    for event, _ in met:
        after = event.n1 if event.reflected else event.n2
        along = event.n1 * np.cross(event.normal, event.direction)
        assert after * np.cross(event.normal, event.onwards) == pytest.approx(along, abs=1e-11)
        assert np.linalg.norm(event.onwards) == pytest.approx(1.0, abs=1e-12)
        assert (event.onwards @ event.normal > 0.0) == event.reflected
    for event, _ in met[:: len(met) // 50]:
        face = op.Interface(event.n2, event.incidence, event.n1)
        port = "reflected" if event.reflected else "transmitted"
        mean = face.mueller("in", port).matrix[0, 0]
        expected = mean if np.isrealobj(event.n2) else 1.0
        assert event.probability == pytest.approx(expected, rel=1e-9)
    # Media are those above and below the layer.
    for event, _ in events_of(op.Sample([(1.5, rough(0.5)), (2.4, rough(0.3))]), 0.7):
        both = [1.0, 1.5, 2.4][event.layer : event.layer + 2]
        assert sorted((event.n1, event.n2)) == both
        assert event.n1 == both[0 if event.normal[2] > 0.0 else 1]


def test_light_goes_straight_on_and_turns_lead_to_the_line_across_the_plane_of_incidence():
    sample = op.Sample([(1.5, rough(0.5)), (1j, rough(0.3, seed=1))])
    for number in range(50):
        photon = sample.photon(number, 0.7)
        for one, other in itertools.pairwise(photon.events):
            way = other.position - one.position
            assert np.linalg.norm(np.cross(way, one.onwards)) < 1e-9 * np.linalg.norm(way)
            assert way @ one.onwards > 0.0
            assert np.array_equal(one.onwards, other.direction)
        x = photon.start.x
        for event in photon.events:
            s = np.cross(event.normal, event.direction) / event.sin
            y = np.cross(event.direction, x)
            turned = np.cos(event.turn) * x + np.sin(event.turn) * y
            # A frame turned by a half turn has the same numbers.
            assert abs(turned @ s) == pytest.approx(1.0, abs=1e-12)
            x = s


ANGLE = np.radians(50.0)
WAVELENGTHS = ["450 nm", "550 nm", "650 nm"]
BASE = op.Material(op.Material.cauchy([0.3, 0.05]).n, 2.5)


def test_light_comes_from_the_azimuth_that_is_given_and_ends_in_the_frame_of_the_last_facet():
    photon = op.Sample([(1j, 0.0)]).photon(0, ANGLE)
    down, up = photon.start.z, photon.frame.z
    assert down[2] == pytest.approx(-np.cos(ANGLE))
    assert up == pytest.approx(down * [1.0, 1.0, -1.0])
    assert photon.frame.x == pytest.approx(photon.start.x)
    for degrees in (0, 130):
        photon = op.Sample([(1.5, rough(0.3, 0.2))]).photon(0, ANGLE, azimuth=f"{degrees} deg")
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        along = [np.sin(ANGLE) * c, np.sin(ANGLE) * s, -np.cos(ANGLE)]
        assert photon.start.z == pytest.approx(along)
        assert photon.start.x == pytest.approx([-s, c, 0.0], abs=1e-15)
    # On an isotropic sample from azimuths of their own.
    sample = op.Sample([(1.5, rough(0.3))])
    first, second = (sample.photon(number, ANGLE).start.z for number in range(2))
    assert abs(first @ second) < 0.999
    sample, incidence = drawn_sample(3)
    for number in range(50):
        photon = sample.photon(number, incidence)
        last = photon.events[-1]
        assert photon.frame.z == pytest.approx(last.onwards, abs=1e-12)
        across = np.cross(last.normal, last.direction)
        assert photon.frame.x == pytest.approx(across / np.linalg.norm(across), abs=1e-7)


def test_several_wavelengths_ride_on_one_photon_and_its_path():
    sample = op.Sample([(1.5, rough(0.3)), (BASE, rough(0.4, seed=1))])
    photon = sample.photon(4, ANGLE, wavelength=WAVELENGTHS)
    assert photon.stokes.shape == (3, 4)
    assert photon.path().trace().stokes == pytest.approx(photon.stokes, rel=1e-12, abs=1e-13)
    for place, wavelength in enumerate(WAVELENGTHS):
        one = photon.path(place).trace().stokes
        assert one == pytest.approx(photon.stokes[place], rel=1e-12, abs=1e-13)
        alone = sample.photon(4, ANGLE, wavelength=wavelength)
        assert np.array_equal(alone.stokes, photon.stokes[place])
    for which in (3, True):
        with pytest.raises(
            op.errors.SurfaceError, match=r"which is .*shape \(3,\); give the place"
        ):
            photon.path(which)
    with pytest.raises(
        op.errors.SurfaceError, match=r"which is 0, but wavelengths have the shape \(\)"
    ):
        op.Sample([(1.5, 0.0)]).photon(0, ANGLE).path(0)


STOKES = [1.0, 0.3, -0.5, 0.2]


def brushed(index=1.5):
    """A sample that is not isotropic, whose directions are as it lies."""
    return op.Sample([(1.8, rough(0.4, 0.3)), (index, rough(0.3, 0.5, seed=1))])


def test_the_sum_over_photons_is_the_energy():
    sample, photons = brushed(), 100
    found = energy(sample, 0.8, photons, stokes=STOKES, seed=3)
    each = [sample.photon(number, 0.8, stokes=STOKES, seed=3) for number in range(photons)]
    for end, share, scalar in [("up", found.R, found.scalar.R), ("down", found.T, found.scalar.T)]:
        there = [(photon.stokes[0], photon.scalar) for photon in each if photon.end == end]
        means = np.sum(there, axis=0) / photons
        np.testing.assert_allclose(means, [share, scalar], rtol=1e-13)
    # A photon keeps what it is replayed by.
    photon = each[7]
    again = photon.sample.photon(photon.number, 0.8, stokes=STOKES, seed=photon.seed)
    assert photon.sample is sample
    assert np.array_equal(again.stokes, photon.stokes)


def test_a_photon_ends_where_it_ended_among_all():
    sample, photons = brushed(0.5 + 2.1j), 100
    found = photon_ends(sample, 0.8, photons, azimuth=0.4, stokes=STOKES)
    for number in range(photons):
        photon = sample.photon(number, 0.8, azimuth=0.4, stokes=STOKES)
        known = found.ends[number], found.events[number], found.scalar[number]
        assert (photon.end, len(photon.events), photon.scalar) == known
        assert photon.frame.z == pytest.approx(found.directions[number], abs=1e-14)
        assert photon.stokes[0] == pytest.approx(found.stokes[number, 0], rel=1e-14)
        # In the frame of those, across the meridional plane, it has their Stokes vector.
        frame = op.Frame.from_direction(photon.frame.z, found.x[number])
        light = op.Light(photon.stokes, frame=photon.frame).in_frame(frame)
        assert light.stokes == pytest.approx(found.stokes[number], abs=1e-12)
    # So do those of other portions and blocks, on other surfaces.
    sample, number = op.Sample([(1.5, (0.3, 0.2))], cells=200, surfaces=2), BLOCK + PORTION + 5
    photon, ends = sample.photon(number, 0.8), photon_ends(sample, 0.8, number + 1)
    assert photon.surface == 1
    assert photon.frame.z == pytest.approx(ends.directions[number], abs=1e-14)


def missing_a_wall():
    """A photon over a finite mirror with a wall at its far end, a hundred thousandth wide."""
    heights = np.zeros((10**5, 3))
    heights[:2, -1] = 1.0
    field = HeightField.from_heights(heights, (1.0, 1.0))
    op.Sample([(1j, field)]).photon(0, "89.99 deg")


FLAT = op.Sample([(1.5, 0.0)])


@rows(
    "ask, sentence",
    [
        (lambda: FLAT.photon(-1), "number must be a whole number of 0 or more"),
        (lambda: FLAT.photon(-1, "95 deg", seed=-1, wavelength="550 nm"), "4 faults"),
        (missing_a_wall, "photons meet nothing of the sample"),
    ],
)
def test_a_photon_that_cannot_be_is_refused(ask, sentence):
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        ask()


def expect_light_of_the_walk(photon, tolerance=1e-12):
    stokes = photon.path().trace().stokes
    assert np.all(np.abs(stokes - photon.stokes) <= tolerance * photon.stokes[0])


@pytest.mark.parametrize(("samples", "photons"), [(6, 3), slow((20, 6)), slow((200, 100))])
def test_the_path_has_the_light_of_the_walk(samples, photons):
    for seed in range(samples):
        sample, incidence = drawn_sample(seed)
        given = {"seed": seed, "stokes": polarised(seed)}
        for number in range(photons):
            expect_light_of_the_walk(sample.photon(number, incidence, **given))


@rows(
    "sample, incidence, kind, tolerance",
    [
        # Refracted within a millionth of total reflection, searched for.
        (op.Sample([(1.0, 0.0)], outside=1.5), np.arcsin(1.0 / 1.5) - 1e-6, "down", 1e-13),
        # Refracted along a facet.
        (op.Sample([(1.5, 0.0)]), np.pi / 2 - 1e-3, "down", 1e-12),
        # Held between a mirror and diamond, for some hundred facets.
        (op.Sample([(2.4, rough(0.1)), (1j, rough(0.1, seed=1))]), 0.5, "held", 1e-12),
    ],
)
def test_the_light_of_a_rare_way_is_that_of_the_walk(sample, incidence, kind, tolerance):
    photons = (sample.photon(number, incidence) for number in range(2000))
    rare = (each for each in photons if kind in (each.end, "held" * (len(each.events) > 100)))
    expect_light_of_the_walk(next(rare), tolerance)
    # A photon that is given up after the most events has its light, too.
    sample = op.Sample([(1.5, 0.0), (1j, 0.0)])
    photons = (sample.photon(number, 0.8, most_events=2) for number in range(100))
    photon = next(each for each in photons if each.end == "stuck")
    assert len(photon.events) == 2
    assert photon.path().trace().stokes == pytest.approx(photon.stokes, abs=1e-13)


def test_nodes_are_called_by_the_order_of_events_and_links_by_what_facets_do():
    photon = op.Sample([(1.5, 0.0), (1j, 0.0)]).photon(1, "50 deg")
    path = photon.path()
    facets = [f"facet-{number}" for number in range(1, len(photon.events) + 1)]
    assert [*path] == ["source", *facets, "detector"]
    assert path.element("facet-2").index == 1j
    kept = path.trace(keep="all")
    ports = ["reflected" if event.reflected else "transmitted" for event in photon.events]
    links = [name.partition(" -> ")[0] for name in kept if " -> " in name]
    assert links == ["source.out", *(f"facet-{n}.{port}" for n, port in enumerate(ports, 1))]
    # A photon that met nothing leaves as it came.
    light = event_path(op.Source(3.0, [1.0, 0.5, 0.0, 0.0]), [], None, "").trace()
    assert np.array_equal(light.stokes, [3.0, 1.5, 0.0, 0.0])


def event(n2, *, reflected):
    up, down = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.6, -0.8])
    place = {"position": np.zeros(3), "on_mesh": np.array([1.25, -1e-9, 12.0])}
    way = {"normal": up, "direction": down, "onwards": down, "cos": 0.8, "sin": 0.6, "turn": -1e-9}
    met = {"reflected": reflected, "probability": 0.25, "n1": 1.0, "n2": n2}
    return PhotonEvent(layer=1, facet=(3, 4, 0), **place, **way, **met)


def test_a_photon_is_printed_with_a_line_for_each_event():
    photon = op.Sample([(1.5, 0.0), (0.5 + 2.1j, 0.0)]).photon(0, ANGLE)
    lines = str(photon).splitlines()
    assert lines[0].startswith(f"Photon 0 of seed 0: {photon.end} after {len(photon.events)} event")
    assert len(lines) == 3 + len(photon.events)
    # Columns stand under their heads, without a sign of zero.
    met = [event(1.5, reflected=False), event(0.5 + 2.1j, reflected=True)]
    expected = """\
   layer                    media   incidence       turn  probability      x      y       z
1      1  refracted       1 | 1.5  36.870 deg  0.000 deg     0.250000  1.250  0.000  12.000
2      1  reflected  1 | 0.5+2.1j  36.870 deg  0.000 deg     0.250000  1.250  0.000  12.000"""
    assert event_table(met) == expected
    # A base of several wavelengths has no single index.
    line = event_table([event(np.array([0.5 + 2.1j, 0.4 + 2.4j]), reflected=True)]).splitlines()[1]
    assert line.split()[3:8] == ["1", "|", "n", "+", "ik"]


def test_a_photon_in_a_flat_film_is_that_of_a_sum_by_hand():
    """Into the film, off the mirror below it, and out again: 1 / (1 - share) for each way through.

    Without a turn, since all planes of incidence are one.
    """
    sample = op.Sample([(1.5, 0.0), (1j, 0.0)])
    photons = (sample.photon(number, ANGLE) for number in range(100))
    photon = next(each for each in photons if len(each.events) == 3)
    s, p = fresnel(1.0, 1.5, ANGLE)
    through = 1.0 - 0.5 * (s + p)
    intensities = ((1.0 - s) / through) ** 2, ((1.0 - p) / through) ** 2
    assert photon.end == "up"
    assert photon.stokes[0] == pytest.approx(0.5 * sum(intensities), rel=1e-13)
    assert photon.stokes[1] == pytest.approx(0.5 * (intensities[0] - intensities[1]), rel=1e-11)
    assert photon.stokes[2:] == pytest.approx(0.0, abs=1e-13)
    assert photon.scalar == pytest.approx(1.0, rel=1e-13)
    assert photon.weight == pytest.approx(through**-2, rel=1e-13)
