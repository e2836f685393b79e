"""Which model is enough for a sample."""

import numpy as np
import pytest

import optipath as op
from optipath.surfaces import decide
from optipath.surfaces.model_choice import LargestOf
from optipath.surfaces.smooth import smooth_exit
from rough_samples import fresnel
from tables import rows, slow

pytest.importorskip("numba")
pytest.importorskip("xarray")


GLASS = op.Sample([(1.5, 0.1), (2.4, 0.1)])
FEW = {"photons": 50_000, "sensor": 16}


def test_the_largest_is_known_to_three_standard_errors_and_what_is_not_known_leaves_it_open():
    found = LargestOf.of([-0.2], [0.02])
    np.testing.assert_allclose([found.value, found.least, found.most], [0.2, 0.14, 0.26])
    # One of many that chance has made large is not above.
    noise = np.random.default_rng(0).normal(0.0, 0.01, (200, 2000))
    assert all(LargestOf.of(each, np.full(2000, 0.01)).least == 0.0 for each in noise)
    assert LargestOf.of([*noise[0], 0.06], np.full(2001, 0.01)).within(0.0) is False
    found = LargestOf.of([np.nan, 0.3, 0.1], [0.0, 0.01, 0.01])
    assert (found.value, found.error, found.most) == (0.3, 0.01, np.inf)
    assert found.within(0.26) is False
    # So does what is noisier.
    found = LargestOf.of([0.1, 0.2], [0.1, 0.001])
    assert (found.value, found.within(0.3), found.within(0.19)) == (0.2, None, False)
    found, none = LargestOf.of([0.01, 0.02], [np.nan, 0.001]), LargestOf.of([], [])
    assert (found.within(1e6), str(found)) == (None, "1.7 % or more")
    assert none.within(1.0) is none.within(0.0) is None


def test_smooth_exit_is_the_product_of_three_boundaries_in_one_plane_and_0_of_one():
    for incidence in (50.0, 65.0):
        there, back = np.radians([incidence, 80.0])
        inside = np.arcsin(np.sin([there, back]) / 1.5)
        ways = [1.0 - fresnel(1.0, 1.5, there), fresnel(1.5, 2.4, inside.mean())]
        ways.append(1.0 - fresnel(1.5, 1.0, inside[1]))
        exact = np.prod(ways, axis=0).mean() / np.prod([way.mean() for way in ways])
        assert smooth_exit(GLASS, there, back) == pytest.approx(exact - 1.0, rel=1e-12)
    assert smooth_exit(GLASS, 1.0, 1.4, depth=0) == 0.0
    sample = op.Sample([(1.3, 0.1), (1.5, 0.1), (1.8, 0.1)])
    assert -0.2 < smooth_exit(sample, np.radians(60), np.radians(80), depth=2) < -0.1


def test_a_flat_stack_is_decided_without_photons():
    sample = op.Sample([(1.5, 0.0), (2.4, 0.0)])
    needed, enough = [decide(sample, "65 deg", each, photons=1) for each in (0.03, 0.04)]
    assert (needed.model, enough.model) == ("polarized", "scalar")
    assert needed.smooth == pytest.approx(-0.03167, abs=5e-6)
    assert needed.difference is None


@pytest.mark.parametrize(
    "sample",
    [op.Sample(GLASS.layers, cells=240, surfaces=4), slow(op.load_sample("glass-on-glass"))],
)
def test_a_layered_sample_needs_polarisation_but_for_a_wide_tolerance(sample):
    found = decide(sample, "60 deg", **FEW)
    assert (found.model, found.undecided, found.multiple) == ("polarized", (), None)
    assert found.explain().startswith("the polarised model is needed for a tolerance of 2 %\n")
    assert any("-18.0 %" in line for line in found.evidence)
    found = decide(sample, "60 deg", 0.5, **FEW)
    assert (found.model, found.undecided) == ("scalar", ())


@pytest.mark.slow
def test_a_metal_is_told_by_single_scattering_where_it_is_hardly_rough():
    found = decide(op.Sample([(0.2 + 3j, 0.1)]), "30 deg", 0.15, photons=30_000, sensor=8)
    assert (found.model, found.undecided) == ("single-scattering", ())
    assert found.beside_model[0] + 3.0 * found.beside_model[1] < 0.15
    found = decide(op.Sample([(1j, 0.6)]), "75 deg", 0.05, photons=20_000, sensor=8)
    assert (found.model, found.undecided) == ("scalar", ())


def test_single_scattering_is_held_against_all_light_of_each_pixel():
    sample, few = op.Sample([(0.14 + 3.7j, 0.1)]), {"photons": 20_000, "sensor": 12}
    found = decide(sample, "75 deg", 0.05, **few)
    assert (found.model, found.undecided) == ("scalar", ("single-scattering",))
    seen = op.measure(sample, "75 deg", **few)
    light, error = (each[0, ..., 0, 0, 0] for each in seen.mueller)
    bright = light > 0.2 * light.sum() / np.isfinite(seen.sensor.theta).sum()
    light, error = light[bright], error[bright]
    model = seen.single_scattering().values[0, ..., 0, 0, 0][bright] / light
    at = np.argmax(np.abs(model - 1.0))
    expected = abs(model[at] - 1.0), model[at] * error[at] / light[at]
    assert found.beside_model == pytest.approx(expected, rel=0.1)


@rows(
    "index, options, sentence",
    [
        (
            1.0,
            {"photons": 2000},
            "^no pixel counts: of 2,000 photons the brightest pixel of reflected light has 0 times",
        ),
        (
            1j,
            {"photons": 2000, "sensor": 16, "brighter_than": 100},
            "and brighter_than is 100; walk",
        ),
        *((1.5, {"tolerance": each}, "give one within 0 .. 1") for each in (0, 1)),
        (1.5, {"progress": 3}, "progress is 3; give a function of two numbers"),
        (1j, {"side": "transmitted"}, "give side='reflected'"),
    ],
)
def test_what_cannot_be_decided_is_told_and_all_of_it_at_once(index, options, sentence):
    with pytest.raises(op.errors.SurfaceError, match=sentence):
        decide(op.Sample([(index, 0.3)]), "30 deg", **options)
    with pytest.raises(op.errors.SurfaceError) as caught:
        decide(op.Sample([(1.5, 0.1)]), 2.0, 1.0, photons=0, side="up", seed=-1)
    told = "\n".join(caught.value.faults)
    for each in ("photons", "tolerance is 1.0", "'up'", "incidence", "seed"):
        assert each in told, each


def test_what_cannot_be_told_takes_the_next_better_model():
    found = decide(op.Sample([(1.5, 0.25)]), "60 deg", 0.02, photons=20_000, sensor=16)
    assert found.model == "polarized"
    assert "scalar" in found.undecided
    assert found.explain().splitlines()[0].endswith("the noise does not tell")
    found = decide(op.Sample([(1.5, 0.1)]), 0.5, side="transmitted", **FEW)
    assert found.model == "scalar"
    assert "single scattering: it tells reflected light" in found.evidence
