"""Values given without a name, by a wrong one, as a word or None; the range where nobody says."""

import math

import numpy as np
import pytest

import optipath as op
from optipath.paths.usual_range import usual_range
from optipath.values.units import in_unit
from paths import chain
from tables import rows
from wired import wired

MALUS, PLAN = op.load_preset("malus"), op.load_preset("malus").compose()
ASKED = PLAN.run, PLAN.run_all, PLAN.certificate
D, N_K = op.Parameter("d"), op.Material(1.2, 2.0)
BOTH = "polarizer.angle (a real angle in deg) differs from that at source.intensity (a real number"
K_IS_KNOWN = op.Interface(op.Material(op.Parameter("n", 1.5, minimum=0.0), 0.5), 0.3)


def npgr026(**values):
    return op.load_preset("npgr026", **values)


def fault(action, *given, **values):
    with pytest.raises(op.OptipathError) as error:
        action(*given, **values)
    return str(error.value)


@rows(
    "call, sentence",
    [
        *(
            (lambda act=act: act(0.3), f"{act.__name__}(angle=0.3); there are: angle")
            for act in (*(MALUS.trace, MALUS.trace_all, MALUS.mueller, MALUS.bind), *ASKED)
        ),
        (lambda: MALUS.trace([0.1, 0.2]), "trace(angle=[0.1, 0.2]); there are"),
        (lambda: MALUS.trace({"angle": 0.3}), "trace(**{'angle': 0.3}); there are"),
        (lambda: MALUS.mueller("lamp", "eye", 0.3), "mueller(angle=0.3); there are"),
        (lambda: MALUS.paths({"angle": 0.3}), "paths(**{'angle': 0.3}); there are"),
        (lambda: next(PLAN.stream(9, 0.3)), "stream(angle=0.3); there are"),
        (lambda: MALUS.bind(angle=0.1, intensity=1.0).trace(0.3), "no parameter is open"),
        (lambda: op.load_preset("npgr026", 8), "load_preset('npgr026', case=8)"),
        (lambda: op.load_preset("npgr026", "8"), "load_preset('npgr026', case='8')"),
        # The other part of a complex index is told by its name.
        *((lambda n=n: npgr026().trace(n1=n), "give k by k1") for n in (1.2 + 2j, "1.2+2j", N_K)),
        (lambda: npgr026().bind(n1=1.2 + 2j), "give k by k1"),
        # An option of a composer, and a case, are told where they belong.
        (lambda: npgr026().trace(method="x"), "write Composer(method=...).compose(path)"),
        (lambda: npgr026(engine="x"), "write Composer(engine=...).compose(path)"),
        (lambda: npgr026().trace(case=8), "no parameter of the path; write load_preset(..., case="),
        # None is no value, but a word may leave an element out.
        (lambda: npgr026(filter=None), "filter='none' leaves its element out"),
        (lambda: npgr026(delta=None), "parameter 'delta' is None, which is no value; give one"),
        # What has no usual range.
        (lambda: of_index(minimum=1.5, maximum=1.5), "'a' has one value alone"),
        (lambda: of_index(0.6 + 2.1j), "complex value"),
        (lambda: usual_range(STATE, "a"), "'a' is an array"),
        (lambda: of_preset("malus", "angel"), "'angel' is unknown; did you mean 'angle'?"),
        (lambda: usual_range(BOUND, "angle"), "'angle' is bound to 30 deg"),
        (lambda: of_preset("copper-gold-spectrum", "place"), "'place' is chosen before a path"),
    ],
)
def test_what_is_given_by_a_wrong_name_or_none_is_told_where_it_belongs(call, sentence):
    with pytest.raises(op.errors.ParameterError) as told:
        call()
    assert sentence in str(told.value)
    if sentence.endswith(("k1", "give one")):
        assert str(told.value).endswith(sentence)


