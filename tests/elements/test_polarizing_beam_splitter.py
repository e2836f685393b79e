import math
import re

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import ENGINES
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.primitives import NUMPY
from optipath.kernels.numbers.twice import twice
from tables import rows

STATE = (1.0, 0.3, 0.5, 0.6)
T, R = op.Parameter("t"), op.Parameter("r")
RATIOS = st.one_of(st.floats(1.000001, 1e20), st.floats(1.000001, 1.1), st.just(math.inf))


def cube(t=T, r=R, state=STATE, enters="in", azimuth=0.0):
    """A cube whose two ways out end at detectors."""
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=state))
    path.add("cube", op.PolarizingBeamSplitter(t, r, azimuth))
    path.connect("lamp.out", f"cube.{enters}")
    for port in ("transmitted", "reflected"):
        path.add(f"{port} light", op.Detector())
        path.connect(f"cube.{port}", f"{port} light.in")
    return path


def exact(t, r):
    """Ts, Tp, Rs and Rp in 50 digits, of 1/t and 1/r."""
    with mpmath.workdps(50):
        u, v = (0 if math.isinf(e) else 1 / mpmath.mpf(e) for e in (t, r))
        both = 1 - u * v
        return [(u * (1 - v)) / both, (1 - v) / both, (1 - u) / both, v * (1 - u) / both]


def test_an_ideal_one_transmits_p_and_reflects_s():
    ideal = op.PolarizingBeamSplitter()
    through, off = (ideal.mueller("in", port).matrix for port in ("transmitted", "reflected"))
    np.testing.assert_array_equal(through, op.Polarizer("vertical").mueller().matrix)
    np.testing.assert_array_equal(off, op.Polarizer("horizontal").mueller().matrix)


@settings(max_examples=200, deadline=None)
@given(RATIOS, RATIOS)
def test_nothing_is_lost_and_the_ratios_are_those_given(t, r):
    element = op.PolarizingBeamSplitter(t, r)
    through, off = (element.mueller("in", port).matrix for port in ("transmitted", "reflected"))
    np.testing.assert_allclose((through + off)[:2, :2], np.eye(2), rtol=0, atol=3e-16)
    Ts, Tp, Rs, Rp = (float(share) for share in exact(t, r))
    for matrix, s, p in ((through, Ts, Tp), (off, Rs, Rp)):
        assert matrix[0, 0] == pytest.approx((s + p) / 2, rel=1e-15)
        assert abs(matrix[2, 2]) == pytest.approx(math.sqrt(s * p), rel=2e-15)
    assert through[2, 2] >= 0.0 >= off[2, 2]
    for matrix in (through, off):
        assert op.Mueller(matrix).is_physical()


@rows("engine", ENGINES)
@rows("enters", ["in", "back"])
def test_engines_agree_with_50_digits_from_either_side(engine, enters):
    rng = np.random.default_rng(5)
    t, r = 1.0 + 10.0 ** rng.uniform(-2, 6, (2, 300))
    plan = op.Composer(engine=engine).compose(cube(enters=enters))
    lights = plan.run_all(t=t, r=r)
    through, off = lights["transmitted light"], lights["reflected light"]
    if enters == "back":
        through, off = off, through
    s0, s1, s2, s3 = STATE
    s, p = (s0 + s1) / 2, (s0 - s1) / 2
    for place in range(0, 300, 10):
        Ts, Tp, Rs, Rp = exact(t[place], r[place])
        for light, x, y, sign in ((through, Ts, Tp, 1), (off, Rs, Rp, -1)):
            across = float(sign * mpmath.sqrt(x * y))
            wanted = [x * s + y * p, x * s - y * p, across * s2, across * s3]
            found = np.asarray(light.stokes)[place]
            np.testing.assert_allclose(found, np.array(wanted, float), rtol=0, atol=1e-15)


@rows("ratio", [math.inf, 1e30, 40.0])
def test_in_twice_the_digits_it_is_the_same(ratio):
    xp = twice(NUMPY)
    for way in op.PolarizingBeamSplitter(ratio, [20.0, math.inf]).couplings():
        (operation,) = way.operations
        found = operation.numbers(xp, lambda value: DoubleDouble(NUMPY, np.asarray(value)))
        plain = operation.numbers(NUMPY, np.asarray)
        for one, other in zip(found[:4], plain[:4], strict=True):
            np.testing.assert_allclose(one.high, other, rtol=4e-16, atol=1e-30)


