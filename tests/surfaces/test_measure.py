"""What is measured: sums over the same photons, flat samples in closed form, symmetries, errors."""

import math

import numpy as np
import pytest

import optipath as op
from optipath import surfaces
from optipath.surfaces import HeightField
from rough_samples import fresnel, rounds
from tables import rows

pytest.importorskip("numba")
pytest.importorskip("xarray")
SILVER = op.Sample([(0.5 + 2.1j, 0.3)], cells=200, surfaces=4)
GLASS = op.Sample([(1.5, 0.3), (2.4, 0.2)], cells=200, surfaces=4)
OBLONG = op.Sample([(0.5 + 2.1j, (0.3, 0.15))], cells=200, surfaces=4)
STATES = [(1, 0, 0, 0), (1, 1, 0, 0), (1, 0, 1, 0), (1, 0, 0, 1)]
PHOTONS = 20_000


def pixels_of(directions, pixels):
    """The pixel of each direction, theta being proportional to the distance from the centre."""
    theta = np.arccos(np.clip(np.abs(directions[:, 2]), 0.0, 1.0))
    azimuth = np.arctan2(directions[:, 1], directions[:, 0])
    x, y = 2.0 * theta / np.pi * np.array([np.cos(azimuth), np.sin(azimuth)])
    column, row = (np.floor((each + 1.0) * pixels / 2.0).astype(int) for each in (x, y))
    return row, column


@rows(
    "sample, incidence, azimuth",
    [(SILVER, "40 deg", 0.0), (GLASS, "60 deg", 0.0), (OBLONG, "50 deg", 0.6), (SILVER, 0.0, 0.0)],
)
def test_mueller_matrices_are_what_photons_of_each_state_carry(sample, incidence, azimuth):
    given = {"azimuth": azimuth, "seed": 2}
    found = op.measure(sample, incidence, PHOTONS, sensor=16, symmetric=False, **given)
    columns = []
    for state in STATES:
        ends = surfaces.photon_ends(sample, incidence, PHOTONS, stokes=state, **given)
        light = np.zeros((len(found.seen.sides), 16, 16, 4))
        for place, side in enumerate(found.seen.sides):
            went = ends.ends == {"reflected": "up", "transmitted": "down"}[side]
            pixels = pixels_of(ends.directions[went], 16)
            np.add.at(light[place], pixels, ends.stokes[went] / PHOTONS)
        columns.append(light)
    columns[1:] = [each - columns[0] for each in columns[1:]]
    assert np.allclose(found.mueller[0][..., 0, :, :], np.stack(columns, -1), rtol=0, atol=1e-13)
    counts = np.zeros((16, 16), int)
    np.add.at(counts, pixels_of(ends.directions[ends.ends == "up"], 16), 1)
    assert np.array_equal(found.dataset["count"].values[0], counts)


@rows("projection", ["equidistant", "equal-area"])
@rows("symmetric", [False, True])
def test_all_pixels_together_are_the_shares_of_energy(projection, symmetric):
    sensor = op.surfaces.Sensor(16, projection)
    found = op.measure(GLASS, "60 deg", PHOTONS, sensor=sensor, seed=3, symmetric=symmetric)
    shares = surfaces.energy(GLASS, "60 deg", PHOTONS, seed=3)
    data = found.dataset.sum(("y", "x")).isel(wavelength=0)
    light = data.mueller.sel({"out": "S0", "in": "S0"})
    for side, name in (("reflected", "R"), ("transmitted", "T")):
        at, which = {"side": side}, lambda of, name=name: float(getattr(of, name))
        assert light.sel(at).item() == pytest.approx(which(shares), rel=1e-12)
        assert data.scalar.sel(at).item() == pytest.approx(which(shares.scalar), rel=1e-12)
        assert data.difference.sel(at).item() == pytest.approx(which(shares.difference), abs=1e-12)


@rows("symmetric", [False, True])
@rows("sample", [SILVER, GLASS, OBLONG])
def test_every_mueller_matrix_is_one_that_there_can_be(sample, symmetric):
    found = op.measure(sample, "65 deg", PHOTONS, sensor=24, symmetric=symmetric).mueller[0]
    lit = found[found[..., 0, 0] > 0.0]
    assert len(lit) > 90
    # S. R. Cloude, Optik 75, 26 (1986): the coherency matrix has no eigenvalue below 0.
    pauli = np.array([np.eye(2), [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]])
    basis = np.einsum("iab,jcd->ijacbd", pauli, pauli.conj()).reshape(4, 4, 4, 4)
    eigenvalues = np.linalg.eigvalsh(np.einsum("nij,ijab->nab", lit, basis) / 4.0)
    assert np.all(eigenvalues > -1e-12 * lit[:, 0, 0, np.newaxis])


