import numpy as np
import pytest

import optipath as op
from tables import rows


def malus():
    return op.load_preset("malus")


def npgr026():
    return op.load_preset("npgr026")


def glass():
    index = op.Parameter("m")
    return op.Source() >> op.Interface(index, 0.3) >> op.Detector()


def refused(path, /, **given):
    with pytest.raises(op.ParameterError) as fault:
        path.propagate(method="differences", **given)
    return fault.value.faults


def test_texts_have_units_of_their_own_each():
    one = malus().propagate(angle=("30 deg", "1 mrad"), method="differences")
    two = malus().propagate(angle=(np.radians(30.0), 0.001), method="differences")
    np.testing.assert_array_equal(one.uncertainties, two.uncertainties)


def test_a_wavelength_has_an_uncertainty_in_nanometres():
    path = op.load_preset("copper-gold-spectrum")
    found = path.propagate(wavelength=("516 nm", "1 nm"), method="differences")
    slope = (
        path.trace(wavelength=516.001e-9).intensity - path.trace(wavelength=515.999e-9).intensity
    )
    np.testing.assert_allclose(found.uncertainty_of("S0"), abs(slope) / 0.002, rtol=1e-6)


def test_a_word_that_is_an_angle_may_have_an_uncertainty():
    one = npgr026().propagate(filter=("diagonal", "1 deg"), method="differences")
    two = npgr026().propagate(filter=("45 deg", "1 deg"), method="differences")
    np.testing.assert_array_equal(one.uncertainties, two.uncertainties)


def test_lists_and_arrays_are_exact():
    found = malus().propagate(
        angle=["10 deg", "30 deg"], intensity=(2.0, [0.1, 0.2]), method="differences"
    )
    expected = np.cos(np.radians([10.0, 30.0])) ** 2 / 2.0 * [0.1, 0.2]
    np.testing.assert_allclose(found.uncertainty_of("S0"), expected)


def test_uncertainties_may_have_more_axes_than_values():
    found = malus().propagate(angle=(0.5, [[0.1], [0.2]]), method="differences")
    assert found.light.shape == found.uncertainty_of("S0").shape == (2, 1)


def test_every_fault_is_told_at_once():
    faults = refused(
        npgr026(),
        delta=("48 deg", "0.1 mm"),
        n1=(1.5, -0.1),
        k1=(0.1, np.nan),
        n2=(1.5, 0.1, 0.2),
        phy=(0.1, 0.2),
        k2=(-1.0, 0.1),
        filter=("none", 0.1),
    )
    assert len(faults) == 7
    told = "\n".join(faults)
    for words in (
        "uncertainty of parameter 'delta': '0.1 mm' is no angle; use one of deg, rad",
        "uncertainty of parameter 'n1' is -0.1; give a finite number of 0 or more",
        "uncertainty of parameter 'k1' is nan",
        "parameter 'n2' is a tuple of 3; a value and its standard uncertainty are two",
        "parameter 'phy' is unknown; did you mean 'phi'?",
        "parameter 'k2' is -1, outside its range; give 0 or more",
        "parameter 'filter' is 'none', which takes an element out of the path",
    ):
        assert words in told


def test_a_value_that_is_missing_is_told_beside_others():
    path = op.Source(op.Parameter("a")) >> op.Attenuator(op.Parameter("b")) >> op.Detector()
    assert refused(path, a=(1.0, -1.0)) == (
        "the standard uncertainty of parameter 'a' is -1; give a finite number of 0 or more",
        "parameter 'b' has no value; give one, b=...",
    )


def test_nothing_uncertain_is_refused():
    (fault,) = refused(malus(), angle=0.3)
    assert "give a value and its standard uncertainty, such as angle=(0.8, 0.001)" in fault


@rows("value", [1.5 + 0.1j, op.Material(1.5, 0.1)])
def test_complex_values_have_parts_with_an_uncertainty_each(value):
    (fault,) = refused(glass(), m=(value, 0.1))
    assert (
        "op.Material(op.Parameter('n'), op.Parameter('k')) in the path, and give n and k" in fault
    )


