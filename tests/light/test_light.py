"""Light itself: its numbers, how it is shown, and that it does not change."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from light_figures import FIGURES
from tables import rows

X, STATE = [1.0, 0.0, 0.0, 0.0], [1.0, 0.6, 0.0, 0.8]


def test_light_is_seen_in_another_frame_of_its_direction():
    light = op.Light([1.0, 1.0, 0.0, 0.0]).in_frame(op.Frame().turned(np.pi / 4))
    np.testing.assert_allclose(light.stokes, [1, 0, -1, 0], rtol=1e-15, atol=2e-16)
    light = op.Light([2.0, 0.3, 0.4, 0.5]).in_frame(op.Frame().turned(1.2))
    assert (light.stokes[0], light.stokes[3]) == (2.0, 0.5)
    assert light.dop == pytest.approx(np.sqrt(0.5) / 2, abs=1e-15)


def test_what_is_dark_or_not_read_or_without_bounds_has_no_known_polarisation():
    assert np.isnan(op.Light([0.0, 0.0, 0.0, 0.0]).dop)
    light = op.Light([1.0, np.nan, np.nan, np.nan])
    assert light == op.Light([1.0, np.nan, np.nan, np.nan]) == pickle.loads(pickle.dumps(light))
    light = op.Light([np.inf, 0.0, 0.0, 0.0], physical=False)
    for name in ("dop", "dolp", "docp", "aop", "ellipticity", "psi", "delta"):
        assert np.isnan(getattr(light, name)), name
    assert light.log10_intensity == np.inf
    assert op.Light([1.0, np.inf, 0.0, 0.0], physical=False).dop == np.inf


def test_batches_of_lights_and_frames_broadcast_or_are_named():
    light = op.Light(np.ones((3, 1, 4)), physical=False).in_frame(op.Frame().turned(np.zeros(2)))
    assert light.stokes.shape == (3, 2, 4)
    two, three = (op.Light(np.ones((n, 4)) * X) for n in (2, 3))
    matrices = op.Mueller(np.ones((3, 4, 4)))
    for wrong, shapes in (
        (lambda: two + three, r"light \(2,\), other light \(3,\)"),
        (lambda: two.in_frame(op.Frame().turned(np.zeros(3))), r"light \(2,\), frame \(3,\)"),
        (lambda: matrices @ two, r"matrix \(3,\), light \(2,\)"),
        (lambda: matrices @ matrices[:2], r"matrix \(3,\), other matrix \(2,\)"),
    ):
        with pytest.raises(op.errors.ShapeError, match=shapes):
            wrong()


@rows("stokes", [[1.0, 0.0, 0.0], 1.0, [1j, 0, 0, 0], "abcd"])
def test_what_is_no_stokes_vector_is_refused(stokes):
    with pytest.raises(op.errors.ShapeError, match=r"\(\.\.\., 4\)"):
        op.Light(stokes)


def test_faint_light_keeps_its_figures():
    light = op.Light([[2e-300, 1.2e-300, 0.0, 1.6e-300], [0.0, 0.0, 0.0, 0.0]])
    np.testing.assert_allclose(light.normalized, [STATE, [np.nan] * 4])
    np.testing.assert_allclose(light.dop, [1.0, np.nan])
    np.testing.assert_allclose(light.log10_intensity, [np.log10(2) - 300, -np.inf])
    faint = op.Light([1e-300, 1e-300, 0.0, 0.0])
    crossed = op.Light([1e-300, -1e-300, 0.0, 0.0])
    np.testing.assert_allclose((faint + crossed).normalized, X)
    np.testing.assert_allclose((faint + op.Light(X)).stokes, X, rtol=0, atol=1e-299)
    turned = faint.in_frame(op.Frame().turned(np.pi / 4))
    np.testing.assert_allclose(turned.normalized, [1.0, 0.0, -1.0, 0.0], rtol=0, atol=1e-15)
    halved = op.Mueller(np.diag([0.5] * 4)) @ faint
    assert halved.log10_intensity == pytest.approx(np.log10(0.5) - 300)
    assert pickle.loads(pickle.dumps(faint)) == faint != op.Light([1.0, 1.0, 0.0, 0.0])
    dark = op.Mueller(np.diag([1e-200] * 4))
    assert (dark @ (dark @ op.Light(STATE))).log10_intensity == -np.inf


def test_a_light_shows_what_makes_it_again_in_a_line_or_a_few():
    assert repr(op.Light([1, 0.5, 0, 0])) == "Light([1. , 0.5, 0. , 0. ])"
    assert "frame=Frame(x=(0.9" in repr(op.Light(X, op.Frame().turned(0.3)))
    many = repr(op.Light(np.ones((1000, 4)) * X))
    assert many.count("\n") < 6
    assert many.endswith("shape=(1000,))")
    path = op.load_preset("npgr026", case=8)
    light = op.Composer(composing="jones").compose(path).run()
    assert str(light) == str(path.trace()) == repr(light)
    turned = op.Light([1.0, 6e-17, 1.0, 0.0])
    assert str(turned) == "Light([1., 0., 1., 0.])"
    assert "6.e-17" in repr(turned)
    crossed = op.Source(100) >> op.Polarizer("30 deg") >> op.Polarizer("-60 deg") >> op.Detector()
    assert str(crossed.trace()) == "Light([0., 0., 0., 0.])"
    faint = op.Source(100) >> op.Attenuator(1e-200) >> op.Detector()
    assert str(faint.trace()) == "Light([1.e-198, 0.e+000, 0.e+000, 0.e+000])"


@rows("size", [1e-170, 1e-300, 1e300])
def test_the_degree_of_polarisation_neither_fades_nor_runs_over(size):
    for stokes, dop in (([1, size, 0, 0], size), ([1, 2 * size, 3 * size, 6 * size], 7 * size)):
        assert op.Light(stokes, physical=False).dop == pytest.approx(dop, rel=1e-15, abs=0.0)


@rows("place", range(4))
@rows("infinite", [np.inf, -np.inf, 1.7e308])
def test_what_is_infinite_makes_no_warning(place, infinite):
    for rest in (0.0, 1.0, np.inf, 1.7e308):
        stokes = np.full(4, rest)
        stokes[place] = infinite
        light = op.Light(stokes, physical=False)
        for name in FIGURES:
            getattr(light, name)
        made = [light + other for other in (light, op.Light(-stokes, physical=False), op.Light(X))]
        made += [light.in_frame(op.Frame().turned(0.3)), op.Rotator(0.3).mueller() @ light]
        assert [each.stokes.shape for each in made] == [(4,)] * 5


PATH = op.Source(op.Parameter("i")) >> op.Polarizer("30 deg") >> op.Detector()
LIGHTS = {
    "given": lambda: op.Light(STATE),
    "broadcast": lambda: op.Light(np.broadcast_to(STATE, (3, 4))),
    "float32": lambda: op.Light(np.array(STATE, np.float32)),
    "of a path": lambda: PATH.trace(i=1.0),
    "of a batch of paths": lambda: PATH.trace(i=[1.0, 2.0]),
    "one of a batch": lambda: PATH.trace(i=[1.0, 2.0])[1],
    "a sum": lambda: op.Light(STATE) + op.Light(STATE),
    "a multiple": lambda: 0.5 * op.Light(STATE),
    "behind an element": lambda: op.Polarizer(0.2) @ op.Light(STATE),
    "of other software": lambda: op.Light.from_("mitsuba", STATE),
    "a copy": lambda: copy.deepcopy(op.Light(STATE)),
    "a pickle": lambda: pickle.loads(pickle.dumps(PATH.trace(i=[1.0, 2.0]))),
}


@rows("name", LIGHTS)
def test_components_may_be_scaled_in_place_and_the_arrays_of_light_are_read_only(name):
    light = LIGHTS[name]()
    before = light.stokes.copy()
    for component in (light.intensity, light.S0, light.S1, light.S2, light.S3):
        np.multiply(component, 0.0, out=component)
    np.testing.assert_array_equal(light.stokes, before)
    np.testing.assert_array_equal(light.intensity, before[..., 0])
    for array in (light.stokes, np.asarray(light), light.noise):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 2
    assert np.array(light).flags.writeable
    with pytest.raises(AttributeError, match="cannot change"):
        light.stokes = np.zeros(4)


def test_what_is_done_to_arrays_that_light_gives_or_is_given_is_not_done_to_the_light():
    light = PATH.trace(i=[1.0, 2.0])
    intensity = light.intensity
    intensity /= intensity.max()
    np.testing.assert_allclose(light.S0, [0.5, 1.0], rtol=1e-15)
    np.testing.assert_allclose(light.dop, 1.0, rtol=1e-15)
    light = PATH.trace(i=np.ones(70_000))
    for component in (light.intensity, light.S0, light.S3):
        with pytest.raises(ValueError, match="read-only"):
            component[...] = 2.0
    assert np.shares_memory(light.S1, light.stokes)
    state = np.array([1.0, 1.0, 0.0, 0.0])
    light = op.Light(state)
    state[0] = 0.5
    assert light.dop == 1.0


@rows(
    "made",
    [
        op.Mueller,
        lambda m: op.Mueller(m) @ op.Mueller(m),
        lambda m: op.MuellerElement(m).mueller(),
        lambda m: op.MuellerElement(m) @ op.Rotator(0.0),
        lambda m: op.Mueller(m).nearest_physical(),
        lambda m: op.Mueller(m).lu_chipman().retarder,
        lambda m: pickle.loads(pickle.dumps(op.Mueller(m))),
        lambda m: copy.deepcopy(op.Mueller(m)),
    ],
)
def test_a_mueller_matrix_does_not_change(made):
    given = np.eye(4)
    matrix = made(given).matrix
    given[0, 0] = 0.5
    np.testing.assert_allclose(matrix, np.eye(4), atol=1e-15)
    with pytest.raises(ValueError, match="read-only"):
        matrix[0, 0] = 2.0
