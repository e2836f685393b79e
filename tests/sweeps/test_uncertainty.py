"""What propagate is given, what it answers, and where the first order is doubtful."""

import copy
import pickle
import subprocess
import sys
from itertools import product

import numpy as np
import pytest

import optipath as op
from optipath.errors import MissingExtraError
from optipath.values import arrays as memory
from tables import rows

MALUS, NPGR = op.load_preset("malus"), op.load_preset("npgr026")
LAMP = op.Source(stokes=[1, 1, 0, 0])
ANALYZED = LAMP >> op.Polarizer(op.Parameter("a")) >> op.Detector()
DARKENED = op.Source() >> op.Polarizer(op.Parameter("a")) >> op.Detector()
GLASS = op.Source() >> op.Interface(op.Parameter("m"), 0.3) >> op.Detector()
BARE = op.Source(op.Parameter("i")) >> op.Detector()
DIAGONAL = op.Source(stokes=[1, 0, 1, 0])
METHODS = ("differences", "monte-carlo")


def by_slopes(path, /, **given):
    return path.propagate(method="differences", **given)


def refused(path, /, **given):
    with pytest.raises(op.errors.ParameterError) as fault:
        path.propagate(**{"method": "differences", **given})
    return fault.value.faults


def test_slopes_are_by_jax_where_it_is_there_and_it_says_so(monkeypatch):
    pytest.importorskip("jax")
    assert MALUS.propagate(angle=(0.5, 0.01)).method == "gradients by JAX"
    monkeypatch.setitem(sys.modules, "jax", None)
    assert MALUS.propagate(angle=(0.5, 0.01)).method == "differences"
    with pytest.raises(MissingExtraError, match=r"optipath\[jax\]"):
        MALUS.propagate(angle=(0.5, 0.01), method="gradients")


class Untraced(op.Element, kind="untraced"):
    """A polariser of one's own that looks at its angle, which JAX does not know."""

    angle: op.fields.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        c = float(np.cos(angle)) ** 2
        return (c, 0, 0, 0), (0, c, 0, 0), (0, 0, c, 0), (0, 0, 0, c)


def test_a_path_that_jax_does_not_trace_or_takes_long_for_has_differences_and_it_says_so():
    pytest.importorskip("jax")
    path = op.Source() >> Untraced(op.Parameter("a")) >> op.Detector()
    found = path.propagate(a=(0.5, 0.01))
    assert found.method == "differences, since JAX does not trace this path"
    np.testing.assert_allclose(found.uncertainty_of("S0"), 0.01 * np.sin(1.0), rtol=1e-9)
    (fault,) = refused(path, a=(0.5, 0.01), method="gradients")
    assert "write method='differences'" in fault
    found = op.load_preset("pile-of-plates").propagate(n=(1.5, 0.01))
    assert found.method.startswith("differences, since JAX takes long for 1,0")