def test_the_cure_for_complex_values_works():
    index = op.Material(op.Parameter("n"), op.Parameter("k"))
    path = op.Source() >> op.Interface(index, 0.3) >> op.Detector()
    found = path.propagate(n=(1.5, 0.1), k=(0.1, 0.01), method="differences")
    assert found.uncertainty_of("S0") > 0.0


def test_a_list_that_may_be_one_index_is_asked_about():
    (fault,) = refused(glass(), m=([1.5, 0.2], 0.1))
    assert "may be n and k, or the indices of two paths" in fault


@rows("sigma", [1j, None, "wide", [0.1, [0.2]], True])
def test_what_is_no_uncertainty_is_refused(sigma):
    (fault,) = refused(malus(), intensity=(1.0, sigma))
    assert fault.startswith("the standard uncertainty of parameter 'intensity'")


def test_shapes_that_do_not_broadcast_are_refused():
    (fault,) = refused(malus(), angle=([0.1, 0.2, 0.3], [0.1, 0.2]))
    assert "do not broadcast together" in fault


def test_points_have_no_uncertainty():
    path = op.path_from_vertices(op.Parameter("points"), materials=[1.5])
    points = np.array([[0.0, 0, 2], [0, 0, 0], [0, 2, 0]])
    (fault,) = refused(path, points=(points, 0.1))
    assert "several numbers, which have no uncertainty here; give them exactly" in fault


def test_a_value_by_its_place_is_refused():
    with pytest.raises(op.ParameterError, match=r"by name: propagate\(angle=0.3\)"):
        malus().propagate(0.3)


def test_an_angle_beyond_a_turn_is_warned_of_once_and_with_a_unit_not_at_all():
    path = op.Source(stokes=[1, 1, 0, 0]) >> op.Polarizer(op.Parameter("a")) >> op.Detector()
    path.propagate(a=("720 deg", "1 deg"), method="differences")
    with pytest.warns(op.AngleWarning) as told:
        path.propagate(a=(45.0, 0.1), method="differences")
    assert len(told) == 1


@rows("method", ["differences", "monte-carlo"])
@rows("sigma", [10, [0.1, 10.0]])
def test_an_uncertainty_beyond_a_whole_turn_is_warned_of_once_from_the_line_of_the_user(
    method, sigma
):
    path = op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Detector()
    with pytest.warns(op.AngleWarning) as told:
        path.propagate(a=("30 deg", sigma), method=method)
    (warning,) = told
    assert str(warning.message).startswith("the standard uncertainty of parameter 'a'")
    assert warning.filename == __file__


@rows(
    "options, words",
    [
        ({"seed": -1, "correlation": 2}, ["seed", "correlation must be a mapping"]),
        ({"samples": 1, "correlation": 4}, ["samples", "correlation must be a mapping"]),
        ({"samples": 1, "correlation": {("a", "b"): 2}}, ["samples", "names 'b'"]),
    ],
)
def test_what_is_wrong_with_options_and_with_correlation_is_told_at_once(options, words):
    path = op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Detector()
    with pytest.raises(op.ParameterError) as fault:
        path.propagate(a=(0.1, 0.1), method="monte-carlo", **options)
    assert len(fault.value.faults) == len(words)
    assert all(word in told for word, told in zip(words, fault.value.faults, strict=True))


def test_a_correlation_of_a_value_that_cannot_be_read_is_not_told_of():
    path = op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Polarizer(op.Parameter("b"))
    with pytest.raises(op.ParameterError) as fault:
        (path >> op.Detector()).propagate(
            a=(0.1, -0.1), b=(0.1, 0.1), correlation={("a", "b"): 0.3}
        )
    (told,) = fault.value.faults
    assert "the standard uncertainty of parameter 'a' is" in told