@rows("polarized, name", [("polarized", "mueller"), ("scalar", "scalar")])
def test_what_is_left_out_changes_nothing_else(polarized, name):
    both, one = (
        op.measure(GLASS, "60 deg", PHOTONS, sensor=16, polarized=kind)
        for kind in ("both", polarized)
    )
    for each in (name, f"{name}_se"):
        assert np.array_equal(one.dataset[each], both.dataset[each])
    assert {"mueller", "scalar", "difference"} & {*one.dataset} == {name}
    with pytest.raises(op.errors.SurfaceError, match="measure with polarized='both' or"):
        _ = one.difference


def test_wavelengths_ride_on_the_same_photons():
    gold = op.Sample([(1.5, 0.2), (op.Material.named("gold"), 0.2)], cells=200, surfaces=2)
    lengths = ["450 nm", "550 nm", "650 nm"]
    together = op.measure(gold, "50 deg", PHOTONS, lengths, sensor=16).dataset
    for place, length in enumerate(lengths):
        alone = op.measure(gold, "50 deg", PHOTONS, length, sensor=16).dataset
        for name in ("mueller", "mueller_se", "scalar", "difference", "difference_se"):
            expected = together[name].isel(wavelength=[place])
            assert np.allclose(alone[name], expected, rtol=1e-13, atol=1e-18)
        assert np.array_equal(alone["count"], together["count"])
    assert together.wavelength.values.tolist() == [450e-9, 550e-9, 650e-9]


def test_threads_change_no_bits_and_photons_by_number_of_facets_met_are_all_there_are():
    given = {"photons": 70_001, "sensor": 16}
    one, *others = [op.measure(GLASS, "60 deg", threads=n, **given).parts for n in (1, 2, 5)]
    for other in others:
        assert all(np.array_equal(*each) for each in zip(one, other, strict=True))
    assert one.photons.sum() == 70_001
    # Those that have met each number of facets are all.
    sample = op.Sample([(0.5 + 2.1j, 0.5)], cells=640, surfaces=1)
    whole = op.measure(sample, "50 deg", 5000, sensor=8).parts
    each = [op.measure(sample, "50 deg", 5000, sensor=8, events=n).parts for n in range(1, 13)]
    assert np.array_equal(sum(part.counts for part in each), whole.counts)
    assert np.allclose(sum(part.sums for part in each), whole.sums, rtol=0, atol=1e-10)
    assert each[0].counts.sum() > each[1].counts.sum() > 0


@rows(
    "given, sentence",
    [
        *(({"azimuth": f"{a} deg", "symmetric": True}, "symmetric is True") for a in (30, 90)),
        # Before photons are walked.
        ({"sensor": 100_000}, "fewer pixels, wavelengths or parts"),
    ],
)
def test_what_cannot_be_measured_is_told_and_all_of_it_at_once(given, sentence):
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        op.measure(OBLONG, "40 deg", 100, **given)
    wrong = dict.fromkeys(("events", "most_events", "threads"), 0)
    wrong |= {"azimuth": "x", "symmetric": 2, "progress": 3}
    with pytest.raises(op.errors.SurfaceError) as caught:
        op.measure(SILVER, "95 deg", 0, "red", "equal", -1, "yes", **wrong)
    text = "\n".join(caught.value.faults)
    for name in (*wrong, "photons", "polarized", "projection", "incidence", "seed", "wavelength"):
        assert name in text, name


GLASS_ON_DIAMOND = op.Sample([(1.5, 0.0), (2.4, 0.0)])
MEDIA = [(1.0, 1.5, 2.4), (1.5, 1.2), (1.0, 1.5, 1.3, 0.2 + 3.4j), (1.7, 1.2, 2.0)]
MEDIA += [(1.33, 2.4, 1.1, 1.8), (1.5, 1.2, 1j)]
SAMPLES = [op.Sample([(index, 0.0) for index in below], outside) for outside, *below in MEDIA]
# Without it, no photon is walked over what is flat.
WALKED = {"most_events": 999}


