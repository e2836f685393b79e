"""Of flat samples all light is known without photons, and it is that of photons."""

import math

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import HeightField

pytest.importorskip("xarray")

SEVERAL_SIGMA = 5.0
GLASS_ON_DIAMOND = op.Sample([(1.5, 0.0), (2.4, 0.0)])
SAMPLES = {
    "glass": op.Sample([(1.5, 0.0)]),
    "glass on diamond": GLASS_ON_DIAMOND,
    "out of glass": op.Sample([(1.2, 0.0)], outside=1.5),
    "varnish on gold": op.Sample([(1.5, 0.0), (1.3, 0.0), (0.2 + 3.4j, 0.0)]),
}


def gathered(found):
    """All light of each side, with errors: Mueller matrices, and what is without polarisation."""
    return [
        found.own.estimate(lambda light, of=of: of(light).sum(axis=(1, 2)))
        for of in (found.matrices, found.intensities)
    ]


@pytest.mark.parametrize("incidence", ["0 deg", "45 deg", "70 deg"])
@pytest.mark.parametrize("name", SAMPLES)
def test_it_is_that_of_photons(name, incidence):
    pytest.importorskip("numba")
    known = op.measure(SAMPLES[name], incidence, sensor=9)
    walked = op.measure(SAMPLES[name], incidence, 30_000, sensor=9, most_events=999)
    assert walked.photons == 30_000
    for (exact, none), (mean, error) in zip(gathered(known), gathered(walked), strict=True):
        assert np.all(none == 0.0)
        assert np.all(np.abs(mean - exact) < SEVERAL_SIGMA * error + 1e-12)
    lit, hit = (found.scalar[0][..., 0] for found in (known, walked))
    # What is rounded may go into the pixel beside, at its border.
    assert np.all(hit[:, :, :][lit > 0.0] > 0.0)


def test_rounds_between_two_faces_add_up_to_a_geometric_series():
    known = op.measure(GLASS_ON_DIAMOND, "65 deg", sensor=16)
    (matrix, _), (scalar, _) = gathered(known)
    cos = [math.sqrt(1.0 - (math.sin(math.radians(65.0)) / n) ** 2) for n in (1.0, 1.5, 2.4)]

    def faces(power):
        """Reflectances of both faces, for n^power in the place of n: s, then p."""
        a, b, c = (n**power * each for n, each in zip((1.0, 1.5, 2.4), cos, strict=True))
        return ((a - b) / (a + b)) ** 2, ((b - c) / (b + c)) ** 2

    def rounds(first, second):
        return first + (1.0 - first) ** 2 * second / (1.0 - first * second)

    s, p = faces(1), faces(-1)
    along_s, along_p = rounds(*s), rounds(*p)
    by_means = rounds(*(0.5 * (one + other) for one, other in zip(s, p, strict=True)))
    assert matrix[0, 0, 0, 0] == pytest.approx(0.5 * (along_s + along_p), rel=1e-13)
    assert matrix[0, 0, 1, 0] == pytest.approx(0.5 * (along_s - along_p), rel=1e-13)
    assert scalar[0, 0] == pytest.approx(by_means, rel=1e-13)
    assert matrix[:, 0, 0, 0].sum() == pytest.approx(1.0, abs=1e-14)
    assert scalar.sum() == pytest.approx(1.0, abs=1e-14)


def test_nothing_is_counted_and_nothing_is_uncertain():
    known = op.measure(GLASS_ON_DIAMOND, "65 deg", sensor=8)
    data = known.dataset
    assert known.photons == data.attrs["photons"] == 0
    assert not data["count"].any()
    assert not any(data[name].any() for name in ("mueller_se", "scalar_se", "difference_se"))
    assert "known without photons" in repr(known)


def test_transmitted_light_goes_by_snells_law_and_reflected_light_as_it_came():
    known = op.measure(op.Sample([(1.5, HeightField.flat())]), "50 deg", sensor=45)
    below = math.degrees(math.asin(math.sin(math.radians(50.0)) / 1.5))
    for place, angle in enumerate((50.0, below)):
        lit = np.argwhere(known.mueller[0][place, :, :, 0, 0, 0] > 0.0)
        assert lit.tolist() == [[22, int((angle / 90.0 + 1.0) * 22.5)]]


def test_beyond_the_critical_angle_nothing_is_let_through():
    known = op.measure(op.Sample([(1.0, 0.0)], outside=1.5), "45 deg", sensor=9)
    (matrix, _), (scalar, _) = gathered(known)
    assert matrix[:, 0, 0, 0] == pytest.approx([1.0, 0.0], abs=1e-15)
    assert scalar[:, 0] == pytest.approx([1.0, 0.0], abs=1e-15)


def test_each_wavelength_has_its_own_light():
    gold = op.load_sample("gold-rough").layers[0].index
    lengths = ["450 nm", "550 nm", "670 nm"]
    known = op.measure(op.Sample([(gold, 0.0)]), "60 deg", wavelengths=lengths, sensor=15)
    for length in lengths:
        index = complex(op.Sample([(gold, 0.0)]).indices(length).base)
        expected = op.Interface(index, "60 deg").mueller("in", "reflected").matrix
        found = known.toward("60 deg", wavelength=length).matrix
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("polarized", ["polarized", "scalar"])
def test_what_is_not_asked_for_is_not_kept(polarized):
    known = op.measure(GLASS_ON_DIAMOND, "65 deg", sensor=8, polarized=polarized)
    assert known.parts.sums.shape[-1] == {"polarized": 16, "scalar": 1}[polarized]
    assert known.parts.sums[..., 0].sum() == pytest.approx(1.0, abs=1e-14)


def test_light_that_is_cut_short_is_walked():
    pytest.importorskip("numba")
    once = op.measure(GLASS_ON_DIAMOND, "65 deg", 20_000, sensor=8, events=1)
    assert once.photons == 20_000
    # What the first face reflects: the mean of r_s^2 and r_p^2 at 65 deg.
    share = op.Interface(1.5, "65 deg").mueller("in", "reflected").matrix[0, 0]
    assert once.scalar[0][0].sum() == pytest.approx(share, abs=0.01)


def test_there_is_nothing_to_keep_in_a_store(tmp_path):
    for extra in ("zarr", "dask", "distributed"):
        pytest.importorskip(extra)
    with pytest.raises(op.OptipathError, match=r"flat: .* leave out store and scheduler"):
        op.measure(GLASS_ON_DIAMOND, 0.5, store=tmp_path / "kept.zarr")


@pytest.mark.parametrize(
    ("incidence", "percent"),
    [("50 deg", 1.785), ("56 deg", 2.498), ("60 deg", 2.9), ("65 deg", 3.167)],
)
def test_the_bound_of_smooth_glass_on_diamond_is_that_of_its_layers(incidence, percent):
    # In closed form: both faces' rounds with polarisation over those by the mean of each face.
    found = op.measure(GLASS_ON_DIAMOND, incidence, sensor=32).adm()
    assert 100.0 * float(found.max()) == pytest.approx(percent, abs=6e-4)
