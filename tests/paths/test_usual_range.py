"""The range that a curve or a slider goes over where nobody says."""

import math

import pytest

import optipath as op
from optipath.errors import ParameterError
from optipath.paths.usual_range import usual_range


def of(parameter, element=op.Polarizer, **cases):
    path = op.Source() >> element(parameter) >> op.Detector()
    path.cases = {name: op.Case({parameter.name: value}) for name, value in cases.items()}
    return usual_range(path, parameter.name)


@pytest.mark.parametrize("preset", op.preset_names())
def test_the_range_holds_the_default_and_every_case_and_is_allowed(preset):
    path = op.load_preset(preset)
    inputs = path.compose().inputs
    for name, parameter in inputs.open.items():
        low, high = usual_range(path, name)
        least, most = inputs.limits[name]
        assert math.isfinite(high - low)
        assert least <= low < high <= most
        given = [parameter.default, *(case.values.get(name) for case in path.cases.values())]
        numbers = [parameter.resolve(one) for one in given if one is not None]
        assert all(low <= one.value <= high for one in numbers if one.present.all())


def test_an_axis_goes_over_a_half_turn_and_another_angle_over_a_whole_one():
    assert of(op.Parameter("a", 0.1)) == (0.0, math.pi)
    assert of(op.Parameter("a", 0.1), op.Retarder) == (0.0, 2 * math.pi)


def test_an_axis_below_zero_lies_in_the_range():
    assert of(op.Parameter("a", -0.1)) == (-math.pi / 2, math.pi / 2)
    assert of(op.Parameter("a", 0.1), one="antidiagonal") == (-math.pi / 2, math.pi / 2)
    assert of(op.Parameter("a", 0.1), one=-2.0) == (-math.pi, math.pi)
    assert of(op.Parameter("a", 6.0), one=-4.0) == (-4.0, 2 * math.pi)


def test_a_narrow_range_is_taken_as_it_is():
    assert of(op.Parameter("a", 0.2, minimum=0.1, maximum=0.4)) == (0.1, 0.4)


def test_a_range_far_from_the_usual_one_is_taken_itself():
    def of_index(**limits):
        path = op.PathGraph()
        path.add("lamp", op.Source()) >> path.add(
            "metal", op.Interface(op.Parameter("n", **limits), 0.3)
        )
        path.add("eye", op.Detector())
        path.connect("metal.reflected", "eye")
        return usual_range(path, "n")

    assert of_index(minimum=5.0, maximum=6.0) == (5.0, 6.0)
    assert of_index(minimum=5.0) == (5.0, 10.0)
    with pytest.raises(ParameterError, match="'n' has one value alone"):
        of_index(minimum=1.5, maximum=1.5)


def test_an_index_goes_from_one_to_three_and_a_thickness_to_twice_its_default():
    slab = op.load_preset("glass-slab")
    assert usual_range(slab, "n") == (1.0, 3.0)
    pile = op.load_preset("absorbing-pile")
    assert usual_range(pile, "thickness") == pytest.approx((0.0, 4e-3))


def test_wavelengths_are_the_visible_ones_that_the_curve_has():
    assert usual_range(op.load_preset("copper-gold-spectrum"), "wavelength") == (380e-9, 700e-9)
    infrared = op.load_preset("solc-filter").with_defaults(wavelength="1500 nm")
    assert usual_range(infrared, "wavelength") == pytest.approx((380e-9, 1500e-9))


def test_a_quantity_with_a_sign_goes_as_far_down_as_up():
    assert usual_range(op.load_preset("faraday-isolator"), "field") == (-1.0, 1.0)


def test_what_has_neither_default_nor_end_goes_to_one():
    assert of(op.Parameter("power"), op.Attenuator) == (0.0, 1.0)


def test_an_unknown_name_is_told_with_those_there_are():
    with pytest.raises(ParameterError, match=r"'angel' is unknown; did you mean 'angle'\?"):
        usual_range(op.load_preset("malus"), "angel")


def test_a_bound_parameter_is_told():
    with pytest.raises(ParameterError, match="'angle' is bound to 30 deg"):
        usual_range(op.load_preset("malus", angle="30 deg"), "angle")


def test_a_choice_is_told():
    with pytest.raises(ParameterError, match="'place' is chosen before a path runs"):
        usual_range(op.load_preset("copper-gold-spectrum"), "place")


def test_an_array_and_a_complex_value_have_none():
    path = op.Source(stokes=op.Parameter("stokes", [1, 0, 0, 0])) >> op.Detector()
    with pytest.raises(ParameterError, match="'stokes' is an array"):
        usual_range(path, "stokes")
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add(
        "metal", op.Interface(op.Parameter("index", 0.6 + 2.1j), 0.3)
    )
    path.add("eye", op.Detector())
    path.connect("metal.reflected", "eye")
    with pytest.raises(ParameterError, match="complex value"):
        usual_range(path, "index")
