"""What does not depolarise, taken apart however little of the light it lets through."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from random_matrices import bordered, jones, of_jones, parts, turn, unit_vectors
from tables import rows

ANGLES = np.linspace(0.1, 1.4, 200)
NEAR = [0.05, 1e-2, 1e-3, 1e-4, 1e-5]


def product(found):
    return (found.depolarizer @ found.retarder @ found.diattenuator).matrix


def nearly_crossed(e):
    return op.Polarizer(ANGLES + np.pi / 2 - e).mueller() @ op.Polarizer(ANGLES).mueller()


@rows("e", NEAR)
def test_polarisers_nearly_crossed_depolarise_nothing_and_turn_least(e):
    matrix = nearly_crossed(e)
    found = matrix.lu_chipman()
    np.testing.assert_array_equal(found.depolarizer.matrix, np.broadcast_to(np.eye(4), (200, 4, 4)))
    rounding = 1e-15 / e**2
    np.testing.assert_allclose(found.diattenuation, 1.0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.retardance, np.pi - 2 * e, rtol=0, atol=rounding)
    np.testing.assert_allclose(matrix.retardance, found.retardance)
    over = matrix.matrix[:, :1, :1]
    np.testing.assert_allclose(product(found) / over, matrix.matrix / over, rtol=0, atol=rounding)


@rows("e", NEAR)
@rows("retardance", [0.5, 1.5, 3.0])
def test_a_retarder_between_polarisers_near_extinction_does_not_depolarise(e, retardance):
    between = op.Retarder(retardance, ANGLES + e).mueller()
    last = op.Polarizer(ANGLES + np.pi / 2 - e).mueller()
    found = (last @ between @ op.Polarizer(ANGLES).mueller()).lu_chipman()
    np.testing.assert_array_equal(found.depolarization, 0.0)
    np.testing.assert_allclose(found.diattenuation, 1.0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.retardance, np.pi - 2 * e, rtol=0, atol=1e-14 / e**2)


@rows("e", NEAR)
def test_a_depolariser_behind_polarisers_nearly_crossed_keeps_its_degree(e):
    depolarizer = op.Mueller(np.diag([1.0, 0.6, 0.6, 0.6]))
    found = (depolarizer @ nearly_crossed(e)).lu_chipman()
    np.testing.assert_allclose(found.depolarization, 0.4, rtol=0, atol=1e-15 / e**2)
    np.testing.assert_allclose(found.retardance, np.pi - 2 * e, rtol=0, atol=1e-15 / e**2)


@given(seed=st.integers(0, 10**6), gap=st.floats(0.0, 12.0))
def test_a_jones_matrix_near_a_polariser_keeps_its_turn(seed, gap):
    rng = np.random.default_rng(seed)
    axis, angle = unit_vectors(rng, 1)[0], rng.uniform(0.0, np.pi)
    along = unit_vectors(rng, 1)[0]
    # Of the state that is blocked, so much passes: 1 - D is 2 p / (1 + p).
    p = 10.0**-gap
    D, a = (1 - p) / (1 + p), 2 * np.sqrt(p) / (1 + p)
    lower = a * np.eye(3) + (1 - a) * np.outer(along, along)
    matrix = bordered(turn(axis, angle)) @ bordered(lower, D * along, D * along)
    found = op.Mueller(matrix).lu_chipman()
    np.testing.assert_array_equal(found.depolarization, 0.0)
    np.testing.assert_allclose(
        found.retarder.matrix[1:, 1:], turn(axis, angle), rtol=0, atol=1e-14 / a
    )
    np.testing.assert_allclose(product(found), matrix, rtol=0, atol=1e-14)


@rows("scale", [1e-300, 1e-12, 1.0, 1e300])
def test_no_scale_makes_a_depolariser_pure_or_takes_from_what_is(scale):
    rng = np.random.default_rng(8)
    depolarizer, retarder, first = parts(rng, 200)
    slight = np.diag([1.0, *(1.0 - np.array([1e-5, 2e-5, 3e-5]))])
    found = op.Mueller(scale * (slight @ retarder @ first)).lu_chipman()
    np.testing.assert_allclose(found.depolarization, 2e-5, rtol=0, atol=1e-11)
    found = op.Mueller(scale * (depolarizer @ retarder @ first)).lu_chipman()
    np.testing.assert_allclose(found.depolarizer.matrix, depolarizer, rtol=0, atol=1e-12)
    matrices = of_jones(jones(rng, 200))
    found = op.Mueller(scale * matrices).lu_chipman()
    np.testing.assert_array_equal(found.depolarization, 0.0)
    np.testing.assert_allclose(product(found) / scale, matrices, rtol=0, atol=1e-13)


def test_the_rounding_of_single_precision_does_not_depolarise():
    elements = [op.Polarizer(0.3), op.Retarder(1.0, 0.2), op.Interface(0.6 + 2.1j, 0.8)]
    matrices = np.stack([element.mueller().matrix for element in elements])
    found = op.Mueller(matrices.astype(np.float32)).lu_chipman()
    np.testing.assert_array_equal(found.depolarization, 0.0)
    np.testing.assert_allclose(found.retardance, op.Mueller(matrices).retardance, rtol=0, atol=1e-6)
