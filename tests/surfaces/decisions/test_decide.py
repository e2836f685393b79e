import numpy as np
import pytest

import optipath as op
from optipath.surfaces import decide

pytest.importorskip("numba")
pytest.importorskip("xarray")

FEW = {"photons": 50_000, "sensor": 16}


def test_a_flat_stack_is_decided_without_photons():
    sample = op.Sample([(1.5, 0.0), (2.4, 0.0)])
    needed, enough = [decide(sample, "65 deg", each, photons=1) for each in (0.03, 0.04)]
    assert (needed.model, enough.model) == ("polarized", "scalar")
    assert needed.smooth == pytest.approx(-0.03167, abs=5e-6)
    assert needed.difference is None


def test_a_layered_sample_needs_polarisation():
    found = decide(op.load_sample("glass-on-glass"), "60 deg", **FEW)
    assert (found.model, found.undecided, found.multiple) == ("polarized", (), None)
    assert found.explain().startswith("the polarised model is needed for a tolerance of 2 %\n")
    assert any("-18.0 %" in line for line in found.evidence)


def test_a_wide_tolerance_lets_polarisation_be_left_out():
    found = decide(op.load_sample("glass-on-glass"), "60 deg", 0.5, **FEW)
    assert (found.model, found.undecided) == ("scalar", ())


def test_a_metal_that_is_hardly_rough_is_told_by_single_scattering():
    found = decide(op.Sample([(0.2 + 3j, 0.1)]), "30 deg", 0.15, photons=50_000, sensor=8)
    assert (found.model, found.undecided) == ("single-scattering", ())
    assert found.beside_model[0] + 3.0 * found.beside_model[1] < 0.15


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


def test_a_model_that_is_off_by_more_than_the_noise_is_not_enough():
    found = decide(op.Sample([(1j, 0.6)]), "75 deg", 0.05, photons=20_000, sensor=8)
    assert (found.model, found.undecided) == ("scalar", ())


@pytest.mark.parametrize(
    ("index", "options", "sentence"),
    [
        (
            1.0,
            {"photons": 2000},
            "of 2,000 photons none is reflected; walk more photons, or look at the other",
        ),
        (
            1j,
            {"photons": 2000, "sensor": 16, "brighter_than": 100},
            "none has 100 times the mean light",
        ),
    ],
)
def test_that_no_pixel_counts_is_told(index, options, sentence):
    with pytest.raises(op.SurfaceError, match=f"^no pixel counts: .*{sentence}"):
        decide(op.Sample([(index, 0.3)]), "30 deg", **options)


@pytest.mark.parametrize("limit", [0, 1])
def test_the_limits_of_a_tolerance_are_left_out(limit):
    with pytest.raises(op.SurfaceError, match="give one above 0 and below 1, such as"):
        decide(op.Sample([(1.5, 0.1)]), "30 deg", limit)


def test_progress_is_a_function():
    with pytest.raises(op.SurfaceError, match="progress is 3; give a function of two numbers"):
        decide(op.Sample([(1.5, 0.1)]), "30 deg", progress=3)


def test_what_the_noise_does_not_tell_takes_the_next_better_model():
    found = decide(op.Sample([(1.5, 0.25)]), "60 deg", 0.02, photons=20_000, sensor=16)
    assert found.model == "polarized"
    assert "scalar" in found.undecided
    assert found.explain().splitlines()[0].endswith("the noise does not tell")


def test_transmitted_light_is_beyond_the_model_of_single_scattering():
    found = decide(op.Sample([(1.5, 0.1)]), 0.5, side="transmitted", **FEW)
    assert found.model == "scalar"
    assert "single scattering: it tells reflected light" in found.evidence


def test_all_that_is_wrong_is_told_at_once():
    with pytest.raises(op.SurfaceError) as caught:
        decide(op.Sample([(1.5, 0.1)]), 2.0, 1.0, photons=0, side="up", seed=-1)
    told = "\n".join(caught.value.faults)
    assert all(
        each in told for each in ("photons", "tolerance is 1.0", "'up'", "incidence", "seed")
    )


def test_nothing_goes_through_an_opaque_sample():
    with pytest.raises(op.SurfaceError, match="give side='reflected'"):
        decide(op.Sample([(1j, 0.1)]), 0.5, side="transmitted")
