"""The light of photons, beside closed forms, kernels, symmetries and small steps."""

import math

import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from tables import rows

pytest.importorskip("numba")

from optipath.kernels.carriers.carried import carry
from optipath.kernels.carriers.structures import BLOCK, ROTATION
from optipath.kernels.facets import plane_at_facet, reflected_at_facet, refracted_at_facet
from optipath.kernels.fresnel.stable import (
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
)
from optipath.kernels.primitives import FLOAT
from optipath.surfaces.walk import layout
from optipath.surfaces.walk.beam import beam_of

SIGMAS = 5.5


def test_glass_on_diamond_is_as_published():
    sample = op.Sample([(1.5, 0), (2.4, 0)])
    found = surfaces.energy(sample, "65 deg", photons=400_000)
    assert abs(found.R - 0.16024) < 5.0 * found.R_se + 5e-6
    assert abs(found.scalar.R - 0.16548) < 5.0 * found.scalar.R_se + 5e-6
    assert abs(found.difference.R - (0.16024 - 0.16548)) < 5.0 * found.difference.R_se
    assert found.difference.R_se < 0.2 * found.R_se
    ends = surfaces.photon_ends(sample, "65 deg", photons=200_000)
    s0, s1, s2, s3 = ends.stokes[ends.ends == "up"].sum(axis=0)
    assert math.hypot(s1, s2) / s0 == pytest.approx(0.766, abs=5e-3)
    assert s1 > 0.0
    assert abs(s2) < 1e-12 * s0
    assert s3 == 0.0


def test_slightly_rough_is_nearly_flat_and_all_sizes_reflect_alike():
    rough, flat = (op.Sample([(1.5, a), (2.4, a)], surfaces=1) for a in (1e-3, 0))
    found = surfaces.energy(rough, 1.0, photons=200_000)
    exact = flat.smooth(1.0).mueller("in", "reflected").matrix[0, 0]
    assert abs(found.R - exact) < SIGMAS * found.R_se + 1e-5
    heights, shares = np.random.default_rng(0).normal(size=(16, 16)), set()
    for size in (2.0**-20, 1.0, 2.0**20):
        field = surfaces.HeightField(size * heights, 16 * size, periodic=True)
        shares.add(float(surfaces.energy(op.Sample([(1.5, field)]), 0.8, photons=20_000).R))
    assert len(shares) == 1


ELLIPTICAL = (1.0, 0.3, -0.4, 0.5)


def vector(record, place):
    return tuple(record[place : place + 3].tolist())


def after_events(record, base):
    """The light of a photon, its direction and x, by kernels of plain floats."""
    light, k, x = carry(FLOAT, ELLIPTICAL), *(vector(record[0], at) for at in (2, 5))
    for event in record[1 : 1 + int(record[0, layout.EVENTS])].tolist():
        normal = tuple(event[layout.NORMAL : layout.NORMAL + 3])
        n1, n2 = event[layout.N1], event[layout.N2]
        cos, sin, x, *turn = plane_at_facet(FLOAT)(k, x, normal)
        assert [cos, sin, *turn] == event[layout.COS : layout.COS + 4]
        numbers, k, share = met(n1, n2, base, cos, sin, k, normal, event)
        light = ROTATION.action(FLOAT, turn, light, 4)
        light = BLOCK.action(FLOAT, [1.0 / share * each for each in numbers], light, 4)
    return light, k, x


def met(n1, n2, base, cos, sin, k, normal, event):
    """The numbers of the Mueller matrix of an event, the direction behind, and the share."""
    ahead = reflected_at_facet(k, normal, cos)
    if n2 == layout.OPAQUE:
        return stable_reflection(FLOAT)(n1, *base, cos, sin), ahead, 1.0
    if event[layout.REFLECTED]:
        numbers = lossless_reflection(FLOAT)(n1, n2, cos, sin)
    else:
        numbers = lossless_transmission(FLOAT)(n1, n2, cos, sin)
        ahead = refracted_at_facet(FLOAT)(n1, n2, k, normal, cos, sin)
    share = 0.5 * (numbers[0] + numbers[1])
    assert share == event[layout.SHARE]
    return numbers, ahead, share


def expect_kernels(sample, incidence, photons):
    beam = beam_of(sample, incidence, 0.3, stokes=ELLIPTICAL)
    base = beam.indices.n.item(), beam.indices.k.item()
    ends = set()
    for number in range(photons):
        walked = beam.block(0, wanted=number)
        light, k, x = after_events(walked.record, base)
        assert walked.lights[0, :4].tolist() == list(light)
        assert vector(walked.record[0], layout.LAST_K) == k
        assert vector(walked.record[0], layout.LAST_X) == x
        ends.add(walked.record[0, layout.OUTCOME])
    return ends


