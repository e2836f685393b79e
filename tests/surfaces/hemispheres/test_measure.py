"""What a hemisphere has of photons, beside sums over the same photons that are made here."""

import numpy as np
import pytest

import optipath as op
from optipath import surfaces

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


@pytest.mark.parametrize(
    ("sample", "incidence", "azimuth"),
    [(SILVER, "40 deg", 0.0), (GLASS, "60 deg", 0.0), (OBLONG, "50 deg", 0.6), (SILVER, 0.0, 0.0)],
)
def test_mueller_matrices_are_what_photons_of_each_state_carry(sample, incidence, azimuth):
    found = op.measure(
        sample, incidence, PHOTONS, sensor=16, seed=2, azimuth=azimuth, symmetric=False
    )
    columns = []
    for state in STATES:
        ends = surfaces.photon_ends(
            sample, incidence, PHOTONS, azimuth=azimuth, stokes=state, seed=2
        )
        sides = []
        for side in found.seen.sides:
            went = ends.ends == {"reflected": "up", "transmitted": "down"}[side]
            light = np.zeros((16, 16, 4))
            np.add.at(light, pixels_of(ends.directions[went], 16), ends.stokes[went] / PHOTONS)
            sides.append(light)
        columns.append(np.array(sides))
    columns[1:] = [each - columns[0] for each in columns[1:]]
    assert np.allclose(found.mueller[0][..., 0, :, :], np.stack(columns, -1), rtol=0, atol=1e-13)
    up = ends.ends == "up"
    counts = np.zeros((16, 16), int)
    np.add.at(counts, pixels_of(ends.directions[up], 16), 1)
    assert np.array_equal(found.dataset["count"].values[0], counts)


@pytest.mark.parametrize("projection", ["equidistant", "equal-area"])
@pytest.mark.parametrize("symmetric", [False, True])
def test_all_pixels_together_are_the_shares_of_energy(projection, symmetric):
    sensor = op.surfaces.Sensor(16, projection)
    found = op.measure(GLASS, "60 deg", PHOTONS, sensor=sensor, seed=3, symmetric=symmetric)
    shares = surfaces.energy(GLASS, "60 deg", PHOTONS, seed=3)
    data = found.dataset.sum(("y", "x")).isel(wavelength=0)
    light = data.mueller.sel({"out": "S0", "in": "S0"})
    for side, name in (("reflected", "R"), ("transmitted", "T")):
        assert light.sel(side=side).item() == pytest.approx(float(getattr(shares, name)), rel=1e-12)
        scalar = float(getattr(shares.scalar, name))
        assert data.scalar.sel(side=side).item() == pytest.approx(scalar, rel=1e-12)
        apart = float(getattr(shares.difference, name))
        assert data.difference.sel(side=side).item() == pytest.approx(apart, abs=1e-12)


@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize(("sample", "azimuth"), [(SILVER, 0.0), (GLASS, 0.0), (OBLONG, 0.0)])
def test_every_mueller_matrix_is_one_that_there_can_be(sample, azimuth, symmetric):
    found = op.measure(
        sample, "65 deg", PHOTONS, sensor=24, azimuth=azimuth, symmetric=symmetric
    ).mueller[0]
    lit = found[found[..., 0, 0] > 0.0]
    assert len(lit) > 90
    # S. R. Cloude, Optik 75, 26 (1986): the coherency matrix has no eigenvalue below 0.
    pauli = np.array(
        [[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]], complex
    )
    basis = np.einsum("iab,jcd->ijacbd", pauli, pauli.conj()).reshape(4, 4, 4, 4)
    eigenvalues = np.linalg.eigvalsh(np.einsum("nij,ijab->nab", lit, basis) / 4.0)
    assert np.all(eigenvalues > -1e-12 * lit[:, 0, 0, np.newaxis])


@pytest.mark.parametrize("polarized", ["polarized", "scalar"])
def test_what_is_left_out_changes_nothing_else(polarized):
    both = op.measure(GLASS, "60 deg", PHOTONS, sensor=16)
    one = op.measure(GLASS, "60 deg", PHOTONS, sensor=16, polarized=polarized)
    name = {"polarized": "mueller", "scalar": "scalar"}[polarized]
    assert np.array_equal(one.dataset[name], both.dataset[name])
    assert np.array_equal(one.dataset[f"{name}_se"], both.dataset[f"{name}_se"])
    assert {"mueller", "scalar", "difference"} & {*one.dataset} == {name}
    with pytest.raises(op.SurfaceError, match="measure with polarized='both' or"):
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


def test_any_number_of_threads_gives_the_same_bits():
    runs = [
        op.measure(GLASS, "60 deg", 70_001, sensor=16, threads=threads).parts
        for threads in (1, 2, 5)
    ]
    for other in runs[1:]:
        assert all(np.array_equal(*each) for each in zip(runs[0], other, strict=True))
    assert runs[0].photons.sum() == 70_001


def test_photons_that_have_met_each_number_of_facets_are_all_that_there_are():
    sample = op.Sample([(0.5 + 2.1j, 0.5)], cells=640, surfaces=1)
    whole = op.measure(sample, "50 deg", 5000, sensor=8).parts
    each = [op.measure(sample, "50 deg", 5000, sensor=8, events=n).parts for n in range(1, 13)]
    assert np.array_equal(sum(part.counts for part in each), whole.counts)
    assert np.allclose(sum(part.sums for part in each), whole.sums, rtol=0, atol=1e-10)
    assert each[0].counts.sum() > each[1].counts.sum() > 0


@pytest.mark.parametrize("azimuth", ["20 deg", "100 deg"])
def test_a_sample_with_a_direction_is_seen_from_its_own_axes(azimuth):
    sample, angle = op.Sample([(1j, (0.02, 0.02 + 1e-9))]), np.radians(float(azimuth.split()[0]))
    found = op.measure(sample, "45 deg", 2000, sensor=16, azimuth=azimuth)
    assert not found.symmetric
    row, column = np.unravel_index(found.dataset["count"].values[0].argmax(), (16, 16))
    there = np.array([found.sensor.coordinates[column], found.sensor.coordinates[row]])
    assert np.abs(there - 0.5 * np.array([np.cos(angle), np.sin(angle)])).max() < 0.125


def test_photons_that_are_no_number_are_told_with_all_else():
    with pytest.raises(op.SurfaceError) as caught:
        op.measure(
            SILVER, "95 deg", 0, "red", "equal", -1, "yes", azimuth="x", events=0, symmetric=2,
            most_events=0, threads=0,
        )  # fmt: skip
    text = "\n".join(caught.value.faults)
    for name in (
        "photons", "events", "threads", "polarized", "projection", "symmetric", "incidence",
        "azimuth", "seed", "most_events", "wavelength",
    ):  # fmt: skip
        assert name in text


def test_what_is_no_sample_is_told():
    with pytest.raises(op.SurfaceError, match=r"give an op\.Sample, such as"):
        op.measure([(1.5, 0.1)], "40 deg", 100)


@pytest.mark.parametrize("azimuth", ["30 deg", "90 deg"])
def test_mirror_images_of_a_sample_that_is_turned_are_refused(azimuth):
    with pytest.raises(op.SurfaceError, match="symmetric is True"):
        op.measure(OBLONG, "40 deg", 100, azimuth=azimuth, symmetric=True)


def test_too_large_a_hemisphere_is_refused_before_photons_are_walked():
    with pytest.raises(op.SurfaceError, match="fewer pixels, wavelengths or parts"):
        op.measure(SILVER, "40 deg", 100, sensor=100_000)
