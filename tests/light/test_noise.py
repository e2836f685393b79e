"""What no light can be is refused; of what is nearly dark, or unpolarised, nothing is told."""

import copy
import pickle

import numpy as np
import pytest

import optipath as op
from optipath.lab.path_reference import exact_lights
from paths import chain
from tables import rows

FIGURES = ["dop", "dolp", "docp", "aop", "ellipticity", "ellipticity_angle", "psi", "delta"]
CROSSED = [(a, a + np.pi / 2) for a in np.radians([0, 7, 30, 45, 60, 75, 100, 130])]
POLARISERS = chain([op.Polarizer(op.Parameter("a")), op.Polarizer(op.Parameter("b"))])


def assert_dark(*lights):
    for light in lights:
        assert np.all(light.noise >= light.S0)
        for name in FIGURES:
            assert np.isnan(getattr(light, name)).all(), name
        assert np.isnan(light.normalized).all()
        assert np.all(light.handedness == 0)


@rows("pair", CROSSED)
@rows("before", [[], [op.Retarder(1.0, 0.3)], [op.Interface(1.5, 0.6)], [op.Rotator(0.4)]])
def test_light_behind_crossed_polarisers_has_no_polarisation(pair, before):
    assert_dark(chain([*before, *map(op.Polarizer, pair)]).trace())


def test_crossed_polarisers_leave_no_light_however_they_are_met():
    assert_dark(chain([op.Polarizer(0.3)] * 6 + [op.Polarizer(0.3 + np.pi / 2)]).trace())
    for a, b in CROSSED:
        assert_dark(op.Polarizer(b) @ (op.Polarizer(a) @ op.Light([1.0, 0.0, 0.0, 0.0])))
    dark = POLARISERS.trace(a=0.3, b=[0.3 + np.pi / 2] * 2)
    turned = dark.in_frame(op.Frame().turned(0.2))
    assert_dark(2 * dark, dark / 3, dark + dark, dark[1], turned, op.Rotator(0.2) @ dark)
    assert_dark(pickle.loads(pickle.dumps(dark)), copy.copy(dark), dark.nearest_physical())
    assert (dark + op.Light([1.0, 1.0, 0.0, 0.0])).aop == pytest.approx([0.0, 0.0], abs=1e-15)


@rows(
    "options",
    [
        *[{"dtype": "float32"}, {"composing": "jones"}, {"engine": "numpy"}],
        *[{"tolerance": 0.1}, {"model": "full"}],
    ],
)
def test_every_way_to_run_a_path_tells_dark_from_bright(options):
    a, b = np.array([[0.3, 1.0, 0.5], [0.3 + np.pi / 2, 1.0 + np.pi / 2, 0.6]])
    light = op.Composer(**options).compose(POLARISERS).run(a=a, b=b)
    assert_dark(light[:2])
    assert light[2].aop == pytest.approx(0.6, abs=1e-6)
    assert light[2].dop == pytest.approx(1.0, abs=1e-6)


def test_every_link_and_part_and_sum_has_its_own_noise():
    lights = POLARISERS.trace(keep="all", a=0.3, b=0.3 + np.pi / 2)
    assert_dark(lights["eye"])
    assert lights["e0.out -> e1.in"].aop == pytest.approx(0.3)
    a = np.linspace(0.1, 3.0, 5)
    assert_dark(*[part.light for part in POLARISERS.compose().stream(2, a=a, b=a + np.pi / 2)])
    many = op.Light(np.broadcast_to([1.0, 0.0, 0.0, 0.0], (3000, 4)))
    assert sum(many).noise == pytest.approx(3000 * 2.0**-52)
    a = np.array([0.3, 0.5])
    light = POLARISERS.trace(a=a, b=[0.3, 0.5 + np.pi / 2 - 1e-9])
    a[:] = 2.0
    np.testing.assert_array_equal(np.isnan(light.dop), [False, False])


@rows("count", [1, 2, 60])
def test_light_that_is_dimmed_keeps_all_its_figures(count):
    light = chain([op.Attenuator(10.0 ** -(280 / count))] * count, (1.0, 0.6, 0.0, 0.8)).trace()
    assert light.log10_intensity == pytest.approx(-280)
    found = light.dop, light.aop, light.ellipticity, light.handedness
    assert found == pytest.approx((1.0, 0.0, 0.5, 1))


