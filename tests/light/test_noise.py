"""What light is like that is nearly dark, or nearly unpolarised: of noise nothing is told."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.lab.accuracy.path_reference import exact_lights
from tables import rows

OF_DARK = ["dop", "dolp", "docp", "aop", "ellipticity", "ellipticity_angle", "psi", "delta"]
CROSSED = [(a, a + np.pi / 2) for a in np.radians([0, 7, 30, 45, 60, 75, 100, 130])]


def chain(*elements, stokes=(1.0, 0.0, 0.0, 0.0)):
    path = op.PathGraph()
    last = path.add("lamp", op.Source(stokes=stokes))
    for number, element in enumerate(elements):
        last = last >> path.add(f"e{number}", element)
    last >> path.add("eye", op.Detector())
    return path


def polarisers():
    return chain(op.Polarizer(op.Parameter("a")), op.Polarizer(op.Parameter("b")))


def assert_dark(light):
    assert np.all(light.noise >= light.S0)
    for name in OF_DARK:
        assert np.isnan(getattr(light, name)).all(), name
    assert np.isnan(light.normalized).all()
    assert np.all(light.handedness == 0)


@rows("pair", CROSSED)
@rows("before", [[], [op.Retarder(1.0, 0.3)], [op.Interface(1.5, 0.6)], [op.Rotator(0.4)]])
def test_light_behind_crossed_polarisers_has_no_polarisation(pair, before):
    assert_dark(chain(*before, *map(op.Polarizer, pair)).trace())


def test_crossed_polarisers_leave_no_light_however_they_are_met():
    assert_dark(chain(*[op.Polarizer(0.3)] * 6, op.Polarizer(0.3 + np.pi / 2)).trace())
    for a, b in CROSSED:
        assert_dark(op.Polarizer(b) @ (op.Polarizer(a) @ op.Light([1.0, 0.0, 0.0, 0.0])))
    dark = polarisers().trace(a=0.3, b=[0.3 + np.pi / 2] * 2)
    turned = dark.in_frame(op.Frame().turned(0.2))
    for light in (2 * dark, dark / 3, dark + dark, dark[1], turned, op.Rotator(0.2) @ dark):
        assert_dark(light)
    for light in (pickle.loads(pickle.dumps(dark)), copy.copy(dark), dark.nearest_physical()):
        assert_dark(light)
    assert (dark + op.Light([1.0, 1.0, 0.0, 0.0])).aop == pytest.approx([0.0, 0.0], abs=1e-15)


@rows(
    "options",
    [
        {"dtype": "float32"},
        {"composing": "jones"},
        {"engine": "numpy"},
        {"tolerance": 0.1},
        {"model": "full"},
    ],
)
def test_every_way_to_run_a_path_tells_dark_from_bright(options):
    a = np.array([0.3, 1.0, 0.5])
    b = np.array([0.3 + np.pi / 2, 1.0 + np.pi / 2, 0.6])
    light = op.Composer(**options).compose(polarisers()).run(a=a, b=b)
    assert_dark(light[:2])
    assert light[2].aop == pytest.approx(0.6, abs=1e-6)
    assert light[2].dop == pytest.approx(1.0, abs=1e-6)


def test_every_link_and_part_and_sum_has_its_own_noise():
    lights = polarisers().trace(keep="all", a=0.3, b=0.3 + np.pi / 2)
    assert_dark(lights["eye"])
    assert lights["e0.out -> e1.in"].aop == pytest.approx(0.3)
    a = np.linspace(0.1, 3.0, 5)
    for part in polarisers().compose().stream(2, a=a, b=a + np.pi / 2):
        assert_dark(part.light)
    many = op.Light(np.broadcast_to([1.0, 0.0, 0.0, 0.0], (3000, 4)))
    assert sum(many).noise == pytest.approx(3000 * 2.0**-52)
    a = np.array([0.3, 0.5])
    light = polarisers().trace(a=a, b=[0.3, 0.5 + np.pi / 2 - 1e-9])
    a[:] = 2.0
    np.testing.assert_array_equal(np.isnan(light.dop), [False, False])


@rows("count", [1, 2, 60])
def test_light_that_is_dimmed_keeps_all_its_figures(count):
    light = chain(*[op.Attenuator(1e-200)] * count, stokes=(1.0, 0.6, 0.0, 0.8)).trace()
    assert light.log10_intensity == pytest.approx(-200 * count)
    assert light.dop == pytest.approx(1.0)
    assert light.aop == pytest.approx(0.0)
    assert light.ellipticity == pytest.approx(0.5)
    assert light.handedness == 1


def test_faint_light_that_is_known_keeps_its_figures():
    # Near Brewster's angle, what lies along y comes back with a share of 1e-10 each time.
    glass = op.Interface(1.5, np.arctan(1.5) + 1e-5)
    light = chain(glass, glass, stokes=(1.0, -1.0, 0.0, 0.0)).trace()
    assert light.S0 < 1e-19
    assert light.aop == pytest.approx(np.pi / 2)
    assert light.dop == pytest.approx(1.0)
    light = chain(op.Polarizer(0.3), op.Polarizer(0.3 + np.pi / 2 - 1e-6)).trace()
    assert pytest.approx(0.5e-12, rel=1e-3) == light.S0
    assert light.aop == pytest.approx(0.3 - np.pi / 2 - 1e-6, abs=1e-3)
    assert (1e300 * (1e300 * op.Light([1.0, 0.0, 0.0, 0.0]))).noise == np.inf


@rows("index", [1.33, 1.5, 1.6, 1.7, 2.4, 4.0, 0.66])
def test_what_is_left_at_brewsters_angle_itself_has_no_figures(index):
    # Exactly there nothing is; the angle is rounded, and so are the waves that cancel.
    assert_dark(chain(op.Interface(index, np.arctan(index)), stokes=(1.0, -1.0, 0.0, 0.0)).trace())
    off = 1e-12  # r_p changes by (n^4 - 1) / (4 n^3) a radian there.
    light = chain(op.Interface(index, np.arctan(index) + off), stokes=(1.0, -1.0, 0.0, 0.0)).trace()
    slope = (index**4 - 1.0) / (4.0 * index**3)
    assert pytest.approx((off * slope) ** 2, rel=2e-3) == light.S0
    assert light.dop == pytest.approx(1.0)


def test_unpolarised_light_of_two_lamps_has_no_axis():
    path = op.PathGraph()
    both = path.add("both", op.Combiner())
    for name, angle in (("one", 0.3), ("other", 0.3 + np.pi / 2)):
        path.add(name, op.Source()) >> path.add(f"p-{name}", op.Polarizer(angle)) >> both
    both >> path.add("eye", op.Detector())
    light = path.trace()
    assert light.dop < 1e-15
    assert np.isnan([light.aop, light.ellipticity, light.psi, light.delta]).all()


def test_a_component_of_noise_gives_no_angle_and_turns_no_ellipse():
    light = op.Light([1.0, 1e-17, 0.0, 0.0])
    assert light.dop == 1e-17
    assert np.isnan([light.aop, light.psi, light.delta, light.ellipticity]).all()
    assert light.noise == 2.0**-52
    assert op.Light(np.float32([1.0, 0.0, 0.0, 0.0])).noise == 2.0**-23
    light = op.Light([1.0, 0.8, 1e-17, -1e-17])
    assert light.aop == light.ellipticity == light.ellipticity_angle == light.psi == 0.0
    upright = op.Light([1.0, -0.8, -1e-17, 0.0])
    assert upright.aop == upright.psi == np.pi / 2
    delta = op.Light([1.0, 0.0, 1.0, 1e-17]).delta
    assert delta == 0.0
    assert not np.signbit(delta)


@rows("seed", range(12))
def test_no_component_is_off_by_more_than_the_noise(seed):
    rng = np.random.default_rng(seed)
    angle = rng.choice([0.0, 0.3, 0.3 + np.pi / 2, np.pi / 2, np.pi / 4, 1.1])
    some = [
        lambda: op.Polarizer(angle + rng.choice([0.0, np.pi / 2])),
        lambda: op.Retarder(rng.uniform(0, 3), rng.uniform(0, 3)),
        lambda: op.Interface(1.5 + 0.3j, rng.uniform(0, 1.5), azimuth=rng.uniform(0, 3)),
        lambda: op.Attenuator(0.3),
        lambda: op.Polarizer(rng.uniform(0, 3)),
    ]
    path = chain(*(some[i]() for i in rng.integers(0, len(some), 5)))
    light, exact = path.trace(), exact_lights(path)["eye"].stokes
    off = max(abs(float(x - y)) for x, y in zip(exact, map(float, light.stokes), strict=True))
    # The noise of light that is far above it is not looked for; here it is.
    whole, noise = path.compose().answers.whole, path.compose().answers.noise
    reading = whole.program.readings["eye"]
    _, most = noise.noise(whole.reader.read({}), reading, np.array(0))
    assert off <= most <= noise.most(whole.reader.read({}))


def test_jax_gives_nan_and_slopes_of_nought():
    jax = pytest.importorskip("jax")
    for stokes in ([0.0] * 4, [1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 1.0]):
        traced = jax.jit(lambda s: op.Light(s).aop)
        assert np.isnan(traced(jax.numpy.array(stokes)))
        slope = jax.grad(lambda s: op.Light(s).aop)(jax.numpy.array(stokes))
        np.testing.assert_array_equal(slope, 0.0)


@rows("factor", [1e-310, 5e-324, 1e300])
def test_light_that_comes_back_from_any_factor_has_its_noise_and_its_ellipse(factor):
    light = op.Light([1.0, 0.5, 0.0, 0.2])
    back = (light * factor) / factor
    np.testing.assert_allclose(back.noise, light.noise, rtol=1.0)
    np.testing.assert_allclose(back.dop, np.sqrt(0.29), rtol=1e-15)
    assert str(back) == str(light)
