"""What every element has: values, matrices, frames, and the way back."""

import subprocess
import sys

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.paths.drawing import draw
from paths import chain
from tables import rows
from wired import read_back, wired

STATE = [1.0, 0.6, 0.3, 0.2]


class HalfWavePlate(op.Element, kind="test-half-wave-plate"):
    angle: op.fields.Angle = 0.0
    azimuth: op.fields.Angle = 0.0

    @staticmethod
    def mueller_rows(xp, angle):
        c, s = xp.cos(4 * angle), xp.sin(4 * angle)
        return (1, 0, 0, 0), (0, c, s, 0), (0, s, -c, 0), (0, 0, 0, -1)


class Coating(op.Element, kind="test-coating"):
    """Takes an index, and reflects as the library's kernel does, dimmed."""

    index: op.fields.Index
    dimming: op.fields.Fraction = 0.5

    def couplings(self):
        through = op.Interface(self.index, 0.3).couplings()[0].operations
        dimmed = op.Attenuator(self.dimming).couplings()[0].operations
        return (op.Coupling("in", "out", through + dimmed),)


def test_an_element_of_ones_own_is_one_of_the_library_in_light_files_and_kinds(tmp_path):
    given = {"a": np.linspace(0, 1, 7), "z": 0.4}
    A, Z = op.Parameter("a"), op.Parameter("z")
    own, library = (
        chain([plate], STATE).trace(**given).stokes
        for plate in (HalfWavePlate(A, azimuth=Z), op.Retarder(np.pi, A, Z))
    )
    np.testing.assert_allclose(own, library, rtol=0, atol=1e-15)
    path = chain([HalfWavePlate(0.25)])
    assert read_back(path, tmp_path) == path
    with pytest.raises(op.errors.PathError, match="'polarizer' is taken"):

        class Other(op.Element, kind="polarizer"):
            pass

    dim, bright = (chain([Coating(1.5, share)]).trace().stokes for share in ("0.25", 1.0))
    np.testing.assert_allclose(dim, 0.25 * bright)


class Nothing(op.Element):
    pass


class Short(op.Element):
    @staticmethod
    def mueller_rows(_):
        return ((1, 0, 0, 0),)


SIDE = {
    "frame_in": op.Frame(),
    "frame_out": op.Frame.from_direction(z=(0, 1, 0), x=(1, 0, 0)),
}
CROSSED = op.Polarizer(0.0, azimuth=np.pi / 2)


@rows(
    "act, sentence",
    [
        (lambda: HalfWavePlate(np.nan), "^HalfWavePlate angle is nan"),
        (lambda: Nothing().mueller(), "mueller_rows"),
        (lambda: Short().mueller(), "four rows"),
        (lambda: op.Polarizer(op.Parameter("a")).mueller(), "parameter 'a' of polarizer"),
        (lambda: op.Polarizer().mueller(**SIDE), "one frame"),
        (lambda: op.Interface(1.5, 0.1).mueller(**SIDE), "incidence of 45 deg"),
        (lambda: op.Interface(1.5, 0.1).mueller("back", "back"), "are: in -> reflected, in -> tr"),
        (lambda: CROSSED.mueller(frame_in=op.Frame()), "world frames and by an azimuth; give one"),
        (lambda: CROSSED.mueller(frame_out=op.Frame()), "world frames and by an azimuth; give one"),
    ],
)
def test_what_an_element_cannot_do_is_refused(act, sentence):
    with pytest.raises((op.errors.ValueFault, op.errors.PathError), match=sentence):
        act()


def test_elements_are_equal_by_their_values_which_do_not_change():
    angles = np.zeros(3)
    polarizer = op.Polarizer(angles)
    angles[:] = 1.0
    assert np.array_equal(polarizer.angle, np.zeros(3))
    with pytest.raises(ValueError, match="read-only"):
        polarizer.angle[0] = 1.0
    assert op.Polarizer([0.0, 1.0]) == op.Polarizer(np.array([0.0, 1.0]))
    assert op.Polarizer(0.1) not in (op.Polarizer(0.2), op.Rotator(0.1))
    bound = op.Polarizer(op.Parameter("a", 0.3, bound=True)).mueller()
    assert bound == op.Polarizer(0.3).mueller()


def test_matrices_and_states_may_be_batches():
    batch = np.random.default_rng(1).normal(size=(5, 4, 4))
    path = chain([op.MuellerElement(op.Parameter("M"), physical=False)], STATE)
    np.testing.assert_allclose(path.trace(M=batch).stokes, batch @ STATE, rtol=0, atol=1e-15)
    states = np.array([[1.0, 1.0, 0, 0], [2.0, 0, 0, 1.0], [0, 0, 0, 0]])
    lights = chain([op.Attenuator(0.5)], op.Parameter("state")).trace(state=states)
    np.testing.assert_allclose(lights.stokes, 0.5 * states)


class Passage(op.Element, kind="test-passage"):
    """Two ways through, side by side: light may pass it twice without a loop."""

    inputs = ("a", "b")
    outputs = ("c", "d")
    natural = ""

    def couplings(self):
        return (op.Coupling("a", "c", ()), op.Coupling("b", "d", ()))


def test_light_may_pass_an_element_twice_by_different_ways():
    grey, ends = op.Attenuator(0.5), {"lamp": op.Source(), "eye": op.Detector()}
    links = "lamp.out -> two.a, two.c -> grey.in, grey.out -> two.b, two.d -> eye.in"
    path = wired({**ends, "two": Passage(), "grey": grey}, links)
    assert path.trace().intensity == 0.5
    assert draw(path).splitlines()[0].startswith("lamp")


