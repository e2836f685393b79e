"""Angles that formulas are given: of any quadrant, turned back, and as pairs."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from tables import rows

SEEN = [1.0, 1.0, 0.0, 0.0]


class Turning(op.Element):
    """A rotator that asks for the cosine and sine of twice its angle itself."""

    turn: op.Angle

    @staticmethod
    def mueller_rows(xp, turn):
        c, s = xp.cos(2.0 * turn), xp.sin(2.0 * turn)
        return (1.0, 0.0, 0.0, 0.0), (0.0, c, -s, 0.0), (0.0, s, c, 0.0), (0.0, 0.0, 0.0, 1.0)


def every_way(element, **given):
    """The light of a batch by a formula, and of single runs, of which the later are compiled."""
    plan = op.Composer(engine="numpy").compose(chain([element], SEEN))
    count = 2000
    many = {name: repeated(value, count) for name, value in given.items()}
    return [plan.run(**many).stokes[-1], *(plan.run(**given).stokes for _ in range(5))]


def repeated(value, count):
    if isinstance(value, op.CosSin):
        return op.CosSin(np.full(count, value.cos), np.full(count, value.sin))
    return np.full(count, value)


@rows("sign", [1, -1])
@rows("rotator", [op.Rotator, Turning])
@rows("angle", [0.3, 1.2, 2.0, -0.7])
def test_an_angle_and_its_pair_turn_light_alike(rotator, sign, angle):
    parameter = op.Parameter("a") if sign > 0 else -op.Parameter("a")
    pair = op.CosSin(float(np.cos(angle)), float(np.sin(angle)))
    expected = [1.0, np.cos(2 * angle), sign * np.sin(2 * angle), 0.0]
    for given in (angle, pair):
        for stokes in every_way(rotator(parameter), a=given):
            np.testing.assert_allclose(stokes, expected, rtol=0, atol=1e-15)


@pytest.mark.filterwarnings("ignore::optipath.AngleWarning")  # Of each run, as one test says.
@rows("most", [1.5, 3.0, 6.0, 1e3])
@rows("least", [0.0, -1.0])
def test_angles_up_to_any_limit_are_right(least, most):
    angles = np.linspace(least, most, 3001)
    limits = {"minimum": f"{least} rad", "maximum": f"{most} rad"}
    polarizer = op.Polarizer(op.Parameter("a", **limits))
    plan = op.Composer(engine="numpy").compose(chain([polarizer], SEEN))
    expected = np.cos(angles) ** 2
    if most > 2 * np.pi:
        with pytest.warns(op.AngleWarning, match="parameter 'a' is a plain number"):
            plan.run(a=angles)
    np.testing.assert_allclose(plan.run(a=angles).intensity, expected, rtol=0, atol=1e-15)
    for place in (0, 7, 1000, 1500, 2000, 2900, 3000):
        found = plan.run(a=float(angles[place])).intensity
        np.testing.assert_allclose(found, expected[place], rtol=0, atol=1e-15)
