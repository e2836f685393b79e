"""Wavelengths, and what follows from one: values that stand in a path like parameters."""

import copy
import math
import pickle
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import optipath as op
from dispersive import line, on_line
from fake_curves import Metal, metal
from optipath.materials.illuminants import grid_edges, grid_fault, grid_widths
from optipath.values.wavelength import wavelength_of
from tables import rows, slow

P = op.Parameter
GLASS = op.Material.cauchy([1.5, 0.004], name="glass")


def test_wavelengths_and_their_limits_are_lengths_energies_wave_numbers_and_frequencies():
    given = op.Wavelength().resolve(["516 nm", "2.4 eV", "20000 1/cm", "0.5 um"]).value
    assert given == pytest.approx([516e-9, 516.600827e-9, 500e-9, 500e-9])
    known = op.Wavelength(default="2 eV", minimum="3 eV", maximum="1 eV")
    found = (known.default, known.minimum)
    assert found == pytest.approx((619.92e-9, 413.28e-9), rel=1e-5)
    path = op.Source() >> op.Waveplate(1e-5, 0.009, op.Wavelength("probe")) >> op.Detector()
    assert path.trace(probe="516 nm").stokes[0] == 1.0
    # h c / e = 1.239 841 984... e-6 eV m (CODATA 2018, exact).
    assert wavelength_of("1 eV") == pytest.approx(1.239841984332002e-06, rel=1e-15)
    assert wavelength_of("20000 1/cm") == wavelength_of("20000 cm^-1") == pytest.approx(5e-7)
    assert wavelength_of("299.792458 THz") == pytest.approx(1e-6, rel=1e-15)
    for text in ("0 eV", "-2 eV", "1e999 THz"):
        with pytest.raises(op.errors.UnitError, match="above 0"):
            wavelength_of(text)
    for text in ("516 nm", "gold", "", "2 eV 3"):  # What has another unit is left to others.
        assert wavelength_of(text) is None


@rows(
    "given, said",
    [
        *((516, "write '516 nm'"), (np.nan, "finite"), (-5e-7, "outside its range")),
        *((5e6, "5e\\+06 metres"), (np.float32(48), "48 metres, which is no wavelength")),
        (np.zeros(0, complex), "range of reals"),
    ],
)
def test_what_is_no_wavelength_is_refused(given, said):
    with pytest.raises(op.OptipathError, match=said):
        op.Wavelength().resolve(given)


def test_what_is_beyond_a_range_is_told_and_all_units_are_named():
    wavelength = op.Wavelength(minimum="380 nm", maximum="700 nm")
    with pytest.raises(op.errors.ParameterError, match=r"400 nm', and for micrometres '400 um'$"):
        wavelength.resolve(400)
    with pytest.raises(op.errors.ParameterError, match=r"is 720 nm, outside .*; give 380"):
        wavelength.resolve(720e-9)
    units = "nm, um, mm, cm, dm, m, angstrom, or eV, 1/cm, THz$"
    for text in ("516", "516 deg"):
        for read in (wavelength.resolve, GLASS.at, op.Spectrum.line):
            with pytest.raises(op.OptipathError, match=units):
                read(text)


UNEVEN = np.array([380.0, 395.0, 500.0, 512.5, 700.0]) * 1e-9
NO_GRIDS = [(one, "no row of two or more") for one in (5e-7, [], [5e-7], np.ones((2, 2)))]
NO_GRIDS += [(one, "neither rise") for one in ([5e-7, 5e-7], [5e-7, 6e-7, 5.5e-7])]


def test_a_grid_has_the_numbers_of_its_texts_the_widths_of_trapezoids_and_bins_up_to_halfway():
    found = op.wavelengths("380 nm", "700 nm", "40 nm")
    expected = [op.Wavelength().resolve(f"{place} nm").value for place in range(380, 701, 40)]
    assert found.tolist() == [float(place) for place in expected]
    assert op.wavelengths(4e-7, 5e-7, 5e-8).tolist() == [4e-7, 4.5e-7, 5e-7]
    for given, sentence in (
        (("380 nm", "700 nm", "45 nm"), "7.11111 steps of 45 nm; .*whole number"),
        (("380 nm", "700 nm", "400 nm"), "0.8 steps"),
        *(
            (("700 nm", "380 nm", "40 nm"), "give the lower end first, and a whole"),
            (("380 nm", "700 nm", "0 nm"), "step"),
        ),
        ((380, 700, 40), "below 0.1 m"),
    ):
        with pytest.raises(op.errors.ValueFault, match=sentence):
            op.wavelengths(*given)
    for grid in (UNEVEN, UNEVEN[::-1]):
        density = np.random.default_rng(7).uniform(0.0, 3.0, grid.size)
        steps = np.abs(np.diff(grid * 1e9))
        expected = np.sum(0.5 * (density[1:] + density[:-1]) * steps)
        assert np.dot(density, grid_widths(grid)) == pytest.approx(expected, rel=1e-14)
    edges = [380.0, 387.5, 447.5, 506.25, 606.25, 700.0]
    np.testing.assert_allclose(grid_edges(UNEVEN), edges, rtol=1e-15)
    for grid, said in NO_GRIDS:
        assert said in grid_fault(grid)


