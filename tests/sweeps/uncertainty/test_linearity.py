"""Where the first order is doubtful, the answer says so."""

import numpy as np
import pytest

import optipath as op
from tables import rows


def lamp():
    return op.Source(stokes=[1, 1, 0, 0])


def malus():
    return lamp() >> op.Polarizer(op.Parameter("a")) >> op.Detector()


def found_for(path, /, **given):
    return path.propagate(method="differences", **given)


def test_a_smooth_slope_has_nothing_to_tell():
    found = found_for(malus(), a=(0.7, 0.001))
    assert found.notes == ()
    assert not found.is_doubtful("intensity")
    # cos^2 (a + s) - cos^2 a + s sin 2a is -s^2 cos 2a to the second order.
    expected = 0.001 * np.cos(1.4) / np.sin(1.4)
    np.testing.assert_allclose(found.nonlinearity_of("S0")["a"], expected, rtol=0.02)


def test_an_extremum_is_told():
    found = found_for(malus(), a=(0.0, 0.01))
    assert found.uncertainty_of("intensity") == 0.0
    assert found.is_doubtful("intensity")
    assert found.nonlinearity_of("intensity")["a"] == np.inf
    assert not found.is_doubtful("S2")  # sin 2a cos^2 a has a slope
    assert any("along a: S0" in note and "no slope here" in note for note in found.notes)


def test_a_strong_curvature_is_told_with_its_share():
    found = found_for(malus(), a=(0.1, 0.1))
    assert found.is_doubtful("S0")
    assert any("are not as the slope says, by up to" in note for note in found.notes)


def test_values_that_act_together_alone_are_told():
    # Of a product of 0 and 0 both factors have slopes of 0.
    path = op.Source(op.Parameter("i")) >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    found = found_for(path, i=(0.0, 0.1), t=(0.0, 0.1))
    assert found.uncertainty_of("S0") == 0.0
    assert found.is_doubtful("S0")


def test_only_those_paths_of_a_batch_are_doubtful():
    found = found_for(malus(), a=([0.0, 0.7], 0.001))
    np.testing.assert_array_equal(found.is_doubtful("S0"), [True, False])
    assert any("(of 1 in 2 paths)" in note for note in found.notes)


def test_a_value_next_to_an_end_of_its_range_is_told():
    path = op.Source() >> op.Interface(1.5, op.Parameter("t")) >> op.Detector()
    found = found_for(path, t=("0.5 deg", "1 deg"))
    assert any("closer to the ends of its range, 0 deg .. 90 deg" in note for note in found.notes)


def test_total_reflection_within_the_uncertainty_is_told():
    edge = np.arcsin(1 / 1.5)
    path = op.Source() >> op.Interface(1.0, op.Parameter("t"), outside=1.5) >> op.Detector()
    assert found_for(path, t=(edge - 1e-4, 1e-3)).is_doubtful("S0")
    assert found_for(path, t=(edge, 1e-3)).is_doubtful("S0")


def test_unpolarised_light_has_a_corner_of_its_degree_of_polarisation():
    path = lamp() >> op.Depolarizer(op.Parameter("d")) >> op.Detector()
    found = found_for(path, d=(1.0, 0.01))
    assert np.isnan(found.uncertainty_of("dop"))
    assert any(note.startswith("nan: DoP and DoLP: a corner") for note in found.notes)


def test_unpolarised_light_that_stays_so_is_certain_of_it():
    path = op.Source(op.Parameter("i")) >> op.Detector()
    found = found_for(path, i=(1.0, 0.1))
    assert found.uncertainty_of("dop") == 0.0
    assert np.isnan(found.uncertainty_of("aop"))


def test_circular_light_has_a_corner_of_its_ellipticity():
    path = lamp() >> op.Retarder(op.Parameter("r"), np.pi / 4) >> op.Detector()
    found = found_for(path, r=(np.pi / 2, 0.01))
    assert np.isnan(found.uncertainty_of("ellipticity"))


def test_light_too_faint_for_a_float_has_none_and_says_so():
    faint = op.Attenuator(1e-200)
    path = op.Source(op.Parameter("i")) >> faint >> op.Attenuator(1e-200) >> op.Detector()
    found = found_for(path, i=(1.0, 0.1))
    assert np.isnan(found.uncertainties).all()
    assert found.notes == ("nan: the light of 1 in 1 paths is too faint or bright for a float",)


@rows("share", [1e-150, 1e150])
def test_faint_and_bright_light_have_the_uncertainty_of_other_light(share):
    path = op.Source(op.Parameter("i")) >> op.Detector()
    found = found_for(path, i=(share, 0.1 * share))
    np.testing.assert_allclose(found.uncertainty_of("S0"), 0.1 * share, rtol=1e-9)


def test_a_jump_within_three_uncertainties_is_told():
    path = op.Source(stokes=[1, 0, 1, 0]) >> op.Interface(1.5, op.Parameter("t")) >> op.Detector()
    for away in (0.5, 1.05, 1.2, 1.6, 2.0, 2.4, 2.9):
        for sign in (1.0, -1.0):
            t = np.arctan(1.5) + sign * away * 0.003, 0.003
            found = path.propagate(t=t, method="differences")
            # Delta is 0 or 180 deg, and has no slope on either side of Brewster's angle.
            assert found.uncertainty_of("delta") == 0.0
            assert found.is_doubtful("delta"), away
    far = path.propagate(t=(np.arctan(1.5) + 8 * 0.003, 0.003), method="differences")
    assert not any(far.is_doubtful(name) for name in ("delta", "psi", "intensity", "dop"))


def test_a_jump_that_values_reach_together_is_told():
    n, t = op.Parameter("n"), op.Parameter("t")
    path = op.Source(stokes=[1, 0, 1, 0]) >> op.Interface(n, t) >> op.Detector()
    # Brewster's angle is 1.9 of the joint uncertainty away, and 3.6 and 4.2 of each alone.
    given = {"t": (np.arctan(1.5) + 0.0036, 0.001), "n": (1.5, 0.0028)}
    for correlation, doubtful in ((-1.0, True), (1.0, False)):
        found = path.propagate(**given, correlation={("t", "n"): correlation}, method="differences")
        assert found.is_doubtful("delta") == doubtful


def test_what_is_linear_is_not_doubtful_far_away():
    rows = [
        (op.Source(op.Parameter("a")), {"a": (1.0, 0.3)}),
        (op.Source() >> op.Attenuator(op.Parameter("a")), {"a": (0.5, 0.1)}),
        (op.Source(stokes=[1, 1, 0, 0]) >> op.Rotator(op.Parameter("a")), {"a": (0.3, 0.4)}),
    ]
    names = ["intensity", "intensity", "aop"]
    for (path, given), name in zip(rows, names, strict=True):
        found = (path >> op.Detector()).propagate(**given, method="differences")
        assert not found.is_doubtful(name)
        assert found.uncertainty_of(name) == pytest.approx(given["a"][1], rel=1e-9)


def test_values_that_a_path_has_not_far_away_are_left_out():
    path = op.Source() >> op.Interface(1.5, op.Parameter("t")) >> op.Detector()
    found = path.propagate(t=(1.5, 0.03), method="differences")
    assert found.uncertainty_of("intensity") > 0.0