def gathered(found):
    """All light of each side, with errors: Mueller matrices, and what is without polarisation."""
    return [
        found.own.estimate(lambda light, of=of: of(light).sum(axis=(1, 2)))
        for of in (found.matrices, found.intensities)
    ]


@rows("incidence", ["0 deg", "45 deg", "70 deg"])
@rows("sample", [*SAMPLES, op.Sample([(1.5, HeightField.flat())])])
def test_light_of_flat_samples_that_is_known_is_that_of_photons(sample, incidence):
    known = op.measure(sample, incidence, sensor=9)
    walked = op.measure(sample, incidence, 10_000, sensor=9, **WALKED)
    assert walked.photons == 10_000
    for (exact, none), (mean, error) in zip(gathered(known), gathered(walked), strict=True):
        assert np.all(none == 0.0)
        assert np.all(np.abs(mean - exact) < 5.0 * error + 1e-12)
    # What is rounded may go into the pixel beside, at its border.
    assert np.all(walked.scalar[0][known.scalar[0] > 0.0] > 0.0)


@rows("incidence, percent", [(50, 1.785), (56, 2.498), (60, 2.9), (65, 3.167)])
def test_rounds_between_two_faces_add_up_to_a_geometric_series(incidence, percent):
    known = op.measure(GLASS_ON_DIAMOND, f"{incidence} deg", sensor=32)
    (matrix, _), (scalar, _) = gathered(known)
    theta = math.radians(incidence)
    faces = fresnel(1.0, 1.5, theta), fresnel(1.5, 2.4, math.asin(math.sin(theta) / 1.5))
    (along_s, along_p), by_means = rounds(*faces), rounds(*np.mean(faces, axis=-1))
    assert matrix[0, 0, 0, 0] == pytest.approx(0.5 * (along_s + along_p), rel=1e-13)
    assert matrix[0, 0, 1, 0] == pytest.approx(0.5 * (along_s - along_p), rel=1e-13)
    assert scalar[0, 0] == pytest.approx(by_means, rel=1e-13)
    assert [matrix[:, 0, 0, 0].sum(), scalar.sum()] == pytest.approx([1.0, 1.0], abs=1e-14)
    assert 100.0 * float(known.adm().max()) == pytest.approx(percent, abs=6e-4)


def test_nothing_is_counted_and_nothing_is_uncertain():
    known = op.measure(GLASS_ON_DIAMOND, "65 deg", sensor=8)
    assert known.photons == known.dataset.attrs["photons"] == 0
    for name in ("count", "mueller_se", "scalar_se", "difference_se"):
        assert not known.dataset[name].any(), name
    assert "known without photons" in repr(known)
    for polarized, numbers in (("polarized", 16), ("scalar", 1)):
        known = op.measure(GLASS_ON_DIAMOND, "65 deg", sensor=8, polarized=polarized)
        assert known.parts.sums.shape[-1] == numbers
        assert known.parts.sums[..., 0].sum() == pytest.approx(1.0, abs=1e-14)
    # Light that is cut short is walked: what the first face reflects.
    once = op.measure(GLASS_ON_DIAMOND, "65 deg", 20_000, sensor=8, events=1)
    assert once.photons == 20_000
    share = fresnel(1.0, 1.5, math.radians(65.0)).mean()
    assert once.scalar[0][0].sum() == pytest.approx(share, abs=0.01)


def reflected(index, cos):
    """Fresnel's matrix of reflection, in the frame of s and p."""
    g = np.sqrt(index**2 - 1.0 + cos**2 + 0j)
    r_s, r_p = (cos - g) / (cos + g), (index**2 * cos - g) / (index**2 * cos + g)
    a, b = (abs(r_s) ** 2 + abs(r_p) ** 2) / 2.0, (abs(r_s) ** 2 - abs(r_p) ** 2) / 2.0
    c = r_s * np.conj(r_p)
    return np.array([[a, b, 0, 0], [b, a, 0, 0], [0, 0, c.real, c.imag], [0, 0, -c.imag, c.real]])


def lit_pixel(found, side=0):
    ((row, column),) = np.argwhere(found.dataset["count"].values[side] > 0)
    return row, column, found.mueller[0][side, row, column, 0]