def tilted_twice(index):
    tilted = op.Interface(index, op.Parameter("tilt", default="50 deg"), azimuth="20 deg")
    return op.Source(100) >> op.Interface(index, "40 deg") >> tilted >> op.Detector()


def mirror(*, slope=2e6, wavelength=None):
    return tilted_twice(op.Material(*metal(slope, wavelength)))


def by_numbers(wavelength, slope=2e6, **values):
    index = complex(2.0 - slope * wavelength, 1.0 + np.sqrt(wavelength * 1e6))
    return tilted_twice(index).trace(**values).stokes


def test_light_is_that_of_the_numbers_at_each_wavelength_of_several_runs():
    assert np.array_equal(mirror().trace(wavelength=5e-7).stokes, by_numbers(5e-7))
    plan = mirror().compose()
    for wavelength in [5e-7, 6e-7, 5e-7, 7e-7] * 3:
        assert plan.run(wavelength=wavelength).stokes == pytest.approx(by_numbers(wavelength))
    path = mirror(slope=op.Parameter("slope"))
    found = path.trace(slope=np.array([[1e6], [2e6]]), wavelength=np.array([4e-7, 5e-7])).stokes
    assert found.shape == (2, 2, 4)
    assert found[1, 1] == pytest.approx(by_numbers(5e-7))
    assert path.bind(slope=1e6).trace(wavelength=4e-7).stokes == pytest.approx(found[0, 0])
    wavelengths = np.linspace(400e-9, 700e-9, 1001)
    together = Metal().evaluated(wavelengths, 2e6)
    for place in (0, 17, 500, 1000):
        alone = Metal().evaluated(wavelengths[place], 2e6)
        assert [part[place] for part in together] == [part.item() for part in alone]


@pytest.mark.parametrize("engine", ["numpy", slow("numba")])
def test_a_wavelength_is_an_axis_like_any_other(engine):
    pytest.importorskip(engine)
    wavelengths, tilts = np.linspace(400e-9, 700e-9, 4), np.linspace(0.1, 1.0, 3)
    plan = op.Composer(engine=engine).compose(mirror())
    found = plan.run(wavelength=wavelengths[:, None], tilt=tilts).stokes
    one_by_one = [[by_numbers(w, tilt=t) for t in tilts] for w in wavelengths]
    assert found == pytest.approx(np.array(one_by_one), rel=1e-13)


def test_a_wavelength_that_stands_elsewhere_too_is_read_at_every_run():
    plate = op.Waveplate(1e-5, 0.009, op.Wavelength(), angle="45 deg")
    path = op.Source(stokes=(1, 1, 0, 0)) >> plate >> op.Interface(op.Material(*metal()), 1.0)
    plan = (path >> op.Detector()).compose()
    batches = [np.linspace(a, 7e-7, 2000) for a in (4e-7, 5e-7, 4e-7)]
    for _ in range(6):
        first, other, again = (plan.run(wavelength=batch).stokes[0] for batch in batches)
        assert np.array_equal(first, again)
        assert not np.array_equal(first, other)