def test_detectors_nodes_and_places_are_told_by_their_names():
    ends = {"lamp": op.Source(op.Parameter("power", 2.0)), "plate": op.BeamSplitter()}
    links = "lamp -> plate, plate.reflected -> r, plate.transmitted -> t"
    path = wired({**ends, "r": op.Detector(), "t": op.Detector()}, links)
    for call, other in ((path.trace, "trace_all"), (path.compose().run, "run_all")):
        for values in ({}, {"power": 3.0}):
            with pytest.raises(
                op.errors.ParameterError, match=rf"2 detectors .*; use {other}\(\)$"
            ):
                call(**values)
    assert {*path.trace_all()} == {"r", "t"}
    path = npgr026()
    assert ("X1" in path, "polarizer" in path) == (True, False)
    assert (" ".join(path), len(path), len(op.PathGraph())) == ("L P X2 X1 E", 5, 0)
    path.add("camera", op.Detector())
    path.connect("P", "camera", tap=True)
    told = fault(path.bind, place="eye")
    assert told.startswith(
        "'P' cannot be moved to place='eye': 'P' cannot be taken out, since several"
    )


def test_words_of_axes_are_taken_and_none_for_another_direction_is_offered():
    path = chain([op.Polarizer(op.Parameter("d"))], [1.0, 1.0, 0.0, 0.0])
    assert path.trace(d="horizontal").intensity == 1.0
    # Malus, at 0, 90 and 45 degrees.
    found = path.trace(d=["horizontal", "vertical", "45 deg"]).intensity
    np.testing.assert_allclose(found, [1.0, 0.0, 0.5], atol=1e-15)
    assert path.bind(d="diagonal").trace().intensity == pytest.approx(0.5)
    own = chain([op.Polarizer(op.Parameter("d", words={"vertical": 0.0}))], [1.0, 1.0, 0.0, 0.0])
    assert own.trace(d="vertical").intensity == 1.0
    for words in ("off", ["off", "none"]):
        told = fault(npgr026().trace, filter=words)
        assert told.endswith("none, antidiagonal, or give an angle such as '45 deg'")
    assert fault(op.Polarizer, "pi/4").endswith("antidiagonal, or give an angle such as '45 deg'")
    turned = chain([op.Rotator(op.Parameter("d"))])
    assert "knows no word 'vertical'" in fault(turned.trace, d="vertical")
    told = fault(op.Parameter, "d", "antidiagonl", "deg", words={"diagonal": "45 deg"})
    assert told.endswith("; write '-45 deg' for the axis 'antidiagonal'")
    assert fault(op.Parameter, "d", "half", "deg").endswith("give an angle such as '45 deg'")
    two_faces = wired({"X1": op.Interface(1.5, 0.3), "E": op.Detector()}, "")
    told = fault(two_faces.connect, "X1.refracted", "E")
    assert told.startswith("port 'X1.refracted' does not exist; ")


@rows(
    "call, sentence",
    [
        (lambda: chain([K_IS_KNOWN]).bind(n=1.2 + 2j), "k is 0.5 where the path is built"),
        (lambda: npgr026(case=True), "case 'True' is unknown"),
        ((op.Source(D) >> op.Polarizer(D) >> op.Detector()).check, BOTH),
        # A negative is told as one, in few digits.
        (lambda: chain([op.Interface(1.5, -D)]).trace(d=0.3), ".incidence, as -d) is -17.1887 deg"),
        # Digits that tell a number from its limit are kept.
        (lambda: op.Attenuator(1.0000000000002), "is 1.0000000000002; give"),
        (lambda: op.Attenuator(1.12345678901234), "is 1.12346; give"),
        (lambda: op.Parameter("p", minimum="90 deg", maximum="0 deg"), "range 90 deg .. 0 deg;"),
        (lambda: wired({"eye": op.Detector()}, "").trace(), "add one, such as Source()"),
    ],
)
def test_numbers_and_places_are_told_as_they_stand(call, sentence):
    assert sentence in fault(call)


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


@pytest.mark.filterwarnings("ignore::optipath.errors.AngleWarning")
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