@rows("index", [0.5 + 2.1j, 0.2 + 3.4j, 1j])
@rows("incidence", [0.0, 10.0, 47.0, 80.0])
def test_opaque_ones_reflect_by_fresnels_matrix(index, incidence):
    found = op.measure(op.Sample([(index, 0.0)]), f"{incidence} deg", 1000, sensor=33, **WALKED)
    row, column, matrix = lit_pixel(found)
    assert (row, column) == (16, int((incidence / 90.0 + 1.0) * 33 / 2.0))
    assert np.allclose(matrix, reflected(index, np.cos(np.radians(incidence))), atol=1e-13)
    assert np.all(found.mueller[1] < 1e-14)


def test_glass_lets_light_through_into_one_pixel_and_reflects_along_s_at_brewsters_angle():
    found = op.measure(op.Sample([(1.5, 0.0)]), "50 deg", 60_000, sensor=33, **WALKED)
    _, _, matrix = lit_pixel(found)
    row, column, through = lit_pixel(found, side=1)
    mirror = reflected(1.5, np.cos(np.radians(50.0)))
    below = np.degrees(np.arcsin(np.sin(np.radians(50.0)) / 1.5))
    assert (row, column) == (16, int((below / 90.0 + 1.0) * 33 / 2.0))
    # T = 1 - F of s and p; between them the square root of the product.
    share, apart = mirror[0, 0], mirror[0, 1]
    expected = np.diag([1.0 - share] * 2 + [np.sqrt((1.0 - share) ** 2 - apart**2)] * 2)
    expected[0, 1] = expected[1, 0] = -apart
    error = np.sqrt(share * (1.0 - share) / 60_000)
    for value, closed in ((matrix, mirror), (through, expected)):
        assert np.allclose(value / value[0, 0], closed / closed[0, 0], atol=1e-12)
        assert abs(value[0, 0] - closed[0, 0]) < 5.0 * error
    # At Brewster's angle light is reflected along s.
    found = op.measure(op.Sample([(1.5, 0.0)]), math.atan(1.5), 20_000, sensor=33, **WALKED)
    row, column, _ = lit_pixel(found)
    light = [each.values[0, row, column, 0] for each in (found.dolp(), found.aop())]
    assert light == pytest.approx([1.0, 0.0], abs=1e-12)


SIGNS = np.outer([1.0, 1.0, -1.0, -1.0], [1.0, 1.0, -1.0, -1.0])
FINE = op.Sample([(0.5 + 2.1j, 0.3)], cells=320, surfaces=8)
FINE_OBLONG = op.Sample([(0.5 + 2.1j, (0.3, 0.15))], cells=320, surfaces=8)


