"""Slopes by JAX at every edge and singular point, against differences in 100 digits."""

from functools import cache

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.kernels.catalog import METHODS, REFLECTION, TRANSMISSION
from optipath.lab.boundary_reference import boundary, mueller_numbers, powers, stack
from optipath.lab.many_digits import cos_sin, exact_angle
from tables import rows, slow_except

jax = pytest.importorskip("jax")
sloped = pytest.importorskip("optipath.values.jax_primitives").sloped

pytestmark = pytest.mark.usefixtures("jax_once")
LIGHT = (1.0, 0.3, 0.5, -0.4)
STEP = mpmath.mpf(10) ** -40
PORTS = ("reflected", "transmitted")
NAMES = ("n1", "n", "k", "angle")
N0, N1, ANGLE = map(op.Parameter, ("n0", "n1", "angle"))
SUBSTRATE = op.Material(op.Parameter("n"), op.Parameter("k"))


def seen(A, B, C, S):
    a, b, c, d = LIGHT
    return [A * a + B * b, B * a + A * b, C * c + S * d, C * d - S * c]


def differences(function, point, order=1):
    """Slopes of a function of many digits, the second ones with order 2, argument by argument.

    One-sided, from within: right angles are the last of their domain, all else may grow.
    """
    with mpmath.workdps(120):
        *numbers, angle = point
        exact = [*map(mpmath.mpf, numbers), exact_angle(angle)]
        slopes = []
        for place in range(len(exact)):
            step = -STEP if place == len(exact) - 1 and angle == np.pi / 2 else STEP
            f = []
            for count in range(3):
                moved = list(exact)
                moved[place] += count * step
                f.append(function(*moved))
            # Exact to the second order.
            parts = zip(*f, strict=True)
            if order == 1:
                slopes.append([float((4 * y - z - 3 * x) / (2 * step)) for x, y, z in parts])
            else:
                slopes.append([float((x - 2 * y + z) / step**2) for x, y, z in parts])
        return np.array(slopes)


def one_boundary(port):
    def light(n1, n, k, angle):
        face = boundary(mpmath.mpc(n, k) / n1, *cos_sin(angle))
        return seen(*mueller_numbers(*powers(getattr(face, port))))

    return light


def several(*, reflected):
    def light(*given):
        *indices, k, angle = given
        media = [mpmath.mpc(n) for n in indices[:-1]] + [mpmath.mpc(indices[-1], k)]
        rows = stack(media, media[0].real * cos_sin(angle)[1], way=reflected)
        return [mpmath.fdot(row, LIGHT) for row in rows]

    return light


def by_port(element, port, state=LIGHT):
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=state)) >> path.add("it", element)
    path[f"it.{port}"] >> op.Detector()
    return path


def surface(port):
    return by_port(op.Interface(SUBSTRATE, ANGLE, outside=N1), port)


def layers(port):
    """A layer on a substrate as one element."""
    return by_port(op.LayerStack([N0, N1, SUBSTRATE], ANGLE), port)


def slab(port):
    """Two boundaries between which light goes round."""
    path = op.PathGraph(loops="sum")
    front, back = op.Interface(N1, ANGLE, N0), op.Interface(SUBSTRATE, ANGLE, N1, incidence_in=N0)
    path.add("lamp", op.Source(stokes=LIGHT)) >> path.add("front", front)
    path.add("back", back)
    path["front.transmitted"] >> path["back.in"]
    path["back.reflected"] >> path["front.back"]
    path[f"{'front' if port == 'reflected' else 'back'}.{port}"] >> op.Detector()
    return path


def slopes(plan, names, points, derivative):
    """The slopes of the Stokes vector at several points, (points, arguments, 4)."""

    def stokes(*given):
        return plan.run(**dict(zip(names, given, strict=True))).stokes

    function = derivative(stokes, argnums=tuple(range(len(names))))
    return np.stack(jax.jit(jax.vmap(function))(*np.array(points).T), axis=1)


def agree(found, expected, points, limit=1e-10):
    scale = np.maximum(1.0, np.abs(expected).max(axis=-1, keepdims=True))
    apart = np.abs(found - expected) / scale
    worst = np.unravel_index(np.argmax(np.where(np.isnan(apart), np.inf, apart)), apart.shape)
    said = f"{worst[1]} at {points[worst[0]]}: {found[worst[:2]]}, not {expected[worst[:2]]}"
    assert apart[worst] <= limit, said


def apart_from_critical(n1, n, k, angle):
    return k > 0.0 or abs(n - n1 * np.sin(angle)) > 1e-3