def test_an_azimuth_turns_an_element_alone_as_in_a_path():
    light, crossed, other = op.Light([1.0, 1.0, 0.0, 0.0]), CROSSED.mueller(), op.Polarizer(0.0)
    path = chain([CROSSED], light.stokes)
    for dark in (
        crossed @ light,
        CROSSED @ light,
        crossed @ other.mueller() @ light,
        crossed @ other @ light,
        CROSSED @ other.mueller() @ light,
        other.mueller() @ crossed @ light,
        path.trace(),
        path.mueller() @ light,
    ):
        assert abs(dark.S0) < 1e-15


def test_an_azimuth_turns_the_frames_of_the_matrix():
    turned = op.Frame().turned(0.3)
    straight, aside = op.Retarder(0.4, azimuth=0.3), op.Interface(1.5, 0.8, azimuth=0.3)
    splitter = op.BeamSplitter(0.5, azimuth=0.3)
    assert (straight.mueller().frame_in, straight.mueller().frame_out) == (turned, turned)
    assert (aside.mueller().frame_in, aside.mueller().frame_out) == (turned, op.Frame())
    assert aside.mueller("back", "reflected").frame_in == op.Frame()
    assert splitter.mueller("in", "transmitted").frame_out == turned
    frame = op.Frame().turned(0.5)
    light = op.Attenuator(1.0).mueller(frame_in=frame) @ op.Light([1.0, 1.0, 0, 0])
    assert light.frame == frame
    np.testing.assert_allclose(light.in_frame(op.Frame()).stokes, [1, 1, 0, 0], rtol=0, atol=1e-15)


def test_elements_are_chained_whatever_else_of_the_library_is_imported():
    for home in ("optipath", "optipath.elements.ends"):
        code = f"from {home} import Detector as D, Source as S; print((S(2.0) >> D()).trace().S0)"
        done = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=True
        )
        assert done.stdout.strip() == "2.0"


A, B, C = (op.Parameter(name) for name in "abc")


def test_slopes_of_elements_are_those_of_closed_forms(jacobian):
    path = chain([op.FaradayRotator(verdet=A, field=B, length=C)], (1.0, 1.0, 0.0, 0.0))
    slopes = jacobian(lambda v: path.trace(a=v[0], b=v[1], c=v[2]).S2)
    slope = slopes(np.array([-134.0, 0.1, 0.02]))
    expected = 2 * np.cos(2 * -134.0 * 0.1 * 0.02) * np.array([0.002, -134.0 * 0.02, -13.4])
    np.testing.assert_allclose(slope, expected, rtol=1e-14)
    path = chain([op.CircularPolarizer("right", A, B)], (1.0, 0.3, 0.0, 0.5))
    slopes = jacobian(lambda v: path.trace(a=v[0], b=v[1]).stokes)
    slope = slopes(np.array([1.0, 0.0]))
    np.testing.assert_allclose(slope[0], [0.75, 0.25], rtol=0, atol=1e-15)
    assert np.isfinite(slope).all()
    # With an ideal reflection Ts is 1 / t, and Tp is 1: C is t^(-1/2).
    slope = of_a_cube(jacobian, "transmitted")(np.array([10.0, 1e30]))[:, 0]
    across = -0.5 * 10.0**-1.5
    expected = [-0.65 / 100, -0.65 / 100, across * 0.5, across * 0.6]
    np.testing.assert_allclose(slope, expected, rtol=1e-13)


@rows("order", [0.0, 0.25, 0.5, 10.25, 2000.37])
def test_slopes_of_a_plate_are_those_of_its_retardance(jacobian, order):
    path = chain([op.Waveplate(A, B, C)], (1.0, 0.0, 1.0, 0.0))
    given = np.array([order * 1e-6 / 0.01, 0.01, 1e-6])
    slope = jacobian(lambda v: path.trace(a=v[0], b=v[1], c=v[2]).stokes)(given)
    with mpmath.workdps(50):
        d, n, w = map(mpmath.mpf, given.tolist())
        angle = 2 * mpmath.pi * d * n / w
        rates = np.array([float(2 * mpmath.pi * r) for r in (n / w, d / w, -d * n / w**2)])
        cos, sin = float(mpmath.cos(angle)), float(mpmath.sin(angle))
    # S2 is the cosine, and S3 the sine.
    expected = np.outer([0.0, 0.0, -sin, cos], rates)
    scale = np.abs(rates).max(where=rates != 0.0, initial=1.0)
    np.testing.assert_allclose(slope / scale, expected / scale, rtol=1e-12, atol=1e-15)


def of_a_cube(jacobian, port):
    nodes = {"lamp": op.Source(stokes=(1.0, 0.3, 0.5, 0.6)), "eye": op.Detector()}
    nodes["cube"] = op.PolarizingBeamSplitter(A, B)
    path = wired(nodes, f"lamp -> cube, cube.{port} -> eye")
    return jacobian(lambda v: path.trace(a=v[0], b=v[1]).stokes)


@rows("port", ["transmitted", "reflected"])
@rows("ratios", [(1.000001, 1.000001), (1e30, 1e30), (2.0, 1e6)])
def test_slopes_of_a_polarising_splitter_are_finite_at_every_ratio(jacobian, port, ratios):
    assert np.isfinite(of_a_cube(jacobian, port)(np.array(ratios))).all()