@pytest.mark.filterwarnings("ignore::optipath.errors.MeshWarning")
def test_light_at_flat_and_rough_interfaces_is_that_of_kernels():
    incidences = (0.0, 1e-9, 0.7, math.atan(1.5), 1.5, math.pi / 2 - 1e-9)
    for indices in ([1.5], [1.5, 2.4], [1.5, 0.2 + 3.4j], [1j]):
        for incidence in incidences:
            expect_kernels(op.Sample([(index, 0) for index in indices]), incidence, 20)
    for apart in (-0.3, -1e-8, 0.0, 1e-8, 0.3):
        critical = math.asin(1 / 1.5)
        ends = expect_kernels(op.Sample([(1.0, 0)], outside=1.5), critical + apart, 50)
        assert apart <= 0.0 or layout.DOWN not in ends
    for layers in (
        [(1.5, 1.0)],
        [(1.5, 0.3), (2.4, (0.2, 0.5)), (1.3, 0.6)],
        [(1.5, 0.5), (0.5 + 2.1j, 0.7)],
        [(1.5, 0.5), (1j, 0.7)],
    ):
        expect_kernels(op.Sample(layers, cells=160, surfaces=1), 1.0, 40)


PHOTONS, SAME = 100_000, np.eye(2)
HEIGHTS = np.random.default_rng(5).normal(size=(12, 9))


def walked(heights, azimuth, *, seed, stokes=(1.0, 0.5, 0.3, 0.4), index=0.5 + 2.1j):
    """Light that goes up, and where it goes."""
    size = np.array(heights.shape[::-1]) * 1.5
    field = surfaces.HeightField(heights, tuple(size), periodic=True)
    return surfaces.photon_ends(
        op.Sample([(index, field)]), 0.9, PHOTONS, azimuth=azimuth, stokes=stokes, seed=seed
    )


def moments(ends, turn=SAME, signs=(1.0, 1.0, 1.0, 1.0)):
    """Means of Stokes vectors, alone and by direction, and their errors."""
    light = np.where((ends.ends == "up")[:, np.newaxis], ends.stokes * signs, 0.0)
    along = ends.directions[:, :2] @ np.transpose(turn)
    found = light[:, :, np.newaxis] * np.column_stack([np.ones(PHOTONS), along])[:, np.newaxis]
    return found.mean(axis=0), found.var(axis=0) / PHOTONS


@rows("index", [1.5, 0.5 + 2.1j])
def test_a_surface_turned_over_or_mirrored_with_the_light_does_so_to_the_result(index):
    source, signs = np.array([1.0, 0.5, 0.3, 0.4]), np.array([1.0, 1.0, -1.0, -1.0])
    first, its = moments(walked(HEIGHTS, 0.4, seed=1, index=index))
    turned = walked(HEIGHTS[::-1, ::-1], 0.4 + math.pi, seed=2, index=index)
    azimuth = math.pi / 2 - 0.4
    mirrored = walked(HEIGHTS.T, azimuth, seed=2, stokes=signs * source, index=index)
    for second, others in (moments(turned, -SAME), moments(mirrored, SAME[::-1], signs)):
        assert np.all(np.abs(first - second) < SIGMAS * np.sqrt(its + others) + 1e-12)


def test_what_goes_from_here_to_there_goes_from_there_to_here():
    # Helmholtz's reciprocity, by all that goes into rings of 6 degrees.
    sample = op.Sample([(1.5, 0.3), (0.2 + 3.4j, 0.3)], cells=200, surfaces=1)
    here, there = math.radians(25), math.radians(50)
    (one, its), (other, others) = ring(sample, here, there), ring(sample, there, here)
    assert its < 0.02 * one
    assert abs(one - other) < SIGMAS * math.hypot(its, others)


def ring(sample, incidence, at):
    """The radiance about an angle of light that comes at another, and its error."""
    ends = surfaces.photon_ends(sample, incidence, PHOTONS)
    angles, half = np.arccos(np.clip(ends.directions[:, 2], -1.0, 1.0)), math.radians(3)
    light = np.where(np.abs(angles - at) < half, ends.stokes[:, 0], 0.0)
    projected = math.pi * (math.sin(at + half) ** 2 - math.sin(at - half) ** 2)
    return light.mean() / projected, light.std() / math.sqrt(PHOTONS) / projected