def test_a_wavelength_that_is_bound_known_or_a_default_gives_numbers_and_without_one_it_is_told():
    bound = mirror().bind(wavelength="500 nm")
    assert bound.trace().stokes == pytest.approx(by_numbers(5e-7))
    with pytest.raises(op.errors.ParameterError, match="bound to 500 nm"):
        bound.trace(wavelength=6e-7)
    found = mirror().bind(tilt=0.3).trace(wavelength=5e-7).stokes
    assert found == pytest.approx(by_numbers(5e-7, tilt=0.3))
    path = mirror(wavelength=op.Wavelength(default="500 nm"))
    assert path.trace().stokes == pytest.approx(by_numbers(5e-7))
    assert path.trace(wavelength="600 nm").stokes == pytest.approx(by_numbers(6e-7))
    n, k = metal(wavelength=5e-7)
    assert (float(n), float(k)) == (1.0, 1.0 + np.sqrt(0.5))
    with pytest.raises(op.errors.ParameterError) as caught:
        mirror().trace(wavelength="900 nm")
    assert len(caught.value.faults) == 1
    for word in ("900 nm", "300 nm .. 800 nm", "a metal", "take another metal"):
        assert word in str(caught.value)
    with pytest.raises(op.errors.ParameterError, match="'wavelength' has no value"):
        mirror().trace()
    assert [*mirror().compose().inputs.open] == ["wavelength", "tilt"]
    with pytest.raises(op.errors.ParameterError):
        mirror().trace(wavelength=5e-7, **{metal()[0].name: 1.0})


def test_equal_curves_copies_and_sums_are_equal_values_and_sums_those_of_the_numbers():
    n, _ = metal(slope=op.Parameter("slope"))
    assert copy.deepcopy(n) == n
    assert pickle.loads(pickle.dumps(n)).name == n.name
    assert metal()[0] == metal()[0]
    probe = op.Wavelength("probe")
    for other in (metal()[1], metal(slope=1e6)[0], metal(wavelength=probe)[0]):
        assert metal()[0] != other
    one, other = line(1.5, 1.4), line(1.3, 1.35)
    grid = np.linspace(4e-7, 7e-7, 7)
    expected = 2 * on_line(1.5, 1.4, grid) - 3 * on_line(1.3, 1.35, grid) + 0.5
    np.testing.assert_allclose((2 * one - 3 * other + 0.5).at(grid), expected, rtol=1e-15)
    np.testing.assert_allclose((one + other).at(grid), (other + one).at(grid), rtol=1e-15)
    assert one - other == one - other
    assert one - other != other - one


@rows(
    "make",
    [
        *(partial(op.Material.cauchy, [1.5]), partial(op.Material.sellmeier, [1.2], [0.01])),
        partial(op.Material.drude_lorentz, 9.0, 0.1),
        partial(op.Material.tauc_lorentz, [(100, 3, 2, 1)]),
    ],
)
def test_nanometres_that_are_taken_for_metres_are_refused(make):
    with pytest.raises(op.errors.ValueFault) as fault:
        make(span=(400, 700), name="x")
    assert str(fault.value) == (
        "the least wavelength of the span of x is 400 metres, which is no wavelength of light; "
        "for nanometres write '400 nm', and for micrometres '400 um'"
    )
    assert "400 nm .. 700 nm" in repr(make(span=(400e-9, 700e-9), name="x"))


def path_of(material):
    return op.Source() >> op.Interface(material, 0.3) >> op.Detector()


def told(path, **given):
    with pytest.raises(op.errors.ParameterError) as fault:
        path.trace(wavelength="500 nm", **given)
    return str(fault.value)


TWO = ["500 nm", "600 nm"]
LATE = op.tabulated(["800 nm", "900 nm"], [1.0, 2.0])
LINE = line(1.0, 2.0)
ROTATION = op.tabulated(TWO, [25, 20], "deg/mm")


def test_tables_have_their_unit_from_texts_or_beside_them():
    for made in (op.tabulated(TWO, ["25 deg/mm", "20 deg/mm"]), ROTATION):
        assert made.at("550 nm") == pytest.approx(math.radians(22.5) * 1e3, rel=1e-15)
    in_degrees = op.tabulated(TWO, ["95 deg", "100 deg"])
    assert in_degrees == op.tabulated(TWO, np.radians([95.0, 100.0]))
    assert in_degrees != op.tabulated(TWO, ["95 deg", "101 deg"])
    for place in (op.Rotator, op.Retarder):
        with pytest.warns(op.errors.AngleWarning, match="angle|retardance is a plain number"):
            place(op.tabulated(TWO, [95, 78]))
        for unit in ("deg", "rad"):
            place(op.tabulated(TWO, [95, 78], unit))


