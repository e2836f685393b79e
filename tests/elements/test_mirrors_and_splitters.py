"""Mirrors and polarising beam splitters."""

import math
import re

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import optipath as op
from chains import by_engine
from optipath.kernels.double_double import DoubleDouble, twice
from optipath.kernels.primitives import NUMPY
from paths import chain
from tables import rows
from wired import read, wired

STATE = [1.0, 0.5, 0.6, 0.4]
ASIDE = op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0))


@rows("index", [0.608 + 2.12j, 1.12 + 2.16j, 0.17 + 3.15j, 1.5 + 0j])
@rows("incidence", [0.0, 0.3, 0.9, 1.4])
def test_a_mirror_of_a_metals_amplitudes_is_the_metal(index, incidence):
    # Born & Wolf, sec. 1.5.2, by complex numbers.
    c, g = np.cos(incidence), np.sqrt(index * index - np.sin(incidence) ** 2)
    r_s, r_p = (c - g) / (c + g), (index * index * c - g) / (index * index * c + g)
    metal = op.Interface(index, incidence).mueller()
    np.testing.assert_allclose(op.Mirror(r_s, r_p).mueller().matrix, metal.matrix, 0, 4e-15)


def test_an_ideal_mirror_turns_handedness_and_diagonals_over():
    for ideal in (op.Mirror().mueller(), op.BeamSplitter(1.0).mueller(leaves="reflected")):
        np.testing.assert_array_equal(ideal.matrix, np.diag([1.0, 1.0, -1.0, -1.0]))
    # A phase of 90 degrees beside the mirror's own makes diagonal light circular.
    light = op.Mirror(-1.0, 1j).mueller() @ op.Light([1.0, 0.0, 1.0, 0.0])
    np.testing.assert_allclose(light.stokes, [1, 0, 0, -1], rtol=1e-15, atol=1e-16)


def test_no_mirror_polarises_by_more_than_all_and_digits_of_differences_are_kept():
    small = 2.0**-40
    matrix = op.Mirror(-0.5 - small, 0.5).mueller().matrix
    assert matrix[0, 1] == 0.5 * small * (1.0 + small)
    rng = np.random.default_rng(1)
    phases = np.exp(1j * rng.uniform(-4, 4, (2, 500)))
    light = chain([op.Mirror(*(rng.uniform(0, 1, (2, 500)) * phases))], [1.0, 0.6, 0.0, 0.8])
    found = light.trace()
    assert np.all(found.dop <= 1.0 + 1e-12)
    assert np.all(found.intensity <= 1.0)


@rows("engine", ["numpy", "numba"])
def test_amplitudes_may_be_parameters_of_complex_numbers_in_single_precision_too(engine):
    given = 0.7 * np.exp(1j * np.linspace(-3, 3, 3000))
    path = chain([op.Mirror(-0.9, op.Parameter("r"))], STATE)
    found = op.Composer(engine=engine).compose(path).run(r=given).stokes
    wanted = chain([op.Mirror(-0.9, given)], STATE).trace().stokes
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-15)
    alone = np.array([path.trace(r=r).stokes for r in given[:3]])
    np.testing.assert_allclose(alone, wanted[:3], rtol=0, atol=1e-15)
    phases = np.exp(1j * np.linspace(0.0, 6.0, 3000)).astype(np.complex64)
    assert np.any(np.abs(phases.astype(complex)) > 1.0 + 1e-9)
    plan = op.Composer(engine=engine).compose(chain([op.Mirror(phases, op.Parameter("r"))]))
    np.testing.assert_allclose(plan.run(r=phases).intensity, 1.0, rtol=1e-6)
    with pytest.raises(op.errors.ParameterError, match="size of 1 or less"):
        plan.run(r=1.00001)


def test_amplitudes_that_give_light_are_refused_but_for_rounding():
    with pytest.raises(
        op.errors.ValueFault, match=r"Mirror r_s is 1\.2; .* a size of 1 or less"
    ) as error:
        op.Mirror(1.2, 0.8 + 0.8j)
    assert len(error.value.faults) == 2
    phases = np.exp(1j * np.linspace(0.0, 6.0, 1000))
    assert np.any(np.abs(phases) > 1.0)
    assert op.Mirror(phases, -phases).mueller().matrix.shape == (1000, 4, 4)
    path = chain([op.Mirror(-1.0, op.Parameter("r"))])
    for r in (1.5, 1j + 0.1, np.full(3000, -1.1), np.full(3000, 0.9 + 0.9j)):
        with pytest.raises(op.errors.ParameterError, match="size of 1 or less"):
            path.trace(r=r)