def test_faint_light_that_is_known_keeps_its_figures():
    # Near Brewster's angle, what lies along y comes back with a share of 1e-10 each time.
    glass = op.Interface(1.5, np.arctan(1.5) + 1e-5)
    light = chain([glass, glass], (1.0, -1.0, 0.0, 0.0)).trace()
    assert light.S0 < 1e-19
    assert (light.aop, light.dop) == pytest.approx((np.pi / 2, 1.0))
    light = POLARISERS.trace(a=0.3, b=0.3 + np.pi / 2 - 1e-6)
    assert pytest.approx(0.5e-12, rel=1e-3) == light.S0
    assert light.aop == pytest.approx(0.3 - np.pi / 2 - 1e-6, abs=1e-3)
    assert (1e300 * (1e300 * op.Light([1.0, 0.0, 0.0, 0.0]))).noise == np.inf


@rows("index", [1.33, 1.5, 1.6, 1.7, 2.4, 4.0, 0.66])
def test_what_is_left_at_brewsters_angle_itself_has_no_figures(index):
    # Exactly there nothing is; the angle is rounded, and so are the waves that cancel.
    off = 1e-12  # r_p changes by (n^4 - 1) / (4 n^3) a radian there.
    path = chain([op.Interface(index, op.Parameter("a"))], (1.0, -1.0, 0.0, 0.0))
    assert_dark(path.trace(a=np.arctan(index)))
    beside = path.trace(a=np.arctan(index) + off)
    slope = (index**4 - 1.0) / (4.0 * index**3)
    assert pytest.approx((off * slope) ** 2, rel=2e-3) == beside.S0
    assert beside.dop == pytest.approx(1.0)


def test_a_component_of_noise_gives_no_angle_and_turns_no_ellipse():
    path = op.PathGraph()
    both = path.add("both", op.Combiner())
    for angle in (0.3, 0.3 + np.pi / 2):
        path.add(f"lamp{angle > 1}", op.Source()) >> op.Polarizer(angle) >> both
    both >> op.Detector()
    light = path.trace()
    assert light.dop < 1e-15
    assert np.isnan([light.aop, light.ellipticity, light.psi, light.delta]).all()
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
    assert (delta, np.signbit(delta)) == (0.0, False)


@rows("seed", range(6))
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
    path = chain([some[i]() for i in rng.integers(0, len(some), 5)])
    light, exact = path.trace(), exact_lights(path)["eye"].stokes
    off = max(abs(float(x - y)) for x, y in zip(exact, map(float, light.stokes), strict=True))
    # The noise of light that is far above it is not looked for; here it is.
    whole, noise = path.compose().answers.whole, path.compose().answers.noise
    reading = whole.program.readings["eye"]
    _, most = noise.noise(whole.reader.read({}), reading)
    assert off <= most <= noise.most(whole.reader.read({}))


@rows("factor", [1e-200, 1e-30, 1e200])
def test_light_that_comes_back_from_any_factor_has_its_noise_and_its_ellipse(factor):
    light = op.Light([1.0, 0.5, 0.0, 0.2])
    back = (light * factor) / factor
    np.testing.assert_allclose(back.noise, light.noise, rtol=1.0)
    np.testing.assert_allclose(back.dop, np.sqrt(0.29), rtol=1e-15)
    assert str(back) == str(light)


@rows(
    "stokes, sentence",
    [
        ([1.0, 1.0, 1.0, 1.0], r"light is \[1.0, 1.0, 1.0, 1.0\], polarised by 173.205 %"),
        ([1.0, 1.0 + 1e-9, 0.0, 0.0], "polarised by 100 % and a little"),
        ([1.0, 0.8, 0.7, np.nan], "polarised by 106.301 %"),
        ([-1.0, 0.0, 0.0, 0.0], "intensity -1.0 is negative"),
        ([1.0, 0.0, -np.inf, 0.0], "not finite"),
        ([0.0, 1e-300, 0.0, 0.0], "polarised, and dark"),
        ([1e308, 1e308, 1e308, 1e308], "polarised by 173.205 %"),
        ([[1.0, 0, 0, 0], [1.0, 2.0, 0, 0], [1.0, 3.0, 0, 0]], "light at 1 is"),
        (np.array([1.0, 1.001, 0.0, 0.0], np.float32), "polarised by 100.1 %"),
    ],
)
def test_what_no_light_can_be_is_refused_with_the_numbers_and_the_cure(stokes, sentence):
    with pytest.raises(
        op.errors.ValueFault, match=rf"{sentence}.*physical=False.*nearest_physical"
    ):
        op.Light(stokes)