def halves(found):
    """The squares of differences between the halves of a hemisphere over those of their errors."""
    apart, errors = (
        each[0, ..., 0, :, :]
        for each in found.own.estimate(
            lambda light: found.matrices(light) - SIGNS * found.matrices(light)[:, ::-1]
        )
    )
    counts = found.dataset["count"].values[0]
    lit = np.minimum(counts, counts[::-1]) > 60
    lit[: len(lit) // 2] = False
    return (apart[lit] / np.where(errors[lit] > 0.0, errors[lit], np.inf)) ** 2


@rows(
    "sample, incidence, azimuth",
    [
        (FINE, "50 deg", 0.0),
        (op.Sample([(1.5, 0.3), (0.2 + 3.4j, 0.2)], cells=320, surfaces=8), "40 deg", 0.0),
        *((FINE_OBLONG, "40 deg", azimuth) for azimuth in (0.0, np.pi, "45 deg")),
    ],
)
def test_the_halves_beside_the_plane_of_incidence_are_mirror_images_along_the_axes_of_a_sample(
    sample, incidence, azimuth
):
    across = azimuth == "45 deg"
    given = {"sensor": 16, "azimuth": azimuth, "seed": 3, "symmetric": None if across else False}
    found = op.measure(sample, incidence, 60_000, **given)
    squares = halves(found)
    if across:
        assert not found.symmetric
        assert squares.mean() > 10.0
    else:
        assert len(squares) > 10
        # Of errors by 7 degrees of freedom; 1.4 where nothing is the matter.
        assert 0.5 < squares.mean() < 3.0
        assert squares.max() < 80.0


def test_means_with_mirror_images_are_what_they_say():
    plain, both = (
        op.measure(FINE, "50 deg", 20_000, sensor=16, symmetric=each) for each in (False, True)
    )
    value = plain.mueller[0]
    expected = 0.5 * (value + SIGNS * value[:, ::-1])
    assert np.allclose(both.mueller[0], expected, rtol=1e-13, atol=1e-18)
    assert np.array_equal(both.dataset["count"], plain.dataset["count"])
    # Projections have the same light in quarters.
    other = op.measure(FINE, "50 deg", 20_000, sensor=surfaces.Sensor(16, "equal-area"))
    one, other = (
        each.mueller[0].reshape(1, 2, 8, 2, 8, 1, 4, 4).sum(axis=(2, 4)) for each in (both, other)
    )
    assert np.allclose(one, other, rtol=1e-12, atol=1e-16)


def test_light_along_the_normal_is_the_same_all_round():
    found = op.measure(FINE, 0.0, 200_000, sensor=16)
    light, aop = (each.isel(side=0, wavelength=0) for each in (found.stokes(), found.aop()))
    lit = found.dataset["count"].values[0] > 200
    for name in ("S0", "S1"):
        array = light.sel(out=name)
        apart = array.values - array.values.T
        errors = np.hypot(array.se.values, array.se.values.T)
        there = lit & (errors > 0)
        assert np.mean((apart[there] / errors[there]) ** 2) < 1.6
    # Facets polarise along s, perpendicular to the meridional plane.
    far = lit & (found.sensor.theta > np.radians(30.0))
    assert np.all(np.abs(aop.values[far]) < 5.0 * aop.se.values[far] + np.radians(1.0))


def measured(surfaces):
    """Hemispheres of other photons, and of other surfaces."""
    for seed in range(30):
        sample = op.Sample([(0.5 + 2.1j, 0.3)], cells=200, seed=seed, surfaces=surfaces)
        yield op.measure(sample, "40 deg", 4096, sensor=6, seed=seed)


def ratio(hemispheres, of, turned=lambda values: values):
    """The variance among seeds over the mean square of errors, the mean of all numbers.

    Of the pixels into which many photons have gone each time.
    """
    counts = np.array([each.dataset["count"].values[..., np.newaxis] for each in hemispheres])
    lit = (counts > 60).all(axis=0)
    assert lit.sum() >= 5
    pairs = zip(*map(of, hemispheres), strict=True)
    values, errors = (np.array([each[lit] for each in some]) for some in pairs)
    return np.mean(turned(values).var(axis=0, ddof=1) / np.mean(errors**2, axis=0))


def element(row, column):
    return lambda found: [each[..., row, column] for each in found.mueller]


def with_error(array):
    return array.values, array.se.values


def about_the_first(angles):
    return np.remainder(angles - angles[0] + np.pi / 2.0, np.pi)


@pytest.mark.slow
def test_what_is_found_with_other_seeds_differs_by_its_errors():
    hemispheres, source = [*measured(4)], [1.0, -0.4, 0.5, 0.3]
    elements = [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2), (3, 3), (1, 2), (3, 2)]
    for of, *turned in (
        *((element(*at),) for at in elements),
        (lambda found: found.difference,),
        (lambda found: with_error(found.dop(source)),),
        (lambda found: with_error(found.dolp(source)),),
        (lambda found: with_error(found.aop(source)), about_the_first),
    ):
        assert 0.6 < ratio(hemispheres, of, *turned) < 1.7
    # Where two surfaces are all, each is a part by itself, and the error how far they are apart.
    hemispheres = [*measured(2)]
    assert all(np.count_nonzero(each.parts.photons) == 2 for each in hemispheres)
    assert 0.5 < ratio(hemispheres, element(0, 0)) < 2.0


@rows("azimuth", ["20 deg", "100 deg"])
def test_a_sample_with_a_direction_is_seen_from_its_own_axes(azimuth):
    sample, angle = op.Sample([(1j, (0.02, 0.02 + 1e-9))]), np.radians(float(azimuth.split()[0]))
    found = op.measure(sample, "45 deg", 2000, sensor=16, azimuth=azimuth)
    assert not found.symmetric
    row, column = np.unravel_index(found.dataset["count"].values[0].argmax(), (16, 16))
    there = np.array([found.sensor.coordinates[column], found.sensor.coordinates[row]])
    assert np.abs(there - 0.5 * np.array([np.cos(angle), np.sin(angle)])).max() < 0.125
