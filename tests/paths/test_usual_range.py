"""The range that a curve or a slider goes over where nobody says."""

import math

import numpy as np
import pytest

import optipath as op
from optipath.errors import ParameterError
from optipath.paths.usual_range import usual_range
from optipath.values.units import in_unit
from tables import rows


def of(parameter, element=op.Polarizer, **cases):
    path = op.Source() >> element(parameter) >> op.Detector()
    path.cases = {name: op.Case({parameter.name: value}) for name, value in cases.items()}
    return usual_range(path, parameter.name)


def of_index(default=None, **limits):
    n = op.Parameter("a", default, **limits)
    return usual_range(op.Source() >> op.Interface(n, 0.3) >> op.Detector(), "a")


def of_medium(name, **limits):
    given = {"length": 1e-3} | {name: op.Parameter("a", **limits)}
    return usual_range(op.Source() >> op.Medium(**given) >> op.Detector(), "a")


def of_preset(name, parameter, **given):
    return usual_range(op.load_preset(name).with_defaults(**given), parameter)


QUARTER, HALF, WHOLE = math.pi / 2, math.pi, 2 * math.pi
STATE = op.Source(stokes=op.Parameter("a", [1, 0, 0, 0])) >> op.Detector()
BOUND = op.load_preset("malus", angle="30 deg")


@rows("preset", op.preset_names())
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


@rows(
    "find, expected",
    [
        # An axis goes over a half turn, any other angle over a whole one.
        (lambda: of(op.Parameter("a", 0.1)), (0.0, HALF)),
        (lambda: of(op.Parameter("a", 0.1), op.Retarder), (0.0, WHOLE)),
        # What is below zero lies in the range.
        (lambda: of(op.Parameter("a", -0.1)), (-QUARTER, QUARTER)),
        (lambda: of(op.Parameter("a", 0.1), one="antidiagonal"), (-QUARTER, QUARTER)),
        (lambda: of(op.Parameter("a", 0.1), one=-2.0), (-HALF, HALF)),
        (lambda: of(op.Parameter("a", 6.0), one=-4.0), (-4.0, WHOLE)),
        # A narrow range is taken as it is, as one far from the usual one is.
        (lambda: of(op.Parameter("a", 0.2, minimum=0.1, maximum=0.4)), (0.1, 0.4)),
        (lambda: of_index(minimum=5.0, maximum=6.0), (5.0, 6.0)),
        (lambda: of_index(minimum=5.0), (5.0, 10.0)),
        (lambda: of_index(default=4.0, minimum=4.0), (4.0, 8.0)),
        (lambda: of_index(maximum=0.5), (0.0, 0.5)),
        # Of a share the whole is seen; what has neither default nor end goes to one.
        (lambda: of(op.Parameter("a", 0.01), op.Attenuator), (0.0, 1.0)),
        (lambda: of(op.Parameter("a"), op.Attenuator), (0.0, 1.0)),
        (lambda: of_preset("glass-slab", "n"), (1.0, 3.0)),
        # Wavelengths are the visible ones that the curve has; a sign goes as far down as up.
        (lambda: of_preset("copper-gold-spectrum", "wavelength"), (380e-9, 700e-9)),
        (lambda: of_preset("faraday-isolator", "field"), (-1.0, 1.0)),
        # A least value far from the usual ones is followed by one of its size.
        (lambda: of_medium("length", minimum="5 mm", unit="mm"), pytest.approx((5e-3, 10e-3))),
        (lambda: of_medium("absorption", minimum="3 1/m", unit="1/m"), pytest.approx((3.0, 6.0))),
        # Far limits make no range wide where there is a default, here of 0.09 / um.
        (lambda: of_preset("dichroic-sheet", "dichroism"), pytest.approx((-2e5, 2e5))),
        (lambda: of_preset("absorbing-pile", "thickness"), pytest.approx((0.0, 4e-3))),
        (lambda: of_preset("solc-filter", "wavelength", wavelength=1.5e-6), (380e-9, 1.5e-6)),
    ],
)
def test_the_usual_range_is_known_by_kind_default_cases_and_limits(find, expected):
    assert find() == expected
    # A least angle beyond a turn begins the range.
    low, high = of(op.Parameter("a", minimum="400 deg"))
    assert np.degrees(low) == pytest.approx(400.0)
    assert low < high


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")
@rows("unit", ["", "nm", "1/um", "deg"])
@rows("given", [{"default": 1e308}, {"minimum": 1e298}, {"default": 1.7e308}])
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
    assert np.isfinite([in_unit(each, unit) for each in np.linspace(low, high, 5)]).all()
    # One with a sign is no wider than floats.
    low, high = of(op.Parameter("a", 1e308), op.Retarder, one=-1e308)
    assert np.isfinite(high - low)


@rows(
    "find, told",
    [
        (lambda: of_index(minimum=1.5, maximum=1.5), "'a' has one value alone"),
        (lambda: of_index(0.6 + 2.1j), "complex value"),
        (lambda: usual_range(STATE, "a"), "'a' is an array"),
        (lambda: of_preset("malus", "angel"), r"'angel' is unknown; did you mean 'angle'\?"),
        (lambda: usual_range(BOUND, "angle"), "'angle' is bound to 30 deg"),
        (lambda: of_preset("copper-gold-spectrum", "place"), "'place' is chosen before a path"),
    ],
)
def test_what_has_no_range_is_told(find, told):
    with pytest.raises(ParameterError, match=told):
        find()
