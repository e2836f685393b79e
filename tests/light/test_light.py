import pickle

import numpy as np
import pytest

import optipath as op
from light_figures import FIGURES
from tables import rows


def test_light_adds_up_and_is_seen_in_the_frame_of_the_first():
    light = op.Light([1.0, 1.0, 0.0, 0.0]).in_frame(op.Frame().turned(np.pi / 4))
    np.testing.assert_allclose(light.stokes, [1, 0, -1, 0], rtol=1e-15, atol=2e-16)
    vertical = op.Light([1.0, 1.0, 0.0, 0.0], op.Frame().turned(np.pi / 2))
    total = op.Light([1.0, 1.0, 0.0, 0.0]) + vertical
    np.testing.assert_allclose(total.stokes, [2, 0, 0, 0], rtol=0, atol=1e-15)
    light = op.Light([2.0, 0.3, 0.4, 0.5]).in_frame(op.Frame().turned(1.2))
    assert light.stokes[0] == 2.0
    assert light.stokes[3] == 0.5
    assert light.dop == pytest.approx(np.sqrt(0.5) / 2, abs=1e-15)
    with pytest.raises(op.ValueFault, match=r"'a bit' is not a quantity; .* such as '30 deg'"):
        op.Frame().turned("a bit")


def test_what_is_dark_or_not_read_or_without_bounds_has_no_known_polarisation():
    assert np.isnan(op.Light([0.0, 0.0, 0.0, 0.0]).dop)
    light = op.Light([1.0, np.nan, np.nan, np.nan])
    assert light == op.Light([1.0, np.nan, np.nan, np.nan])
    assert pickle.loads(pickle.dumps(light)) == light
    light = op.Light([np.inf, 0.0, 0.0, 0.0], physical=False)
    for name in ("dop", "dolp", "docp", "aop", "ellipticity", "psi", "delta"):
        assert np.isnan(getattr(light, name)), name
    assert light.log10_intensity == np.inf
    assert op.Light([1.0, np.inf, 0.0, 0.0], physical=False).dop == np.inf


def test_batches_of_lights_and_frames_broadcast_or_are_named():
    light = op.Light(np.ones((3, 1, 4)), physical=False).in_frame(op.Frame().turned(np.zeros(2)))
    assert light.stokes.shape == (3, 2, 4)
    two, three = (op.Light(np.ones((n, 4)) * [1, 0, 0, 0]) for n in (2, 3))
    with pytest.raises(op.ShapeError, match=r"light \(2,\), other light \(3,\)"):
        two + three
    with pytest.raises(op.ShapeError, match=r"light \(2,\), frame \(3,\)"):
        two.in_frame(op.Frame().turned(np.zeros(3)))
    with pytest.raises(op.ShapeError, match=r"matrix \(3,\), light \(2,\)"):
        op.Mueller(np.ones((3, 4, 4))) @ two
    with pytest.raises(op.ShapeError, match=r"matrix \(3,\), other matrix \(2,\)"):
        op.Mueller(np.ones((3, 4, 4))) @ op.Mueller(np.ones((2, 4, 4)))


@rows(
    "make",
    [
        lambda: op.Light([1.0, 0, 0, 0], "frame"),
        lambda: op.Light([1.0, 0, 0, 0]).in_frame("frame"),
        lambda: op.Mueller(np.eye(4), frame_in="frame"),
        lambda: op.Frame().rotated(np.eye(2)),
        lambda: op.Frame(x=[10**400, 0, 0]),
        lambda: op.Frame(x=[1e308, 0, 0]),
    ],
)
def test_what_is_no_frame_is_refused(make):
    with pytest.raises(op.FrameError):
        make()


@rows("stokes", [[1.0, 0.0, 0.0], 1.0, [1j, 0, 0, 0], "abcd"])
def test_what_is_no_stokes_vector_is_refused(stokes):
    with pytest.raises(op.ShapeError, match=r"\(\.\.\., 4\)"):
        op.Light(stokes)