# Photons over a smooth surface of a few waves, by small steps: no mesh, no code of the library.
#
# Intensities alone, without polarisation. What is met is found where the height above the surface
# changes sign, to the last digits by halving; a photon is reflected by the mean of Fresnel's
# shares. The surface is periodic, with the period 1 along x and y.
WAVES = [(1, 0, 0.3), (0, 1, 1.1), (1, 1, 2.0), (1, -1, 4.0), (2, 1, 0.5), (-1, 2, 3.3)]
"""Whole numbers of waves along x and along y, and phases."""
VECTORS, PHASES = 2 * np.pi * np.array(WAVES)[:, :2], np.array(WAVES)[:, 2]
MOST, AMPLITUDE, HIGHEST = 20, 0.05, 0.05 * len(WAVES)


def heights(places):
    return AMPLITUDE * np.cos(places[..., :2] @ VECTORS.T + PHASES).sum(axis=-1)


def shares(index, incidence, photons, numbers):
    """The shares that go up and down after 1, 2, ... events, each of shape (MOST,)."""
    places = np.column_stack([numbers.random((photons, 2)), np.full(photons, HIGHEST)])
    ways = np.tile([np.sin(incidence), 0.0, -np.cos(incidence)], (photons, 1))
    sides, up, down = np.ones(photons), np.zeros(MOST), np.zeros(MOST)
    for number in range(MOST):
        met, places = next_places(places, ways, sides)
        up[number - 1] += np.sum(~met & (sides > 0))
        down[number - 1] += np.sum(~met & (sides < 0))
        places, ways, sides = places[met], ways[met], sides[met]
        ways, sides = reflected_or_refracted(index, places, ways, sides, numbers)
    return up / photons, down / photons


def next_places(places, ways, sides):
    """Whether photons meet the surface again, and where."""

    def below(lengths):
        there = places + lengths[:, np.newaxis] * ways
        return sides * (there[:, 2] - heights(there)) < 0

    towards = np.where(ways[:, 2] > 0, HIGHEST, -HIGHEST)
    lengths = (towards - places[:, 2]) / ways[:, 2]
    begin, end, met = np.zeros(len(places)), np.zeros(len(places)), np.zeros(len(places), bool)
    # The first step leaves the surface that a photon comes from.
    for step in np.linspace(0.0, 1.0, 201)[1:]:
        crossed = ~met & below(step * lengths)
        begin[~met], end[~met] = end[~met], (step * lengths)[~met]
        met |= crossed
    for _ in range(40):
        middle = 0.5 * (begin + end)
        begin, end = np.where(below(middle), [begin, middle], [middle, end])
    return met, places + begin[:, np.newaxis] * ways


def reflected_or_refracted(index, places, ways, sides, numbers):
    """Directions and sides behind an event."""
    slopes = -AMPLITUDE * np.sin(places[:, :2] @ VECTORS.T + PHASES) @ VECTORS
    normals = sides[:, np.newaxis] * np.column_stack([-slopes, np.ones(len(slopes))])
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    n1, n2 = np.where(sides > 0, 1.0, index), np.where(sides > 0, index, 1.0)
    cos = -np.sum(normals * ways, axis=-1)
    behind = 1.0 - (n1 / n2) ** 2 * (1.0 - cos**2)
    other = np.sqrt(np.maximum(behind, 0.0))
    of_s = ((n1 * cos - n2 * other) / (n1 * cos + n2 * other)) ** 2
    of_p = ((n2 * cos - n1 * other) / (n2 * cos + n1 * other)) ** 2
    back = (numbers.random(len(cos)) < 0.5 * (of_s + of_p)) | (behind <= 0.0)
    reflected = ways + (2 * cos)[:, np.newaxis] * normals
    refracted = (n1 / n2)[:, np.newaxis] * ways + (n1 / n2 * cos - other)[:, np.newaxis] * normals
    return np.where(back[:, np.newaxis], reflected, refracted), np.where(back, sides, -sides)


def test_as_many_photons_leave_after_each_number_of_events(rng):
    cells, walks = 256, 4000
    grid = np.stack(np.meshgrid(np.arange(cells), np.arange(cells)), axis=-1) / cells
    field = surfaces.HeightField(heights(grid), 1.0, periodic=True)
    found = surfaces.energy(op.Sample([(1.5, field)]), 1.0, photons=200_000).scalar
    up, down = shares(1.5, 1.0, walks, rng)
    for one, other in ((up, found.reflected), (down, found.transmitted)):
        counted, expected = (np.array([*each[:3], each[3:].sum()]) for each in (one, other))
        error = np.sqrt((expected + 1.0 / walks) / walks)
        assert np.all(np.abs(counted - expected) < SIGMAS * error)
    assert found.transmitted[1] > 0.05