def test_in_a_loop_that_is_nearly_closed_its_light_adds_up():
    """A quarter-wave plate before a mirror turns p into s, which the cube sends on."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source()) >> path.add("cube", op.PolarizingBeamSplitter(T, math.inf))
    path.connect("cube.transmitted", path.add("mirror", op.Mirror()).name + ".in")
    path["mirror"] >> path.add("plate", op.Retarder(np.pi / 2, np.pi / 4))
    path.connect("plate.out", "cube.back")
    path.connect("cube.reflected", path.add("eye", op.Detector()).name + ".in")
    light = path.trace(t=np.array([1.000001, 3.0, 1e6, 1e30]))
    np.testing.assert_allclose(light.intensity, 1.0, rtol=1e-13)


def test_its_phases_are_those_of_a_beam_splitter():
    state = (1.0, 0.0, 0.0, 1.0)
    half = op.BeamSplitter().mueller("in", "reflected").matrix @ state
    partial = op.PolarizingBeamSplitter(3.0, 3.0).mueller("in", "reflected").matrix @ state
    assert half[3] < 0
    assert partial[3] < 0


def test_an_azimuth_turns_it_against_the_light():
    lights = cube(math.inf, math.inf, (1.0, 1.0, 0.0, 0.0), azimuth=np.radians(30)).trace_all()
    assert lights["reflected light"].intensity == pytest.approx(0.75, abs=1e-15)
    assert lights["transmitted light"].intensity == pytest.approx(0.25, abs=1e-15)


def test_world_frames_are_those_of_a_beam_splitter():
    path = cube(1e3, 50.0)
    frame = op.Frame()
    aside = op.Frame.from_direction((0, 1, 0), (1, 0, 0))
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=STATE), {"out": frame})
    path.add("cube", op.PolarizingBeamSplitter(), {"in": frame, "reflected": aside})
    path["lamp"] >> path["cube"]
    for port in ("transmitted", "reflected"):
        path.add(port, op.Detector())
        path.connect(f"cube.{port}", f"{port}.in")
    lights = path.trace_all()
    assert lights["transmitted"].frame == frame
    assert lights["reflected"].frame == aside
    path = op.PathGraph()
    skew = op.Frame.from_direction((0, 1, 0), (0, 0, 1))
    path.add("lamp", op.Source())
    path.add("cube", op.PolarizingBeamSplitter(), {"in": frame, "reflected": skew})
    path["lamp"] >> path["cube"]
    path.connect("cube.reflected", path.add("eye", op.Detector()).name + ".in")
    with pytest.raises(op.PathError, match="must share one x"):
        path.trace()


def test_a_ratio_may_be_written_as_one(tmp_path):
    assert op.PolarizingBeamSplitter("1000:1", "40:2") == op.PolarizingBeamSplitter(1000, 20)
    text = cube(1000.0, math.inf).to_toml()
    assert "extinction_reflected = inf" in text
    (tmp_path / "x.toml").write_text(text.replace("= 1000.0", '= "1000:1"'), "utf-8")
    assert op.load_preset(tmp_path / "x.toml") == cube(1000.0, math.inf)


@rows(
    "ratio, fault",
    [
        (1.0, "is 1; give a real extinction ratio of 1.000001 or more, or infinity"),
        (0.01, "is 0.01; give a real extinction ratio of 1.000001 or more"),
        (math.nan, "is nan"),
        ("1:0", "'1:0' is no ratio of two positive numbers; write one such as '1000:1'"),
        ("1000:x", "'1000:x' is no ratio of two positive numbers"),
    ],
)
def test_what_is_no_ratio_beyond_1_is_refused(ratio, fault):
    with pytest.raises(op.OptipathError, match=fault):
        op.PolarizingBeamSplitter(ratio)
    if not isinstance(ratio, str):
        with pytest.raises(op.OptipathError):
            cube().trace_all(t=ratio, r=10.0)


@rows("ratio", ["1000:1", " 1000 : 1 ", ["1000:1"], "1e3"])
def test_a_ratio_may_be_written_wherever_it_is_given(ratio):
    wanted = cube(1000.0, 5.0).trace_all()["transmitted light"].S0
    given = [
        cube(r=5.0).trace_all(t=ratio),
        cube(r=5.0).bind(t=ratio).trace_all(),
        cube(op.Parameter("t", ratio), 5.0).trace_all(),
        cube(ratio, 5.0).trace_all(),
    ]
    for lights in given:
        np.testing.assert_array_equal(np.ravel(lights["transmitted light"].S0), [wanted])


def test_a_ratio_without_end_may_be_a_text():
    assert op.PolarizingBeamSplitter("inf").extinction_transmitted == math.inf


@rows(
    "ratio, sentence",
    [
        ("30 dB", "write 1000, which is 10 ** (30 / 10), for a ratio of intensities"),
        ("-5:-1", "'-5:-1' is no ratio of two positive numbers; write one such as '1000:1'"),
        ("1000:1:1", "'1000:1:1' is no ratio of two positive numbers; write one such as"),
        ("1:0", "'1:0' is no ratio of two positive numbers"),
        (math.nan, "is nan; give a finite"),
    ],
)
def test_what_is_no_ratio_is_told_with_what_to_write(ratio, sentence):
    for fault in (
        lambda: op.PolarizingBeamSplitter(ratio),
        lambda: op.Parameter("t", ratio),
        lambda: cube(r=5.0).trace_all(t=ratio),
    ):
        with pytest.raises(op.OptipathError, match=re.escape(sentence)):
            fault()


@rows("ratio", [math.inf, "inf"])
def test_a_parameter_that_is_infinite_is_told_the_number_to_give(ratio):
    with pytest.raises(op.ParameterError, match="1e30 for an extinction ratio without end"):
        cube(r=5.0).trace_all(t=ratio)
    ideal = cube(math.inf, 5.0).trace_all()["transmitted light"]
    given = cube(r=5.0).trace_all(t=1e30)["transmitted light"]
    np.testing.assert_array_equal(given.stokes, ideal.stokes)