def test_faint_light_keeps_all_but_its_plain_numbers():
    light = op.Light([[2.0, 1.2, 0.0, 1.6], [0.0, 0.0, 0.0, 0.0]], exponent=[-5000, 0])
    np.testing.assert_array_equal(light.stokes, 0.0)
    np.testing.assert_allclose(light.normalized, [[1.0, 0.6, 0.0, 0.8], [np.nan] * 4])
    np.testing.assert_allclose(light.dop, [1.0, np.nan])
    np.testing.assert_allclose(light.log10_intensity, [-4999 * np.log10(2), -np.inf])
    faint = op.Light([1.0, 1.0, 0.0, 0.0], exponent=-5000)
    crossed = op.Light([2.0, -2.0, 0.0, 0.0], exponent=-5001)
    np.testing.assert_allclose((faint + crossed).normalized, [1.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose((faint + op.Light([0.0] * 4)).normalized, [1.0, 1.0, 0.0, 0.0])
    np.testing.assert_array_equal((faint + op.Light([1.0, 0, 0, 0])).stokes, [1.0, 0, 0, 0])
    turned = faint.in_frame(op.Frame().turned(np.pi / 4))
    np.testing.assert_allclose(turned.normalized, [1.0, 0.0, -1.0, 0.0], rtol=0, atol=1e-15)
    halved = op.Mueller(np.diag([0.5] * 4)) @ faint
    assert halved.log10_intensity == pytest.approx(-5001 * np.log10(2))
    assert pickle.loads(pickle.dumps(faint)) == faint
    assert faint != op.Light([1.0, 1.0, 0.0, 0.0])
    dark = op.Mueller(np.diag([1e-200] * 4))
    light = dark @ (dark @ op.Light([1.0, 0.6, 0.0, 0.8]))
    assert light.log10_intensity == pytest.approx(-400)
    np.testing.assert_allclose(light.normalized, [1.0, 0.6, 0.0, 0.8])


def test_exponents_are_integers_that_broadcast_and_do_not_run_over():
    with pytest.raises(op.ShapeError, match="integer"):
        op.Light([1.0, 0, 0, 0], exponent=0.5)
    with pytest.raises(op.ShapeError, match="exponent"):
        op.Light(np.ones((3, 4)), exponent=[1, 2])
    light = op.Light([1.0, 0.0, 0.0, 0.0], exponent=[0, 0])
    assert light.stokes.shape == light.normalized.shape == (2, 4)
    assert light.dop.shape == light.log10_intensity.shape == (2,)
    first, second = (op.Light([1.0, 0, 0, 0], exponent=np.uint8(n)) for n in (3, 5))
    assert (first + second).intensity == 40.0
    with pytest.raises(op.ShapeError, match="2\\^40"):
        op.Light([1.0, 0, 0, 0], exponent=np.int64(-(2**62)))


def test_a_light_shows_what_makes_it_again_and_cannot_change():
    light = op.Light([1.0, 0.5, 0.0, 0.0], exponent=-10)
    assert repr(light) == "Light([1. , 0.5, 0. , 0. ], exponent=-10)"
    with pytest.raises(AttributeError, match="cannot change"):
        light.stokes = np.zeros(4)
    turned = op.Light([1.0, 6e-17, 1.0, 0.0])
    assert str(turned) == "Light([1., 0., 1., 0.])"
    assert "6.e-17" in repr(turned)
    crossed = op.Source(100) >> op.Polarizer("30 deg") >> op.Polarizer("-60 deg") >> op.Detector()
    assert str(crossed.trace()) == "Light([0., 0., 0., 0.])"
    faint = op.Source(100) >> op.Attenuator(1e-200) >> op.Detector()
    assert str(faint.trace()) == "Light([1.e-198, 0.e+000, 0.e+000, 0.e+000])"


@rows("size", [1e-170, 1e-300, 1e300])
def test_the_degree_of_polarisation_neither_fades_nor_runs_over(size):
    assert op.Light([1.0, size, 0.0, 0.0], physical=False).dop == pytest.approx(
        size, rel=1e-15, abs=0.0
    )
    light = op.Light([1.0, 2 * size, 3 * size, 6 * size], physical=False)
    assert light.dop == pytest.approx(7 * size, rel=1e-15, abs=0.0)


@rows("place", range(4))
@rows("infinite", [np.inf, -np.inf, 1.7e308])
def test_what_is_infinite_makes_no_warning(place, infinite):
    for rest in (0.0, 1.0, np.inf, 1.7e308):
        stokes = np.full(4, rest)
        stokes[place] = infinite
        light = op.Light(stokes, physical=False)
        for name in FIGURES:
            getattr(light, name)
        assert light.in_frame(op.Frame().turned(0.3)).stokes.shape == (4,)
        for other in (light, op.Light(-stokes, physical=False), op.Light([1.0, 0, 0, 0])):
            assert (light + other).stokes.shape == (4,)
        assert (op.Rotator(0.3).mueller() @ light).stokes.shape == (4,)