def test_frames_are_perpendicular_to_the_meridional_plane_and_light_is_polarised_as_it_can_be():
    found = surfaces.photon_ends(op.Sample([(0.5 + 2.1j, 0.3)]), "40 deg", photons=20_000)
    across = np.cross([0.0, 0.0, 1.0], found.directions)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    assert np.allclose(found.x, across, atol=1e-9)
    assert np.allclose(np.linalg.norm(found.directions, axis=-1), 1.0, atol=1e-12)
    # Not circularly after one event, and by no more than all of it.
    assert np.all(found.stokes[found.events == 1, 3] == 0.0)
    assert np.any(found.stokes[found.events > 1, 3] != 0.0)
    sample = op.Sample([(1.5, 0.5), (0.5 + 2.1j, 0.7)], surfaces=4)
    stokes = surfaces.photon_ends(sample, "70 deg", photons=20_000).stokes
    assert np.all(stokes[:, 0] >= 0.0)
    assert np.all(np.linalg.norm(stokes[:, 1:], axis=-1) <= stokes[:, 0] * (1.0 + 1e-12))
    # At several wavelengths it has an axis for them.
    gold = op.Sample([(op.Material.named("gold"), 0.3)])
    found = surfaces.photon_ends(gold, "40 deg", photons=50, wavelength=[450e-9, 650e-9])
    assert (found.stokes.shape, found.scalar.shape) == ((50, 2, 4), (50, 2))
    with pytest.raises(op.errors.SurfaceError, match="photons must be a whole number of 1 or more"):
        surfaces.photon_ends(gold, "40 deg", photons=0)


def test_light_along_the_normal_is_in_the_frame_of_light_beside_it():
    # Light reflected by a flat mirror goes on along x.
    found = surfaces.photon_ends(op.Sample([(1j, 0)]), "30 deg", photons=100)
    assert np.allclose(found.directions, [0.5, 0.0, np.sqrt(0.75)], atol=1e-12)
    assert np.allclose(found.x, [0.0, 1.0, 0.0], atol=1e-12)
    # A flat face sends polarised light back as it was, however the sample below it lies.
    sample = op.Sample([(1.5, 0.0), (0.5 + 2.1j, (0.3, 0.15))], cells=400)
    found = surfaces.photon_ends(sample, 0.0, 200, azimuth=0.7, stokes=[1, 1, 0, 0])
    once = found.events == 1
    assert np.all(found.x[once] == [0.0, 1.0, 0.0])
    # It vibrates along (-sin 0.7, cos 0.7, 0), and y is (-1, 0, 0).
    along, across = np.cos(0.7), np.sin(0.7)
    expected = [1.0, along**2 - across**2, 2.0 * along * across, 0.0]
    np.testing.assert_allclose(found.stokes[once], [expected] * once.sum(), rtol=0, atol=1e-14)


def test_turning_an_anisotropic_sample_and_the_light_changes_nothing():
    def walk(alpha, azimuth, seed=0):
        sample = op.Sample([(0.5 + 2.1j, alpha)], cells=(400, 400), surfaces=4)
        return surfaces.energy(sample, "60 deg", photons=4 * 16384, azimuth=azimuth, seed=seed)

    one, other = walk((0.3, 0.1), 0.5), walk((0.1, 0.3), 0.5 + math.pi / 2, seed=1)
    for name in ("R_s", "R_m", "R"):
        error = math.hypot(getattr(one, f"{name}_se"), getattr(other, f"{name}_se"))
        assert abs(getattr(one, name) - getattr(other, name)) < SIGMAS * error
    crossed = walk((0.1, 0.3), 0.5)
    assert abs(crossed.R_m - one.R_m) > SIGMAS * crossed.R_m_se


@rows("incidence", [0.0, 0.9, 1.4])
@rows(
    "outside, indices",
    [
        (1.0, (1.5,)),
        (1.7, (1.2, 2.0)),
        (1.0, (1.3, 1.5, 0.2 + 3.4j)),
        (1.33, (2.4, 1.1, 1.8)),
        (1.5, (1.2, 1j)),
    ],
)
def test_stokes_vectors_are_those_of_a_stack_of_layers(outside, indices, incidence):
    sample = op.Sample([(index, 0) for index in indices], outside=outside)
    source = np.array([1.0, 0.3, -0.4, 0.5])
    ends = surfaces.photon_ends(sample, incidence, 50_000, azimuth=0.7, stokes=source, seed=2)
    light = np.where((ends.ends == "up")[:, np.newaxis], ends.stokes, 0.0)
    error = light.std(axis=0) / math.sqrt(len(light))
    stack = sample.smooth(incidence).mueller("in", "reflected")
    apart = light.mean(axis=0) - stack.matrix @ source
    assert np.all(np.abs(apart) < SIGMAS * error + 1e-12)