def test_frames_and_azimuths_turn_the_plane_of_incidence_of_a_mirror():
    assert op.Mirror().mueller(frame_in=op.Frame(), frame_out=ASIDE).frame_out == ASIDE
    with pytest.raises(op.errors.PathError, match="share one x"):
        op.Mirror().mueller(frame_in=op.Frame(), frame_out=op.Frame().turned(0.3))
    turned = chain([op.Mirror(-0.9, 0.5j, azimuth=0.4)], STATE).trace().stokes
    arriving = op.Light(STATE).in_frame(op.Frame().turned(0.4))
    by_hand = op.Mirror(-0.9, 0.5j).mueller() @ op.Light(arriving.stokes)
    np.testing.assert_allclose(turned, by_hand.stokes, rtol=1e-15, atol=1e-16)


def test_amplitudes_are_texts_parameters_or_one_alone_in_code_and_files(tmp_path):
    path = chain([op.Mirror(-0.5 + 0.1j, op.Parameter("r", "0.3+0.4j"))], STATE)
    wanted = path.trace(r=-0.9 + 0.1j).stokes
    np.testing.assert_array_equal(path.trace(r="(-0.9+0.1j)").stokes, wanted)
    text = path.to_toml().replace("{ re = -0.5, im = 0.1 }", '"-0.5+0.1j"')
    assert "0.1j" in text
    assert read(text, tmp_path) == path
    path = chain([op.Mirror(op.Parameter("r"))], STATE)
    wanted = np.array([1.0, 0.5, -0.6, -0.4]) * 0.81
    np.testing.assert_allclose(path.trace(r=-0.9).stokes, wanted, rtol=1e-15)
    assert 'r_p = "-$r"' in path.to_toml()
    text = chain([op.Mirror(-0.9)]).to_toml()
    assert "r_p = 0.9\n" in text
    text = text.replace("r_p = 0.9\n", "")
    assert read(text, tmp_path) == chain([op.Mirror(-0.9, 0.9)])
    with pytest.raises(op.OptipathError) as told:
        read(text.replace("r_s = -0.9", "r_s = 1.2"), tmp_path)
    assert len(told.value.faults) == 1


@rows("amplitude", [0.9, -0.9, 0.3 - 0.4j, "-0.9+0.1j", np.array([0.1, 0.2])])
@rows("given", ["r_s", "r_p"])
def test_where_one_amplitude_is_given_the_other_is_minus_that(given, amplitude):
    matrix = op.Mirror(**{given: amplitude}).mueller().matrix
    share = np.abs(complex(amplitude) if isinstance(amplitude, str) else amplitude) ** 2
    ideal = np.diag([1.0, 1.0, -1.0, -1.0])
    np.testing.assert_allclose(matrix, np.multiply.outer(share, ideal), rtol=1e-15, atol=1e-16)


PORTS = "transmitted", "reflected"
T, R = op.Parameter("t"), op.Parameter("r")

RATIOS = st.one_of(st.floats(1.000001, 1e20), st.floats(1.000001, 1.1), st.just(math.inf))


def cube(t=T, r=R, state=STATE, enters="in", azimuth=0.0):
    """A cube whose two ways out end at detectors."""
    nodes = {"lamp": op.Source(stokes=state), "cube": op.PolarizingBeamSplitter(t, r, azimuth)}
    nodes |= {f"{port} light": op.Detector() for port in ("transmitted", "reflected")}
    ends = "cube.transmitted -> transmitted light, cube.reflected -> reflected light"
    return wired(nodes, f"lamp -> cube.{enters}, {ends}")


def exact(t, r):
    """Ts, Tp, Rs and Rp in 50 digits, of 1/t and 1/r."""
    with mpmath.workdps(50):
        u, v = (0 if math.isinf(e) else 1 / mpmath.mpf(e) for e in (t, r))
        both = 1 - u * v
        return [(u * (1 - v)) / both, (1 - v) / both, (1 - u) / both, v * (1 - u) / both]


def test_an_ideal_splitter_transmits_p_and_reflects_s_with_the_phases_of_a_beam_splitter():
    ideal = op.PolarizingBeamSplitter()
    for port, axis in (("transmitted", "vertical"), ("reflected", "horizontal")):
        polarizer = op.Polarizer(axis).mueller().matrix
        np.testing.assert_array_equal(ideal.mueller("in", port).matrix, polarizer)
    for splitter in (op.BeamSplitter(), op.PolarizingBeamSplitter(3.0, 3.0)):
        assert splitter.mueller("in", "reflected").matrix[3] @ [1.0, 0.0, 0.0, 1.0] < 0