def test_what_propagates_and_what_reads_axes_bring_neither_jax_nor_xarray():
    code = """import sys; import optipath as op; from optipath.sweeps.axes import grid_of
path = op.load_preset("malus"); path.propagate(angle=(0.5, 0.01), method="differences")
grid_of(path.compose().inputs, {"angle": [0.1]}); print({"jax", "xarray", "dask"} & {*sys.modules})
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_one_of_several_detectors_is_named_and_a_composer_asked_for_the_light():
    path = op.PathGraph()
    cube = path.add("cube", op.BeamSplitter(op.Parameter("t", 0.3)))
    path.add("lamp", op.Source(op.Parameter("i"))) >> cube
    for name, port in (("ahead", "transmitted"), ("aside", "reflected")):
        path[f"cube.{port}"] >> path.add(name, op.Detector())
    (fault,) = refused(path, i=(2.0, 0.1))
    assert "use propagate(detector='ahead', ...)" in fault
    for name, light in path.trace_all(i=2.0).items():
        found = by_slopes(path, detector=name, i=(2.0, 0.1))
        assert found.light == light
        np.testing.assert_allclose(found.uncertainty_of("S0"), 0.05 * light.intensity)
    for method, options in product(METHODS, ({"dtype": "float32"}, {"composing": "jones"})):
        composer = op.Composer(**options)
        found = MALUS.propagate(angle=(0.5, 0.01), method=method, composer=composer)
        assert found.light == composer.compose(MALUS).run(angle=0.5)
        rough = {"rtol": 1e-9 if method == "differences" else 0.05}
        np.testing.assert_allclose(found.uncertainty_of("S0"), 0.005 * np.sin(1.0), **rough)


def test_a_parameter_called_as_an_option_and_what_cannot_be_asked_are_told(monkeypatch):
    path = op.Source(op.Parameter("seed")) >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    (fault,) = refused(path, t=(0.5, 0.1), seed=3, method="auto")
    assert "path.bind(seed=...)" in fault
    found = by_slopes(path.bind(seed=3.0), t=(0.5, 0.1))
    np.testing.assert_allclose(found.uncertainty_of("S0"), 0.3)
    # As that for complex values does.
    index = op.Material(op.Parameter("n"), op.Parameter("k"))
    path = op.Source() >> op.Interface(index, 0.3) >> op.Detector()
    assert by_slopes(path, n=(1.5, 0.1), k=(0.1, 0.01)).uncertainty_of("S0") > 0.0
    with pytest.raises(op.errors.ParameterError, match="did you mean 'intensity'"):
        by_slopes(MALUS, **HALF).uncertainty_of("intensty")
    with pytest.raises(op.errors.ParameterError, match=r"by name: propagate\(angle=0.3\)"):
        MALUS.propagate(0.3)
    monkeypatch.setattr(memory, "memory", lambda: 2**26)
    with pytest.raises(op.errors.ParameterError, match=r"paths, .* give fewer values at a time"):
        by_slopes(MALUS, angle=(np.linspace(0.1, 1.0, 70_000), 0.1))


def test_the_answer_is_a_table_with_its_notes_below():
    found = by_slopes(MALUS, angle=("30 deg", "0.1 deg"), intensity=(1.0, 0.002))
    lines = str(found).splitlines()
    assert len(lines) == 12
    words = [" ".join(line.split()) for line in lines]
    assert words[1:3] == ["value uncertainty angle intensity", "S0 0.3750 0.0011 50 % 50 %"]
    assert words[8] == "AoP 30.00 deg 0.10 deg 100 % 0 %"
    assert lines[0] == "differences: angle = 30 deg +- 0.1 deg; intensity = 1 +- 0.002"
    lines = str(by_slopes(MALUS, angle=(["30 deg", "45 deg"], "0.1 deg"))).splitlines()
    assert lines[0] == "differences, shape (2,): angle, shape (2,)"
    assert "0.25 .. 0.375" in lines[2]
    found = by_slopes(MALUS, angle=("0 deg", "1 deg"))
    assert str(found).splitlines()[12:] == list(found.notes)


def found_at(angle=0.3, seed=0):
    return DARKENED.propagate(a=(angle, 0.1), method="monte-carlo", samples=100, seed=seed)


def arrays_of(made):
    (value,) = made.uncertain
    own = [made.mean, made.covariance, made.uncertainties, made.shares, made.left]
    return [*own, made.uncertainty, value.value, value.sigma]


def test_an_uncertainty_equals_that_of_the_same_and_its_copies_and_nobody_can_change_it():
    for angle in (0.3, 0.0, [0.1, 0.2]):  # One, with NaN, several.
        made = found_at(angle)
        copies = copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made))
        for again in (found_at(angle), *copies):
            assert again == made
            assert not any(array.flags.writeable for array in arrays_of(again))
    for other in (found_at(seed=1), found_at(0.4), found_at([0.3]), "light"):
        assert found_at() != other
    with pytest.raises(TypeError, match="unhashable"):
        hash(found_at())
    made = found_at(angles := np.array([0.1, 0.2]))
    angles[0] = 9.0
    assert made.uncertain[0].value[0] == 0.1
    with pytest.raises(AttributeError):
        made.mean = 0.0


def test_texts_and_words_have_units_of_their_own_each_and_lists_and_arrays_are_exact():
    for path, one, same in (
        (MALUS, {"angle": ("30 deg", "1 mrad")}, {"angle": (np.radians(30.0), 0.001)}),
        (NPGR, {"filter": ("diagonal", "1 deg")}, {"filter": ("45 deg", "1 deg")}),
    ):
        found, other = (by_slopes(path, **given).uncertainties for given in (one, same))
        np.testing.assert_array_equal(found, other)
    path = op.load_preset("copper-gold-spectrum")
    found = by_slopes(path, wavelength=("516 nm", "1 nm")).uncertainty_of("S0")
    above, below = (path.trace(wavelength=at).intensity for at in (516.001e-9, 515.999e-9))
    np.testing.assert_allclose(found, abs(above - below) / 0.002, rtol=1e-6)
    found = by_slopes(MALUS, angle=["10 deg", "30 deg"], intensity=(2.0, [0.1, 0.2]))
    expected = np.cos(np.radians([10.0, 30.0])) ** 2 / 2.0 * [0.1, 0.2]
    np.testing.assert_allclose(found.uncertainty_of("S0"), expected)
    # Uncertainties may have more axes than values.
    found = by_slopes(MALUS, angle=(0.5, [[0.1], [0.2]]))
    assert found.light.shape == found.uncertainty_of("S0").shape == (2, 1)


def test_every_fault_is_told_at_once():
    given = {"delta": ("48 deg", "0.1 mm"), "n1": (1.5, -0.1), "k1": (0.1, np.nan)}
    given |= {"n2": (1.5, 0.1, 0.2), "phy": (0.1, 0.2), "k2": (-1.0, 0.1), "filter": ("none", 0.1)}
    faults = refused(NPGR, **given)
    assert len(faults) == len(given)
    for words in (
        "uncertainty of parameter 'delta': '0.1 mm' is no angle; use one of deg, rad",
        "uncertainty of parameter 'n1' is -0.1; give a finite number of 0 or more",
        "uncertainty of parameter 'k1' is nan",
        "parameter 'n2' is a tuple of 3; a value and its standard uncertainty are two",
        "parameter 'phy' is unknown; did you mean 'phi'?",
        "parameter 'k2' is -1, outside its range; give 0 or more",
        "parameter 'filter' is 'none', which takes an element out of the path",
    ):
        assert words in "\n".join(faults)
    path = op.Source(op.Parameter("a")) >> op.Attenuator(op.Parameter("b")) >> op.Detector()
    first, second = refused(path, a=(1.0, -1.0))
    assert "of parameter 'a' is -1; give a finite number of 0 or more" in first
    assert second == "parameter 'b' has no value; give one, b=..."


CORNER = [[0.0, 0, 2], [0, 0, 0], [0, 2, 0]]
VERTICES = op.path_from_vertices(op.Parameter("points"), materials=[1.5])
IN_PARTS = "op.Material(op.Parameter('n'), op.Parameter('k')) in the path, and give n and k"
HALF = {"angle": (0.5, 0.01)}
SIGMA = "the standard uncertainty of parameter 'intensity'"
INDICES = {"n1": (1.5, 0.1), "k1": (0.2, 0.1), "n2": (1.5, 0.1)}
CORRELATIONS = [
    ({("n1", "k2"): 0.1}, "not of ('n1', 'k2'); there are: n1, k1, n2"),
    ({("n1", "n1"): 1.0}, "is of pairs of parameters that have an uncertainty"),
    ({"n1": 1.0}, "is of pairs of parameters"),
    ({("n1", "k1"): 1.1}, "give a number within -1 .. 1"),
    ({("n1", "k1"): "much"}, "give a number within -1 .. 1"),
    ({("n1", "k1"): 0.1, ("k1", "n1"): 0.1}, "is given twice"),
    ([0.3], "must be a mapping"),
    # 1, -1 and 1: what goes with n1 and against k1 cannot go with both.
    ({("n1", "k1"): -0.9, ("n1", "n2"): 0.9, ("k1", "n2"): 0.9}, "has the eigenvalue -0.8"),
]


@rows(
    "path, given, told",
    [
        (MALUS, {"angle": 0.3}, "a value and its standard uncertainty, such as angle=(0.8, 0.00"),
        (MALUS, {"angle": ([0.1, 0.2, 0.3], [0.1, 0.2])}, "do not broadcast together"),
        (GLASS, {"m": (1.5 + 0.1j, 0.1)}, IN_PARTS),
        (GLASS, {"m": (op.Material(1.5, 0.1), 0.1)}, IN_PARTS),
        (VERTICES, {"points": (CORNER, 0.1)}, "several numbers, which have no uncertainty here"),
        *((MALUS, {"intensity": (1.0, s)}, SIGMA) for s in (1j, "wide", [0.1, [0.2]], True)),
        (MALUS, HALF | {"method": "gradient"}, "did you mean 'gradients'?"),
        (MALUS, HALF | {"method": np.eye(2)}, "is unknown"),
        (MALUS, HALF | {"samples": 100}, "leave samples out, or write method='monte-carlo'"),
        (
            MALUS,
            HALF | {"method": "monte-carlo", "samples": 1},
            "a whole number of 2 or more, not 1",
        ),
        (MALUS, HALF | {"method": "monte-carlo", "seed": -1}, "seed must be a whole number of 0"),
        (MALUS, HALF | {"composer": "numpy"}, "composer must be an op.Composer(...)"),
        (MALUS, HALF | {"detector": "nose"}, "detector 'nose' does not exist"),
        *((NPGR, INDICES | {"correlation": one}, told) for one, told in CORRELATIONS),
    ],
)
def test_what_has_no_uncertainty_is_no_option_or_no_correlation_is_refused(path, given, told):
    (fault,) = refused(path, **given)
    assert told in fault


@rows("method", METHODS)
def test_a_number_beyond_a_whole_turn_is_warned_of_once_from_the_line_of_the_user(method):
    by_slopes(ANALYZED, a=("720 deg", "1 deg"))  # With a unit there is no warning.
    sigma = "the standard uncertainty of parameter 'a'"
    angles = {("30 deg", 10): sigma, ("30 deg", (0.1, 10.0)): sigma, (45.0, 0.1): "parameter 'a'"}
    for given, about in angles.items():
        with pytest.warns(op.errors.AngleWarning, match=f"^{about}") as told:
            DARKENED.propagate(a=given, method=method)
        assert [warning.filename for warning in told] == [__file__]


def test_every_wrong_option_and_pair_is_told_but_that_of_a_value_that_cannot_be_read():
    for options, words in (
        ({"seed": -1, "correlation": 2}, ["seed", "correlation must be a mapping"]),
        ({"samples": 1, "correlation": {("a", "b"): 2}}, ["samples", "not of ('a', 'b')"]),
        (
            {"correlation": {("a", "b"): 0.1, ("a", "c"): 0.1}},
            ["'b')", "'c')"],
        ),
    ):
        faults = refused(DARKENED, a=(0.1, 0.1), method="monte-carlo", **options)
        assert all(word in told for word, told in zip(words, faults, strict=True))
    given = {"n1": (1.5, -0.1), "k1": (0.2, 0.1), "correlation": {("n1", "k1"): 0.3}}
    (told,) = refused(NPGR, **given, method="auto")
    assert "the standard uncertainty of parameter 'n1' is" in told


def test_what_is_wholly_correlated_may_cancel():
    # Two turns against each other: only their sum is seen.
    turned = LAMP >> op.Rotator(op.Parameter("a")) >> op.Rotator(op.Parameter("b"))
    path, both = turned >> op.Polarizer(0.3) >> op.Detector(), {"a": (0.2, 0.01), "b": (0.4, 0.01)}
    for method in METHODS:
        found = path.propagate(**both, correlation={("a", "b"): -1.0}, method=method)
        assert found.uncertainty_of("S0") < 1e-9
        assert path.propagate(a=(0.2, 0.01), b=0.4, method=method).uncertainty_of("S0") > 1e-3


def test_extrema_and_strong_curvatures_are_told_and_nothing_of_a_smooth_slope():
    found = by_slopes(ANALYZED, a=(0.7, 0.001))
    assert (found.notes, found.is_doubtful("intensity")) == ((), False)
    # cos^2 (a + s) - cos^2 a + s sin 2a is -s^2 cos 2a to the second order.
    expected = 0.001 * np.cos(1.4) / np.sin(1.4)
    np.testing.assert_allclose(found.nonlinearity_of("S0")["a"], expected, rtol=0.02)
    found = by_slopes(ANALYZED, a=(0.0, 0.01))
    assert found.uncertainty_of("intensity") == 0.0
    assert found.is_doubtful("intensity")
    assert found.nonlinearity_of("intensity")["a"] == np.inf
    assert not found.is_doubtful("S2")  # sin 2a cos^2 a has a slope
    assert any("along a: S0" in note and "no slope here" in note for note in found.notes)
    found = by_slopes(ANALYZED, a=(0.1, 0.1))
    assert found.is_doubtful("S0")
    assert any("are not as the slope says, by up to" in note for note in found.notes)
    found = by_slopes(ANALYZED, a=([0.0, 0.7], 0.001))
    np.testing.assert_array_equal(found.is_doubtful("S0"), [True, False])
    assert any("(of 1 in 2 paths)" in note for note in found.notes)
    # Of a product of 0 and 0 both factors have slopes of 0.
    path = op.Source(op.Parameter("i")) >> op.Attenuator(op.Parameter("t")) >> op.Detector()
    found = by_slopes(path, i=(0.0, 0.1), t=(0.0, 0.1))
    assert (found.uncertainty_of("S0"), found.is_doubtful("S0")) == (0.0, True)


def test_ends_of_ranges_are_told_and_corners_and_too_faint_light_have_no_uncertainty():
    path = op.Source() >> op.Interface(1.5, op.Parameter("t")) >> op.Detector()
    notes = by_slopes(path, t=("0.5 deg", "1 deg")).notes
    assert any("closer to the ends of its range, 0 deg .. 90 deg" in note for note in notes)
    # Values that a path has not are left out.
    assert by_slopes(path, t=(1.5, 0.03)).uncertainty_of("intensity") > 0.0
    edge = np.arcsin(1 / 1.5)
    path = op.Source() >> op.Interface(1.0, op.Parameter("t"), outside=1.5) >> op.Detector()
    assert by_slopes(path, t=(edge - 1e-4, 1e-3)).is_doubtful("S0")
    assert by_slopes(path, t=(edge, 1e-3)).is_doubtful("S0")
    unpolarised = LAMP >> op.Depolarizer(op.Parameter("d")) >> op.Detector()
    found = by_slopes(unpolarised, d=(1.0, 0.01))
    assert np.isnan(found.uncertainty_of("dop"))
    assert any(note.startswith("nan: DoP and DoLP: a corner") for note in found.notes)
    found = by_slopes(BARE, i=(1.0, 0.1))
    assert found.uncertainty_of("dop") == 0.0  # It stays unpolarised.
    assert np.isnan(found.uncertainty_of("aop"))
    circular = LAMP >> op.Retarder(op.Parameter("r"), np.pi / 4) >> op.Detector()
    assert np.isnan(by_slopes(circular, r=(np.pi / 2, 0.01)).uncertainty_of("ellipticity"))
    faint = op.Attenuator(1e-200)
    path = op.Source(op.Parameter("i")) >> faint >> op.Attenuator(1e-200) >> op.Detector()
    found = by_slopes(path, i=(1.0, 0.1))  # What no float holds is dark.
    assert not found.uncertainty.any()
    assert np.isnan(found.uncertainty_of("dop"))


def test_a_jump_within_three_uncertainties_is_told_and_what_is_linear_is_never_doubtful():
    path = DIAGONAL >> op.Interface(1.5, op.Parameter("t")) >> op.Detector()
    brewster = np.arctan(1.5)
    for away, sign in product((0.5, 1.05, 1.2, 1.6, 2.0, 2.4, 2.9), (1.0, -1.0)):
        found = by_slopes(path, t=(brewster + sign * away * 0.003, 0.003))
        # Delta is 0 or 180 deg, and has no slope on either side of Brewster's angle.
        assert (found.uncertainty_of("delta"), found.is_doubtful("delta")) == (0.0, True), away
    far = by_slopes(path, t=(brewster + 8 * 0.003, 0.003))
    assert not any(far.is_doubtful(name) for name in ("delta", "psi", "intensity", "dop"))
    # That of n and t is 1.9 of the joint uncertainty away, and 3.6 and 4.2 of each alone.
    path = DIAGONAL >> op.Interface(op.Parameter("n"), op.Parameter("t")) >> op.Detector()
    given = {"t": (brewster + 0.0036, 0.001), "n": (1.5, 0.0028)}
    for correlation, doubtful in ((-1.0, True), (1.0, False)):
        found = by_slopes(path, **given, correlation={("t", "n"): correlation})
        assert found.is_doubtful("delta") == doubtful
    a = op.Parameter("a")
    for path, value, sigma, name in (
        (op.Source(a) >> op.Detector(), 1.0, 0.3, "intensity"),
        (op.Source() >> op.Attenuator(a) >> op.Detector(), 0.5, 0.1, "intensity"),
        (LAMP >> op.Rotator(a) >> op.Detector(), 0.3, 0.4, "aop"),
    ):
        found = by_slopes(path, a=(value, sigma))
        assert not found.is_doubtful(name)
        assert found.uncertainty_of(name) == pytest.approx(sigma, rel=1e-9)