def singular_points(rng):
    """Every edge and singular point of one boundary, with random partners."""
    n1, n, k = rng.uniform(1.0, 2.0), rng.uniform(0.2, 4.0), rng.uniform(0.01, 5.0)
    angle, found = rng.uniform(0.1, 1.5), []
    for each in (0.0, angle, float(np.arctan2(n, n1)), 1e-9, np.pi / 2 - 1e-9, np.pi / 2):
        found += [(n1, n, 0.0, each), (n1, n, k, each), (n1, 0.0, k, each)]
        if each < 1.57:
            found.append((n1, n1, 0.0, each))
        if each > 0.0:
            found.append((n1, 0.0, 0.0, each))
        found += [(n1, n1, k, each), (n1, n1 * (1.0 + 1e-9), 0.0, each)]
    found.append((n1, n1 * np.sin(angle) * 0.9, 0.0, angle))
    found = [point for point in found if apart_from_critical(*point)]
    return [*found, (1.0, 1.5, 0.0, np.pi / 2), (1.0, 0.2, 3.0, np.pi / 2)]


POINTS = singular_points(np.random.default_rng(1))


@cache
def expected_at(port):
    return np.array([differences(one_boundary(port), point) for point in POINTS])


WAYS = [(port, "method", method, jax.jacfwd) for port in PORTS for method in METHODS]
WAYS += [(port, "composing", way, jax.jacrev) for port in PORTS for way in ("stokes", "jones")]
QUICK = {"transmitted": ["stable"], "reflected": ["stable", "textbook", "jones"]}


@pytest.mark.parametrize(
    ("port", "option", "choice", "derivative"),
    slow_except([way for way in WAYS if way[2] in QUICK[way[0]]], WAYS),
)
def test_slopes_are_those_of_many_digits_at_every_singular_point(port, option, choice, derivative):
    plan = op.Composer(**{option: choice}).compose(surface(port))
    agree(slopes(plan, NAMES, POINTS, derivative), expected_at(port), POINTS)


@pytest.mark.slow
@pytest.mark.parametrize("build", [slab, layers])
@pytest.mark.parametrize("port", PORTS)
def test_slopes_of_stacks_and_loops_are_those_of_many_digits(port, build):
    plan, points = op.Composer().compose(build(port)), stacks(np.random.default_rng(1))
    light = several(reflected=port == "reflected")
    expected = np.array([differences(light, point) for point in points])
    agree(slopes(plan, ("n0", *NAMES), points, jax.jacfwd), expected, points)


def stacks(rng):
    """A layer on a substrate at every edge, but for what keeps all light at grazing incidence."""
    found = []
    first, layer, last = rng.uniform(1.0, 2.0), *rng.uniform(0.5, 3.0, 2)
    k, angle = rng.uniform(0.1, 3.0), rng.uniform(0.1, 1.4)
    for each in (0.0, angle, float(np.arctan2(layer, first)), np.pi / 2):
        for media in ((first, layer, last), (first, layer, first), (first, layer, layer)):
            y, closed = first * np.sin(each), media[2] <= first < layer
            for absorbed in (0.0, k):
                if each == np.pi / 2 and closed and not absorbed:
                    continue
                if all(abs(n - y) > 1e-3 for n in media[1:]):
                    found.append((*media, absorbed, each))
        if each < np.pi / 2:
            found.append((first, first, last, 0.0, each))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("derivative", [jax.jacfwd, jax.jacrev])
@jax.disable_jit()
def test_a_slab_at_grazing_incidence_has_the_slopes_of_the_closed_form(derivative):
    # T = T_s / (2 - T_s), and T_p likewise: half of 4 c / g and of 4 n^2 c / g, g^2 = n^2 - 1.
    n = 1.7
    along, across = (2.0 * f / np.sqrt(n * n - 1.0) for f in (1.0, n * n))
    expected = [-0.5 * (along + across), -0.5 * (along - across)]
    if derivative is jax.jacrev:  # Two faces take seconds to be sloped.
        slab_of_glass = op.load_preset("glass-slab", n=n)
        slope = jax.jacfwd(lambda angle: slab_of_glass.trace(theta=angle).stokes)(np.pi / 2)
        np.testing.assert_allclose(slope[:2], expected, rtol=1e-12)
    path = by_port(op.LayerStack([1.0, n, 1.0], ANGLE), "transmitted", [1.0, 0.0, 0.5, 0.0])
    slope = derivative(lambda angle: path.trace(angle=angle).stokes)(np.pi / 2)
    np.testing.assert_allclose(slope[:2], expected, rtol=1e-12)
    # S2 goes by T_s T_p / (1 - R_s R_p), which is T_s T_p / (T_s + T_p) where both are little.
    product = along * across / (along + across)
    np.testing.assert_allclose(slope[2:], [-product, 0.0], rtol=1e-12, atol=1e-15)