OF_TABLES = [
    ({"values": np.zeros(0)}, "must be a row of real numbers, not"),
    *(({"values": v}, "must be a real number, not") for v in ([1, 10**400], [True, False])),
    ({"values": [1.0, 2.0j]}, "is complex; give a real number"),
    ({"wavelengths": np.array([5e-7, 6e-7], complex)}, "is complex; give a wavelength above 0"),
    ({"values": [[1.0], [1.0, 2.0]]}, "has rows of unequal lengths"),
    ({"values": [1, 10**400], "unit": "deg"}, "must be a real number, not"),
    ({"unit": np.eye(3)}, "unit '.*' is unknown"),
    ({"label": 5}, "the name of a table is 5; give a text"),
    ({"values": [1.0, math.nan]}, "value of the table is nan at 1; give a finite number"),
    ({"values": [1.0, math.nan], "unit": "deg/mm"}, "'nan deg/mm' is not a quantity"),
    *(({"values": [1.0, "x"], "unit": unit}, "'x' is not a quantity") for unit in ("", "deg/mm")),
    ({"values": [1.0]}, "has 2 wavelengths and 1 of value"),
    ({"values": [1.0, 2.0, 3.0]}, "has 2 wavelengths and 3 of value"),
    ({"values": None, "unit": "deg/mm"}, "value of the table must be a real number, not None"),
]
OF_ROTATIONS = [
    ({"strengths": 1.0}, "strengths of the rotation must be a row of one coefficient or more"),
    ({"strengths": [1.0, 2.0]}, "has 2 of strengths and 1 of poles"),
    ({"strengths": [math.inf]}, "is inf; give a finite coefficient"),
    ({"poles": 1.0}, "poles of the rotation must be a row of one coefficient or more"),
    ({"poles": [0.1, 0.2]}, "the rotation has 1 of strengths and 2 of poles"),
    ({"poles": ["x"]}, "'x' is not a quantity"),
    ({"constant": math.inf}, "constant of the rotation is inf"),
    *(({"span": span}, "span of the rotation") for span in ("X1", (1.0,))),
    ({"label": None}, "the name of a rotation is None; give a text"),
]
TABLE = {"wavelengths": TWO, "values": [1.0, 2.0]}
DRUDE = {"strengths": [1.0], "poles": [0.1]}


@rows(
    "kind, call, sentence",
    [
        *((op.OptipathError, partial(op.tabulated, **TABLE | own), s) for own, s in OF_TABLES),
        *((op.OptipathError, partial(op.drude_rotation, **DRUDE | o), s) for o, s in OF_ROTATIONS),
        (
            op.errors.ValueFault,
            lambda: op.Rotator(ROTATION),
            "is in deg/mm, but Rotator angle takes",
        ),
        (
            op.errors.ValueFault,
            lambda: op.Interface((GLASS.n, GLASS.n), 0.3),
            "as n of glass, n of glass",
        ),
        (
            op.errors.ParameterError,
            lambda: LINE - line(1, 2, op.Wavelength("x")),
            "from two wavelengths",
        ),
        (op.errors.ParameterError, lambda: LINE + ROTATION, "add up what is of one kind"),
        (op.errors.ParameterError, lambda: LINE + LATE, "at no common wavelength"),
        (
            op.errors.ParameterError,
            lambda: GLASS.n**2,
            r"n of glass cannot be used so.* 2 \* n of glass",
        ),
    ],
)
def test_what_makes_no_value_by_wavelength_is_named(kind, call, sentence):
    with pytest.raises(kind, match=sentence):
        call()


def test_coefficients_and_wavelengths_that_do_not_broadcast_are_named():
    glass = op.Material.cauchy([P("A"), 0.004])
    given = {"A": [1.5, 1.6, 1.7], "wavelength": [5e-7, 6e-7]}
    for bound in ((), ("A",), ("wavelength",)):
        path = path_of(glass).bind(**{name: given[name] for name in bound})
        with pytest.raises(
            op.errors.ParameterError, match="arrays do not broadcast together"
        ) as caught:
            path.trace(**{name: value for name, value in given.items() if name not in bound})
        assert "A (3,)" in str(caught.value)
        assert "wavelength (2,)" in str(caught.value)
    several = replace(P("A", default=1.5, bound=True), default=np.array([1.5, 1.6, 1.7]))
    with pytest.raises(op.errors.ShapeError, match="arrays do not broadcast together"):
        op.Material.cauchy([several, 0.004]).at([5e-7, 6e-7])
    with pytest.raises(
        op.errors.ParameterError, match="wavelength has 40 axes, and a batch has 30 at m"
    ):
        path_of(GLASS).trace(wavelength=np.full((1,) * 40, 5e-7))


