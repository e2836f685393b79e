"""Slopes of media, against exact ones of the matrix exponential."""

import mpmath
import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

jax = pytest.importorskip("jax")

pytestmark = pytest.mark.filterwarnings("ignore::optipath.AngleWarning")

STATE = (1.0, 0.5, 0.6, 0.4)
NAMES = ("absorption", "dichroism", "circular_dichroism", "retardance", "rotation")


@pytest.fixture(autouse=True)
def _double():
    jax.config.update("jax_enable_x64", True)  # noqa: FBT003 - as JAX has it
    with mpmath.workdps(40):
        yield
    jax.config.update("jax_enable_x64", False)  # noqa: FBT003 - ditto


def generator(values, dichroic_angle):
    """What a medium with its fast axis along x does per length."""
    a, linear, p3, q1, rotation, d = (*map(mpmath.mpf, values), 0)[:6]
    p1, p2 = (linear * part(2 * mpmath.mpf(dichroic_angle)) for part in (mpmath.cos, mpmath.sin))
    q3, d = 2 * rotation, a + d
    return mpmath.matrix([[-a, p1, p2, p3], [p1, -d, -q3, 0], [p2, q3, -d, -q1], [p3, 0, q1, -d]])


def exact_slopes(values, dichroic_angle):
    """By the exponential of a matrix of blocks (Van Loan, IEEE Trans. 23, 395 (1978))."""
    whole, found = generator(values, dichroic_angle), []
    for place in range(len(values)):
        step = generator([float(place == one) for one in range(len(values))], dichroic_angle)
        blocks = mpmath.zeros(8)
        for i in range(4):
            for j in range(4):
                blocks[i, j] = blocks[i + 4, j + 4] = whole[i, j]
                blocks[i, j + 4] = step[i, j]
        slope = mpmath.expm(blocks, method="taylor")[:4, 4:]
        found.append([float(part) for part in slope * mpmath.matrix(STATE)])
    return np.array(found).T


POINTS = {
    "anywhere": (4.0, 2.0, 1.0, 3.0, -1.5),
    "at no effect at all": (1.0, 0.0, 0.0, 0.0, 0.0),
    "without dichroism": (1.0, 0.0, 0.0, 2.0, 0.7),
    "without retardance": (3.0, 1.0, -2.0, 0.0, 0.0),
    "linear dichroism alone": (3.0, 2.0, 0.0, 0.0, 0.0),
    "both parallel": (3.0, 2.0, 0.0, 4.0, 0.0),
    "both of one size": (3.0, 2.0, 0.0, 2.0, 0.0),
    "across, of one size": (3.0, 2.0, 0.0, 0.0, 1.0),
    "at the least absorption": (2.0, 2.0, 0.0, 0.3, 0.0),
    "tiny": (1.0, 1e-9, 2e-9, 3e-9, 4e-9),
    "large": (50.0, 30.0, 20.0, 50.0, 25.0),
}


def check_slopes(point, depolarization):
    values = POINTS[point] + (() if depolarization is None else (depolarization,))
    names = NAMES + (() if depolarization is None else ("depolarization",))
    parameters = {name: op.Parameter(name) for name in names}
    plan = chain([op.Medium(1.0, **parameters, dichroic_angle=0.3)], STATE).compose()

    def light(*given):
        return plan.run(**dict(zip(names, given, strict=True))).stokes

    slopes = np.array(jax.jacfwd(light, argnums=tuple(range(len(values))))(*values)).T
    wanted = exact_slopes(values, 0.3)
    np.testing.assert_allclose(slopes, wanted, rtol=0, atol=2e-13 * np.max(np.abs(wanted)))


@rows("point", POINTS)
def test_slopes_are_those_of_the_exponential(point):
    check_slopes(point, None)


@pytest.mark.slow
@pytest.mark.parametrize("depolarization", [0.0, 1.3])
def test_slopes_of_what_may_depolarise_are_those_of_the_exponential(depolarization):
    for point in POINTS:
        check_slopes(point, depolarization)


AT_ZERO = {
    "linear": {"absorption": 1.0, "dichroism": "d"},
    "linear, retarding": {"absorption": 1.0, "dichroism": "d", "retardance": 2.0},
    "circular": {"absorption": 1.0, "circular_dichroism": "d"},
    "circular, rotating": {"absorption": 1.0, "circular_dichroism": "d", "rotation": 0.7},
    "two axes": {"absorption": 1.0, "dichroism": "d", "retardance": 2.0, "dichroic_angle": 0.3},
    "rotating": {"absorption": 1.0, "dichroism": "d", "rotation": 0.7},
    "linear, depolarising": {"absorption": 1.0, "dichroism": "d", "depolarization": 0.4},
    "circular, depolarising": {"absorption": 1.0, "circular_dichroism": "d", "depolarization": 0.4},
    "far": {"absorption": 60.0, "dichroism": "d", "rotation": 0.7},
}

LONG = {kind for kind, given in AT_ZERO.items() if {"depolarization", "rotation"} & {*given}}
"""JAX compiles them for long."""


def exact_light(rates, length):
    rates = {**dict.fromkeys((*NAMES, "depolarization"), 0.0), **rates}
    whole = generator([rates[name] for name in (*NAMES, "depolarization")], rates["dichroic_angle"])
    return mpmath.expm(whole * length, method="taylor") * mpmath.matrix(STATE)


def exact_slope(light, at):
    """By central differences in 60 digits."""
    step = mpmath.mpf(10) ** -20
    found = (light(at + step) - light(at - step)) / (2 * step)
    return [float(part) for part in found]


def check_slopes_at_zero(kind, *, together):
    rates = {"dichroic_angle": 0.0, **AT_ZERO[kind]}
    given = {k: op.Parameter("d") if v == "d" else v for k, v in rates.items()}
    plan = chain([op.Medium(op.Parameter("L"), **given)], STATE).compose()

    def light(d, length):
        return plan.run(d=d, L=length).stokes

    def exact(d, length):
        return exact_light({k: d if v == "d" else v for k, v in rates.items()}, length)

    points = np.array([[0.0, 1.0], [0.0, 0.0], [0.8, 0.0], [-0.8, 0.0], [-0.8, 1.0]])
    slopes_of = jax.jacfwd(light, argnums=(0, 1))
    if together:
        found = jax.vmap(slopes_of)(*points.T)
    else:
        found = np.swapaxes([slopes_of(*point) for point in points], 0, 1)
    with mpmath.workdps(60):
        wanted = [
            [exact_slope(lambda x, length=length: exact(x, length), d) for d, length in points],
            [exact_slope(lambda x, d=d: exact(d, x), length) for d, length in points],
        ]
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-13 * max(1.0, np.abs(wanted).max()))


@rows("kind", [*{*AT_ZERO} - LONG])
def test_slopes_at_no_dichroism_and_no_length_are_right(kind):
    check_slopes_at_zero(kind, together=False)


@pytest.mark.slow
@pytest.mark.parametrize("kind", AT_ZERO)
def test_slopes_there_are_right_whatever_else_it_does_and_of_many_at_once(kind):
    check_slopes_at_zero(kind, together=True)