def test_matrices_have_the_slopes_of_lights():
    plan = op.Composer().compose(surface("reflected"))
    matrix = jax.jacfwd(lambda angle: plan.mueller(n1=1.0, n=1.5, k=0.0, angle=angle).matrix)
    expected = differences(one_boundary("reflected"), (1.0, 1.5, 0.0, np.pi / 2))[3]
    np.testing.assert_allclose(matrix(np.pi / 2) @ np.array(LIGHT), expected, rtol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("port", PORTS)
def test_second_slopes_are_those_of_many_digits(port):
    points = [point for point in POINTS if point[1] > 0.0 and point[:2] != (1.0, 0.2)]
    points = [p for p in points if p[2] > 0.0 or abs(p[1] - p[0]) > 1e-3]
    plan = op.Composer().compose(surface(port))

    def stokes(*given):
        return plan.run(**dict(zip(NAMES, given, strict=True))).stokes

    by = tuple(range(4))
    found = jax.jit(jax.vmap(jax.jacfwd(jax.jacfwd(stokes, by), by)))(*np.array(points).T)
    found = np.stack([found[place][place] for place in by], axis=1)
    expected = [differences(one_boundary(port), point, order=2) for point in points]
    agree(found, np.array(expected), points, limit=1e-9)


def test_values_are_the_same_whether_slopes_are_taken_or_not():
    plan, points = op.Composer().compose(surface("transmitted")), np.array(POINTS).T
    given = dict(zip(NAMES, points, strict=True))

    def stokes(angle):
        return plan.run(**given | {"angle": angle}).stokes

    alone, beside = (f(given["angle"]) for f in (stokes, lambda x: jax.jvp(stokes, (x,), (x,))[0]))
    np.testing.assert_allclose(beside, alone, rtol=1e-13, atol=1e-16)
    assert np.all(np.asarray(beside)[points[3] == np.pi / 2] == 0.0)


@pytest.mark.slow
def test_single_precision_has_slopes_at_the_edges_too():
    plan, points = op.Composer(dtype="float32").compose(surface("transmitted")), POINTS
    # Next to a right angle, and to an equal medium, float32 is somewhere else.
    points = [p for p in points if p[3] != 1e-9 and abs(p[3] - np.pi / 2) != 1e-9]
    points = [p for p in points if p[0] == p[1] or abs(p[0] - p[1]) > 1e-6]
    near = [p for p in points if apart_from_critical(*p[:3], p[3])]
    expected = np.array([differences(one_boundary("transmitted"), p) for p in near])
    agree(slopes(plan, NAMES, near, jax.jacfwd), expected, near, limit=2e-3)


@rows("kernel", [REFLECTION, TRANSMISSION])
@rows("absorbing", [True, False])
def test_infinite_slopes_are_no_number_that_could_be_one(kernel, absorbing):
    # sin = n: g is 0, and its slope in whatever changes it is infinite.
    chosen = kernel.by_method("stable")
    given = (1.0, 0.6, 0.0, 0.8, 0.6) if absorbing else (1.0, 0.6, 0.8, 0.6)
    made = (chosen if absorbing else chosen.without[1]).made_for(sloped(np.dtype(float)))
    for slope in jax.grad(lambda *given: made(*given)[0], argnums=(1, len(given) - 1))(*given):
        assert not abs(slope) < 1e8


def test_slopes_at_grazing_incidence_on_an_equal_medium_are_those_just_before_it():
    # There, any contrast reflects all light at once.
    plan = op.Composer().compose(surface("reflected"))
    # So many that JAX knows their shapes by now.
    found = slopes(plan, NAMES, [(1.3, 1.3, 0.0, np.pi / 2)] * len(POINTS), jax.jacfwd)
    np.testing.assert_allclose(found, 0.0, rtol=0, atol=1e-15)


def test_what_a_loop_loses_has_a_slope_where_it_loses_nothing_yet():
    # exp(-2 a length) goes round with what both faces reflect: dT/da at a = 0, and unpolarised.
    path, n, length = op.load_preset("glass-slab"), 1.5, 5e-3
    slope = jax.grad(lambda a: path.trace(theta=0.0, n=n, absorption=a).intensity)(0.0)
    R = ((n - 1.0) / (n + 1.0)) ** 2
    expected = -length * (1.0 - R) ** 2 * (1.0 + R * R) / (1.0 - R * R) ** 2
    assert float(slope) == pytest.approx(expected, rel=1e-12)