@rows(
    "stokes",
    [
        *[[1.0, 0.6, 0.0, 0.8], [0.0] * 4, [1.0, 1.0 + 2e-16, 0.0, 0.0], np.ones((0, 4))],
        *[[1.0, np.nan, np.nan, np.nan], [np.nan] * 4, [1.0, 0.6, 0.8, np.nan]],
        np.float32([0.3, 0.1, 0.2, 0.2]) * np.float32([1.0, 1.0, 1.0, 1.0000001]),
        np.float32([1.0, np.sqrt(0.5), np.sqrt(0.5), 0.0]),
        np.float16([1.0, np.sqrt(0.5), np.sqrt(0.5), 0.0]),
    ],
)
def test_light_within_its_rounding_is_light(stokes):
    np.testing.assert_array_equal(op.Light(stokes), stokes)


def test_what_is_computed_with_noise_is_not_refused():
    noise = op.Light([1.0, 1.0, 1.0, 1.0], physical=False)
    turned = noise.in_frame(op.Frame().turned(0.3))
    for light in (noise + noise, 2 * noise, noise / 3, turned, noise[...], noise.reshape(1)):
        assert np.all(light.dop > 1.7)
    assert (op.Mueller(3 * np.eye(4)) @ noise).S0 == 3.0
    assert (op.Mueller(np.diag([0.5, 1, 1, 1])) @ (noise / 2)).dop == pytest.approx(2 * 3**0.5)
    for again in (pickle.loads(pickle.dumps(noise)), copy.deepcopy(noise)):
        assert again == noise
    with pytest.raises(op.errors.ValueFault, match=r"173\.205 %"):
        op.Light([1e-300, 1e-300, 1e-300, 1e-300])
    assert op.Light([1e-300, 1e-300, 1e-300, 1e-300], physical=False).dop > 1.7


@rows(
    "noisy, nearest",
    [
        ([1.0, 3.0, 0.0, -4.0], [1.0, 0.6, 0.0, -0.8]),
        ([2.0, 0.6, 0.0, 0.8], [2.0, 0.6, 0.0, 0.8]),
        ([-1.0, 0.5, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]),
        ([0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]),
        ([1.0, 3.0, 4.0, np.nan], [1.0, 0.6, 0.8, np.nan]),
        ([1e300, 3e300, 0.0, 4e300], [1e300, 0.6e300, 0.0, 0.8e300]),
    ],
)
def test_the_nearest_light_keeps_its_intensity_its_ellipse_and_its_frames(noisy, nearest):
    found = op.Light(noisy, physical=False).nearest_physical()
    assert op.Light(found.stokes) == found
    frame = op.Frame().turned([0.1, 0.2])
    found = op.Light([noisy, noisy], frame, physical=False).nearest_physical()
    np.testing.assert_allclose(found.stokes, [nearest] * 2, rtol=1e-15)
    assert found.frame == frame


def test_light_that_jax_traces_is_not_judged_and_comes_near(jacobian):
    jax = pytest.importorskip("jax")

    def nearest(stokes):
        return op.Light(stokes).nearest_physical().stokes

    stokes = np.array([1.0, 3.0, 0.0, 4.0], np.float32)
    np.testing.assert_allclose(jax.jit(nearest)(stokes), [1.0, 0.6, 0.0, 0.8], rtol=1e-6)
    dark = jax.numpy.zeros(4)
    assert np.isfinite(jacobian(nearest)(dark)).all()
    with pytest.raises(op.errors.ValueFault, match="500 %"):
        op.Light(jax.numpy.array(stokes))