@settings(max_examples=200, deadline=None)
@given(RATIOS, RATIOS)
def test_nothing_is_lost_and_the_ratios_are_those_given(t, r):
    ways = [op.PolarizingBeamSplitter(t, r).mueller("in", port) for port in PORTS]
    through, off = (way.matrix for way in ways)
    np.testing.assert_allclose((through + off)[:2, :2], np.eye(2), rtol=0, atol=3e-16)
    Ts, Tp, Rs, Rp = (float(share) for share in exact(t, r))
    for way, s, p in zip(ways, (Ts, Rs), (Tp, Rp), strict=True):
        assert way.matrix[0, 0] == pytest.approx((s + p) / 2, rel=1e-15)
        assert abs(way.matrix[2, 2]) == pytest.approx(math.sqrt(s * p), rel=2e-15)
        assert way.is_physical()
    assert through[2, 2] >= 0.0 >= off[2, 2]


@by_engine
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
    nodes = {"lamp": op.Source(), "cube": op.PolarizingBeamSplitter(T, math.inf)}
    nodes |= {"mirror": op.Mirror(), "plate": op.Retarder(np.pi / 2, np.pi / 4)}
    links = "lamp -> cube, cube.transmitted -> mirror, mirror -> plate, plate -> cube.back"
    nodes["eye"] = op.Detector()
    path = wired(nodes, f"{links}, cube.reflected -> eye", loops="sum")
    light = path.trace(t=np.array([1.000001, 3.0, 1e6, 1e30]))
    np.testing.assert_allclose(light.intensity, 1.0, rtol=1e-13)


def test_azimuths_and_world_frames_turn_it_as_a_beam_splitter():
    lights = cube(math.inf, math.inf, (1.0, 1.0, 0.0, 0.0), azimuth=np.radians(30)).trace_all()
    assert lights["reflected light"].intensity == pytest.approx(0.75, abs=1e-15)
    assert lights["transmitted light"].intensity == pytest.approx(0.25, abs=1e-15)
    splitter, frame = op.PolarizingBeamSplitter(), op.Frame()
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=STATE), {"out": frame})
    path["lamp"] >> path.add("cube", splitter, {"in": frame, "reflected": ASIDE})
    for port in PORTS:
        path.add(port, op.Detector())
        path.connect(f"cube.{port}", f"{port}.in")
    lights = path.trace_all()
    assert [lights[port].frame for port in PORTS] == [frame, ASIDE]
    skew = op.Frame.from_direction((0, 1, 0), (0, 0, 1))
    with pytest.raises(op.errors.PathError, match="must share one x"):
        splitter.mueller("in", "reflected", frame_in=frame, frame_out=skew)


def test_a_ratio_may_be_written_as_one(tmp_path):
    assert op.PolarizingBeamSplitter("1000:1", "40:2") == op.PolarizingBeamSplitter(1000, 20)
    assert op.PolarizingBeamSplitter("inf").extinction_transmitted == math.inf
    text = cube(1000.0, math.inf).to_toml()
    assert "extinction_reflected = inf" in text
    assert read(text.replace("= 1000.0", '= "1000:1"'), tmp_path) == cube(1000.0, math.inf)


@rows("ratio", [" 1000 : 1 ", ["1000:1"], "1e3"])
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


NO_RATIO = "is no ratio of two positive numbers"


@rows(
    "ratio, sentence",
    [
        (1.0, "is 1; give a real extinction ratio of 1.000001 or more, or infinity"),
        (math.nan, "is nan; give a finite"),
        ("1:0", f"'1:0' {NO_RATIO}; write one such as '1000:1'"),
        ("1000:x", f"'1000:x' {NO_RATIO}"),
        ("30 dB", "'dB'"),
        ("-5:-1", f"'-5:-1' {NO_RATIO}"),
        ("1000:1:1", f"'1000:1:1' {NO_RATIO}"),
    ],
)
def test_what_is_no_ratio_beyond_1_is_told_with_what_to_write(ratio, sentence):
    with pytest.raises(op.OptipathError, match=re.escape(sentence)):
        op.PolarizingBeamSplitter(ratio)
    with pytest.raises(op.OptipathError) as told:
        cube(r=5.0).trace_all(t=ratio)
    if isinstance(ratio, str) or math.isnan(ratio):
        assert sentence in str(told.value)
        with pytest.raises(op.OptipathError, match=re.escape(sentence)):
            op.Parameter("t", ratio)


@rows("ratio", [math.inf, "inf"])
def test_a_parameter_that_is_infinite_is_told_the_number_to_give(ratio):
    with pytest.raises(op.errors.ParameterError, match="give a finite number"):
        cube(r=5.0).trace_all(t=ratio)
    ideal = cube(math.inf, 5.0).trace_all()["transmitted light"]
    given = cube(r=5.0).trace_all(t=1e30)["transmitted light"]
    np.testing.assert_array_equal(given.stokes, ideal.stokes)
