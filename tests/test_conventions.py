"""What docs/conventions.md says of signs, held against fields and rays in space."""

import numpy as np
import pytest

import optipath as op
from paths import chain
from random_matrices import jones, of_jones, turn
from tables import rows

X, Y, Z = np.eye(3)
MIRRORED = np.diag([1.0, 1.0, -1.0, 1.0])


def stokes_in(field, x, y):
    ex, ey = field @ x, field @ y
    across = np.conj(ex) * ey
    powers = abs(ex) ** 2, abs(ey) ** 2
    return np.array([sum(powers), powers[0] - powers[1], 2 * across.real, 2 * across.imag])


def field_of(stokes):
    """A field along z of fully polarised light."""
    s0, s1, s2, s3 = stokes
    ex = np.sqrt(0.5 * (s0 + s1))
    return ex * X + 0.5 * (s2 + 1j * s3) / ex * Y


def states(seed, count=20):
    found = np.random.default_rng(seed).normal(size=(count, 3))
    found /= np.linalg.norm(found, axis=-1, keepdims=True)
    return np.concatenate([np.ones((count, 1)), found], axis=-1)


def test_the_s3_of_born_and_wolf_has_the_other_sign():
    for state in states(1):
        field = field_of(state)
        # Sec. 1.4.2: E_i = a_i cos(w t - k z + delta_i), s3 = 2 a1 a2 sin(delta2 - delta1).
        (a1, a2), (delta1, delta2) = abs(field[:2]), -np.angle(field[:2])
        assert 2 * a1 * a2 * np.sin(delta2 - delta1) == pytest.approx(-state[3], abs=1e-14)


@rows("stokes", [[1, 0, 0, 1], [1, 0, 0.6, 0.8], [1, 0, 0, -1]])
def test_s3_above_0_is_right_handed_to_ieee_and_left_handed_to_hecht(stokes):
    times = np.linspace(0.0, 2.0 * np.pi, 100)
    field = np.real(np.exp(-1j * times)[:, np.newaxis] * field_of(stokes))
    swept = np.cross(field[:-1], field[1:])
    handedness = int(op.Light(stokes).handedness)
    # IEEE: the thumb of the right hand along the light, z.
    assert np.all(np.sign(swept @ Z) == handedness)
    # Hecht: clockwise to who looks at the source, along -z, is right-handed.
    assert np.all(np.sign(swept @ -Z) == -handedness)


def plate_in_space(angle):
    """A retarder of 1.3 rad that stands in space, whichever way light goes."""
    fast = np.cos(angle) * X + np.sin(angle) * Y
    slow = np.cross(Z, fast)

    def act(field, _way):
        return fast * (fast @ field) + np.exp(1.3j) * slow * (slow @ field)

    return act


def sugar_in_space(angle):
    """A screw, clockwise to who looks at the source: the same to light of either way."""
    return lambda field, way: turn(way, -angle) @ field


def faraday_in_space(angle):
    """A rotation about a magnetic field along z."""
    return lambda field, _way: turn(Z, angle) @ field


def plate(angle):
    return op.Retarder(1.3, angle)


def sugar(angle):
    return op.Medium(0.5, dextrorotation=2.0 * angle)


@rows("seed", range(20))
@rows(
    "in_space, element, sign_back",
    [(plate_in_space, plate, -1), (sugar_in_space, sugar, 1), (faraday_in_space, op.Rotator, -1)],
)
def test_what_light_meets_before_and_behind_a_mirror_is_entered_as_the_docs_say(
    in_space, element, sign_back, seed
):
    angle = np.random.default_rng(seed).uniform(-3, 3)
    act, (state,) = in_space(angle), states(seed, 1)
    once = act(field_of(state), Z)
    # An ideal mirror leaves no field along it; behind it, y and z turn over.
    twice = act(-once, -Z)
    elements = [element(angle), op.Mirror(), element(sign_back * angle)]
    light, back = chain(elements[:1], state).trace(), chain(elements, state).trace()
    np.testing.assert_allclose(light.stokes, stokes_in(once, X, Y), rtol=0, atol=1e-14)
    np.testing.assert_allclose(back.stokes, stokes_in(twice, X, -Y), rtol=0, atol=1e-14)


def test_two_quarter_wave_plates_at_one_angle_are_no_half_wave_plate_behind_a_mirror():
    plate, mirror = op.Retarder(np.pi / 2, np.pi / 8), op.Mirror()
    half = mirror.mueller() @ op.Retarder(np.pi, np.pi / 8).mueller()
    same = plate.mueller() @ mirror.mueller() @ plate.mueller()
    turned = op.Retarder(np.pi / 2, -np.pi / 8).mueller() @ mirror.mueller() @ plate.mueller()
    np.testing.assert_allclose(turned.matrix, half.matrix, rtol=0, atol=1e-15)
    assert np.abs(same.matrix - half.matrix).max() > 0.9


@rows("seed", range(10))
def test_a_reciprocal_element_met_the_other_way_is_transposed_and_mirrored(seed):
    # Of a Jones matrix T between fields along x and y, reciprocity asks for T transposed on the
    # way back (Jones, 1941), y having turned over.
    T = jones(np.random.default_rng(seed))
    over = np.diag([1.0, -1.0])
    back = of_jones(over @ T.T @ over)
    np.testing.assert_allclose(back, MIRRORED @ of_jones(T).T @ MIRRORED, rtol=0, atol=1e-13)
    for element, again in (
        (op.Retarder(0.7, 0.4), op.Retarder(0.7, -0.4)),
        (op.Rotator(0.3), op.Rotator(0.3)),
        (op.Polarizer(0.4, leakage=0.2), op.Polarizer(-0.4, leakage=0.2)),
    ):
        there = element.mueller().matrix
        expected = MIRRORED @ there.T @ MIRRORED
        np.testing.assert_allclose(again.mueller().matrix, expected, rtol=0, atol=1e-15)


@rows("n1, n2", [(1.0, 1.5), (1.5, 1.0), (1.33, 1.7)])
def test_a_boundary_lets_power_through_and_radiance_times_the_squared_ratio_of_indices(n1, n2):
    limit = np.arcsin(min(1.0, n2 / n1))
    angle, width = 0.6 * limit, 1e-6
    edges = np.array([angle - width, angle + width])
    A, _, _, _ = op.fresnel_transmission(n2 / n1, np.cos(angle), np.sin(angle))
    # A cone of rays of radiance 1: its power through one unit of area, before and behind.
    before, behind = (
        np.diff(np.sin(t) ** 2)[0] for t in (edges, op.refraction_angle(n2, edges, n1))
    )
    radiance = A * (n2 / n1) ** 2
    assert radiance * behind == pytest.approx(A * before, rel=1e-8)
    power = op.Interface(n2, angle, outside=n1).mueller("in", "transmitted").matrix[0, 0]
    reflected = op.Interface(n2, angle, outside=n1).mueller().matrix[0, 0]
    assert power == pytest.approx(A, rel=1e-14)
    assert power + reflected == pytest.approx(1.0, rel=1e-15)
