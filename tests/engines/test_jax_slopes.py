"""Slopes by JAX at every edge and singular point, against differences in 100 digits."""

import mpmath
import numpy as np
import pytest

import optipath as op
from optipath.accuracy import reference
from optipath.accuracy.boundary_reference import stack
from optipath.accuracy.many_digits import cos_sin, exact_angle
from optipath.kernels import METHODS

jax = pytest.importorskip("jax")

LIGHT = (1.0, 0.3, 0.5, -0.4)
STEP = mpmath.mpf(10) ** -40
PORTS = {"reflection": "reflected", "transmission": "transmitted"}
REFERENCES = {"reflection": reference._reflected, "transmission": reference._transmitted}


@pytest.fixture(autouse=True)
def _double():
    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it
    yield
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto


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


def one_boundary(what):
    def light(n1, n, k, angle):
        return seen(*REFERENCES[what](mpmath.mpc(n, k) / n1, *cos_sin(angle)))

    return light


def several(*, reflected):
    def light(*given):
        *indices, k, angle = given
        media = [mpmath.mpc(n) for n in indices[:-1]] + [mpmath.mpc(indices[-1], k)]
        rows = stack(media, *cos_sin(angle), back=False, way=reflected)
        return [sum(m * s for m, s in zip(row, LIGHT, strict=True)) for row in rows]

    return light


def surface(what):
    path = op.PathGraph()
    media = op.Material(op.Parameter("n"), op.Parameter("k"))
    path.add("lamp", op.Source(stokes=LIGHT))
    path.add("face", op.Interface(media, op.Parameter("angle"), outside=op.Parameter("n1")))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "face.in")
    path.connect(f"face.{PORTS[what]}", "eye.in")
    return path


def layers(count, what):
    """A stack of so many media as one element."""
    media = [op.Parameter(f"n{place}") for place in range(count - 1)]
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=LIGHT))
    substrate = op.Material(op.Parameter("n"), op.Parameter("k"))
    path.add("stack", op.LayerStack([*media, substrate], op.Parameter("angle")))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "stack.in")
    path.connect(f"stack.{PORTS[what]}", "eye.in")
    return path


def slab(what):
    """Two boundaries between which light goes round."""
    path = op.PathGraph(loops="sum")
    first, layer = op.Parameter("n0"), op.Parameter("n1")
    substrate = op.Material(op.Parameter("n"), op.Parameter("k"))
    angle = op.Parameter("angle")
    path.add("lamp", op.Source(stokes=LIGHT))
    path.add("front", op.Interface(layer, angle, outside=first))
    path.add("back", op.Interface(substrate, angle, outside=layer, incidence_in=first))
    path.add("eye", op.Detector())
    path.connect("lamp.out", "front.in")
    path.connect("front.transmitted", "back.in")
    path.connect("back.reflected", "front.back")
    path.connect("front.reflected" if what == "reflection" else "back.transmitted", "eye.in")
    return path


def slopes(plan, names, points, derivative):
    """The slopes of the Stokes vector at several points, (points, arguments, 4)."""

    def stokes(*given):
        return plan.run(**dict(zip(names, given, strict=True))).stokes

    function = derivative(stokes, argnums=tuple(range(len(names))))
    found = jax.jit(jax.vmap(function))(*np.array(points).T)
    return np.stack(found, axis=1)


def agree(found, expected, points, limit=1e-10):
    scale = np.maximum(1.0, np.abs(expected).max(axis=-1, keepdims=True))
    apart = np.abs(found - expected) / scale
    worst = np.unravel_index(np.argmax(np.where(np.isnan(apart), np.inf, apart)), apart.shape)
    said = (
        f"argument {worst[1]} at {points[worst[0]]}: {found[worst[:2]]}, not {expected[worst[:2]]}"
    )
    assert apart[worst] <= limit, said


def apart_from_critical(n1, n, k, angle):
    return k > 0.0 or (abs(n - n1 * np.sin(angle)) > 1e-3)


def singular_points(seed):
    """Every edge and singular point of one boundary, with random partners."""
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(3):
        n1, n, k = rng.uniform(1.0, 2.0), rng.uniform(0.2, 4.0), rng.uniform(0.01, 5.0)
        angle = rng.uniform(0.1, 1.5)
        brewster = float(np.arctan2(n, n1))
        for each in (0.0, angle, brewster, 1e-9, np.pi / 2 - 1e-9, np.pi / 2):
            found += [(n1, n, 0.0, each), (n1, n, k, each), (n1, 0.0, k, each)]
            if each < 1.57:
                found.append((n1, n1, 0.0, each))
            if each > 0.0:
                found.append((n1, 0.0, 0.0, each))
            found += [(n1, n1, k, each), (n1, n1 * (1.0 + 1e-9), 0.0, each)]
        total = rng.uniform(1.05 * n1 / 4.0, 0.9) if n1 < 2.0 else 0.9
        found.append((n1, n1 * np.sin(total) * 0.9, 0.0, total))
    return [point for point in found if apart_from_critical(*point)]


POINTS = [*singular_points(1), (1.0, 1.5, 0.0, np.pi / 2), (1.0, 0.2, 3.0, np.pi / 2)]
NAMES = ("n1", "n", "k", "angle")


@pytest.mark.parametrize("what", ["reflection", "transmission"])
@pytest.mark.parametrize("method", METHODS)
def test_slopes_are_those_of_many_digits_at_every_singular_point(what, method):
    plan = op.Composer(method=method).compose(surface(what))
    expected = np.array([differences(one_boundary(what), point) for point in POINTS])
    agree(slopes(plan, NAMES, POINTS, jax.jacfwd), expected, POINTS)


@pytest.mark.parametrize("composing", ["stokes", "jones"])
@pytest.mark.parametrize("what", ["reflection", "transmission"])
def test_slopes_backwards_are_those_of_many_digits_too(what, composing):
    points = singular_points(2)
    plan = op.Composer(composing=composing).compose(surface(what))
    expected = np.array([differences(one_boundary(what), point) for point in points])
    agree(slopes(plan, NAMES, points, jax.jacrev), expected, points)