def test_a_verdet_constant_by_drudes_formula_turns_light():
    # The two figures of the data sheet of terbium gallium garnet fix K and the resonance.
    garnet = op.drude_rotation([-41.72], [0.08909], unit="rad/(T m)")
    assert garnet.at(["632.8 nm", "1064 nm"]) == pytest.approx([-134.0, -40.0], rel=1e-3)
    rotator = op.FaradayRotator(verdet=garnet, field="-0.2 T", length="20 mm")
    path = op.Source(stokes=[1, 1, 0, 0]) >> rotator >> op.Detector()
    light = path.trace(wavelength=["632.8 nm", "1064 nm"])
    np.testing.assert_allclose(light.aop, [0.536, 0.16], rtol=1e-3)


KNOWN = [
    lambda when: op.tabulated(["400 nm", "500 nm"], [1.0, 2.0], wavelength=when),
    lambda when: op.drude_rotation([1.0], [0.01], span=("400 nm", "500 nm"), wavelength=when),
    lambda when: op.Crystal.named("calcite", when).birefringence,
]


@rows("made", KNOWN)
def test_a_wavelength_that_is_known_may_be_a_text_and_is_within_the_range(made):
    assert made("450 nm") == made(450e-9) == pytest.approx(made(None).at("450 nm"), rel=1e-13)
    several = np.array([4.2e-7, 4.5e-7])
    np.testing.assert_allclose(made(several), made(None).at(several), rtol=1e-13)
    for when in ("5 um", [4.5e-7, 5e-6], 450, -4.5e-7, 0.0, np.nan, "red"):
        with pytest.raises(op.OptipathError, match="wavelength"):
            made(when)


def test_a_broadening_above_its_limit_is_told_once_with_both_parameters_and_its_path():
    film = op.Material.tauc_lorentz([[90, 3.4, 2.0, 1.2], [100, P("E0"), P("C"), 1.2]])
    assert told(path_of(film), E0=3.0, C=6.5) == (
        "oscillators[1] of a Tauc-Lorentz model has the broadening 6.5 (parameter 'C') and the "
        "energy 3 (parameter 'E0'); the formula holds for a broadening below twice the energy, "
        "which is 6"
    )
    film = op.Material.tauc_lorentz([[100, 3.0, P("C"), 1.2]])
    words = told(path_of(film), C=np.array([1.0, 2.0, 6.5, 7.0]))
    assert "the broadening 6.5 (parameter 'C') and the energy 3;" in words
    assert words.endswith("which is 6 (at 2, of 4 paths)")
    film = op.Material.tauc_lorentz([[100, P("E0"), P("C"), 1.2]])
    for path in (path_of(film), path_of(op.Material(film.n - 0.1 * film.k, 0.0))):
        words = told(path.bind(E0=3.0, C=7.0))
        assert words.startswith("oscillators[0] of a Tauc-Lorentz model has the broadening 7")
        assert "bounds=" not in words


def test_a_formula_below_0_names_its_coefficients_and_a_complex_one_is_refused_before():
    path = path_of(op.Material.cauchy([P("a"), 2 * P("b")]))
    assert told(path, a=-3.0, b=0.005) == (
        "n of a Cauchy formula at 500 nm is -2.96, and interface.index.n takes a real index of "
        "refraction above 0 where k is 0; give other coefficients (a is -3, 2 * b is 0.01), or "
        "another wavelength"
    )
    words = told(path, a=np.array([1.5, -3.0]), b=0.005)
    assert "is -2.96 (at 1, of 2 paths), and" in words
    assert "bounds=" not in words
    words = told(path_of(op.Material.cauchy([1.5], k=P("k"))), k=1j)
    assert words.endswith("; n is that of a Cauchy formula; give k alone, a real number")
    path = path_of(op.Material.cauchy([P("a"), 0.004]))
    wanted = "parameter 'a' (at interface.index.n.coefficients[0]) is complex; give a real"
    for a in (np.array([1.5 + 1j, 1.5]), "1.5+1j"):
        assert told(path, a=a).startswith(wanted)
        with pytest.raises(op.errors.ParameterError, match="is complex; give a real coefficient"):
            path.bind(a=a, wavelength="500 nm")
    with pytest.raises(op.errors.ValueFault) as fault:
        op.Material.drude_lorentz(P("wp", default=1j), P("g", default=-1.0))
    wanted = "'wp' (at plasma of a Drude-Lorentz model) is complex; give a real coefficient of 0 or"
    assert fault.value.faults[0] == f"parameter {wanted} more"
    assert "'g' (at damping of a Drude-Lorentz model) is -1" in fault.value.faults[1]
