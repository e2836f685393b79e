"""The range that a curve or a slider goes over where nobody says."""

import math

import numpy as np
import pytest

import optipath as op
from optipath.errors import ParameterError
from optipath.paths.usual_range import usual_range
from optipath.values.units import in_unit


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
    assert of_index(default=4.0, minimum=4.0) == (4.0, 8.0)
    assert of_index(maximum=0.5) == (0.0, 0.5)
    with pytest.raises(ParameterError, match="'n' has one value alone"):
        of_index(minimum=1.5, maximum=1.5)


def test_a_least_value_far_from_the_usual_ones_is_followed_by_one_of_its_size():
    def of_medium(name, **limits):
        given = {"length": 1e-3} | {name: op.Parameter("p", **limits)}
        return usual_range(op.Source() >> op.Medium(**given) >> op.Detector(), "p")

    assert of_medium("length", minimum="5 mm", unit="mm") == pytest.approx((5e-3, 10e-3))
    assert of_medium("absorption", minimum="3 1/m", unit="1/m") == pytest.approx((3.0, 6.0))
    low, high = of(op.Parameter("a", minimum="400 deg"))
    assert np.degrees(low) == pytest.approx(400.0)
    assert low < high


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
@pytest.mark.parametrize("unit", ["", "nm", "1/um", "deg"])
@pytest.mark.parametrize("given", [{"default": 1e308}, {"minimum": 1e298}, {"default": 1.7e308}])
def test_of_huge_values_the_range_has_ends_in_its_unit_as_well(unit, given):
    parameter = op.Parameter("p", unit=unit, **given)
    path = {
        "": lambda: op.Source(parameter),
        "nm": lambda: op.Source() >> op.Medium(parameter),
        "1/um": lambda: op.Source() >> op.Medium(1e-3, absorption=parameter),
        "deg": lambda: op.Source() >> op.Retarder(parameter),
    }[unit]() >> op.Detector()
    low, high = usual_range(path, "p")
    assert low < high
    points = np.linspace(low, high, 5)
    assert np.isfinite([in_unit(each, unit) for each in points]).all()


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
def test_a_signed_range_is_no_wider_than_floats():
    low, high = of(op.Parameter("a", 1e308), op.Retarder, one=-1e308)
    assert np.isfinite(high - low)


def test_far_limits_do_not_make_a_range_wide_where_there_is_a_default():
    low, high = usual_range(op.load_preset("dichroic-sheet"), "dichroism")
    assert (low, high) == pytest.approx((-2e5, 2e5))  # Its default is 0.09 / um.


def test_of_a_share_the_whole_is_seen_however_small_its_default():
    assert of(op.Parameter("share", 0.01), op.Attenuator) == (0.0, 1.0)


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
