"""Lu and Chipman's parts of any matrix, and of what does not depolarise, however dim."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import optipath as op
from random_matrices import bordered, diattenuator, jones, of_jones, parts, turn, unit_vectors
from tables import rows

FINITE = st.floats(allow_nan=False, allow_infinity=False)
AWKWARD = st.sampled_from([0.0, -0.0, 1.0, -1.0, 1e-9, 5e-324, 1e300, 1.7e308, -1.7e308])
FIGURES = ["diattenuation", "retardance", "retardance_vector", "fast_axis", "depolarization"]


def product(found):
    return (found.depolarizer @ found.retarder @ found.diattenuator).matrix


def is_rotation(matrices):
    r = matrices[..., 1:, 1:]
    np.testing.assert_allclose(r @ np.swapaxes(r, -1, -2) - np.eye(3), 0.0, rtol=0, atol=1e-13)
    np.testing.assert_allclose(np.linalg.det(r), 1.0, rtol=1e-13)
    np.testing.assert_array_equal(matrices[..., 0, :] - [1.0, 0, 0, 0], 0.0)


@rows("scale", [1e-300, 1e-160, 1e-12, 1.0, 1e160, 1e300])
def test_the_parts_of_a_product_come_back_and_no_scale_makes_them_pure(scale):
    rng = np.random.default_rng(4)
    depolarizer, retarder, first = parts(rng, 500)
    found = op.Mueller(scale * (depolarizer @ retarder @ first)).lu_chipman()
    np.testing.assert_allclose(found.depolarizer.matrix, depolarizer, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.retarder.matrix, retarder, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.diattenuator.matrix / scale, first, rtol=0, atol=1e-13)
    slight = np.diag([1.0, *(1.0 - np.array([1e-5, 2e-5, 3e-5]))])
    found = op.Mueller(scale * (slight @ retarder @ first)).lu_chipman()
    np.testing.assert_allclose(found.depolarization, 2e-5, rtol=0, atol=1e-11)
    matrices = of_jones(jones(rng, 500))
    found = op.Mueller(scale * matrices).lu_chipman()
    np.testing.assert_array_equal(found.depolarization, 0.0)
    np.testing.assert_allclose(product(found) / scale, matrices, rtol=0, atol=1e-13)


@given(seed=st.integers(0, 10**6), power=st.integers(-290, 290))
def test_the_figures_are_those_of_the_parts(seed, power):
    rng = np.random.default_rng(seed)
    axis, angle, size = unit_vectors(rng, 1)[0], rng.uniform(0, np.pi), rng.uniform(0, 0.99)
    along = unit_vectors(rng, 1)[0]
    first = diattenuator(size * along)
    matrix = np.diag([1.0, 0.9, 0.6, 0.3]) @ bordered(turn(axis, angle)) @ first
    found = op.Mueller(10.0**power * matrix).lu_chipman()
    assert found.diattenuation == pytest.approx(size, abs=1e-14)
    np.testing.assert_allclose(found.diattenuation_vector, size * along, rtol=0, atol=1e-14)
    assert found.retardance == pytest.approx(angle, abs=1e-11)
    np.testing.assert_allclose(np.sin(angle) * (found.fast_axis - axis), 0.0, rtol=0, atol=1e-11)
    assert found.depolarization == pytest.approx(0.4, abs=1e-12)
    np.testing.assert_allclose(found.polarizance_vector, 0.0, rtol=0, atol=1e-12)


@rows("retardance", [1e-9, 0.3, np.pi / 2, 3.0, np.pi - 1e-9, np.pi])
@rows("angle", [0.0, 0.5, -1.2])
def test_a_retarder_has_its_retardance_and_its_fast_axis(retardance, angle):
    found = op.Retarder(retardance, angle).mueller().lu_chipman()
    axis = [np.cos(2 * angle), np.sin(2 * angle), 0.0]
    assert found.retardance == pytest.approx(retardance, rel=1e-14, abs=1e-15)
    # A half-wave plate has two fast axes, and where little is retarded the matrix knows little.
    sign = np.sign(found.fast_axis @ axis) if retardance == np.pi else 1.0
    slack = 1e-15 / min(retardance, 1.0)
    np.testing.assert_allclose(sign * found.fast_axis, axis, rtol=0, atol=slack)
    np.testing.assert_allclose(found.retardance_vector, found.fast_axis * found.retardance)
    assert found.diattenuation == 0.0
    assert found.depolarization == pytest.approx(0.0, abs=1e-15)


@given(angle=st.floats(-1.5, 1.5))
def test_a_rotator_is_a_circular_retarder_of_twice_its_angle(angle):
    matrix = op.Rotator(angle).mueller()
    assert matrix.retardance == pytest.approx(2 * abs(angle), rel=1e-14)
    if matrix.retardance:
        np.testing.assert_allclose(matrix.lu_chipman().fast_axis, [0.0, 0.0, np.sign(angle)])


@rows("incidence", [0.1, 0.8, 1.4])
def test_a_metal_retards_s_against_p_and_diattenuates(incidence):
    m, c, s = 0.6 + 2.1j, np.cos(incidence), np.sin(incidence)
    g = np.sqrt(m**2 - s**2)
    rs, rp = (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)
    fs, fp = abs(rs) ** 2, abs(rp) ** 2
    metal = op.Interface(m, incidence).mueller()
    assert metal.retardance == pytest.approx(abs(np.angle(rp / rs)), rel=1e-13)
    assert metal.retardance == pytest.approx(metal.delta, rel=1e-13)
    assert metal.lu_chipman().diattenuation == pytest.approx((fs - fp) / (fs + fp), rel=1e-13)


def test_parts_stand_in_the_frames_of_their_light_and_are_known_apart():
    numbers = op.Interface(0.6 + 2.1j, 0.8).mueller().matrix
    before, behind = op.Frame().turned(0.3), op.Frame.from_direction((1, 0, 0), (0, 1, 0))
    metal = op.Mueller(numbers, before, behind)
    found = metal.lu_chipman()
    for part, frames in (
        (found.diattenuator, (before, before)),
        (found.retarder, (before, behind)),
        (found.depolarizer, (behind, behind)),
    ):
        assert (part.frame_in, part.frame_out) == frames
    np.testing.assert_allclose(product(found), metal.matrix, rtol=0, atol=1e-15)
    matrix = op.Mueller(np.diag([1.0, 0.3, 0.2, 0.1])) @ op.Polarizer().mueller()
    found = matrix.lu_chipman()
    assert found.depolarization == pytest.approx(0.7, abs=1e-15)
    np.testing.assert_allclose(product(found), matrix.matrix, rtol=0, atol=1e-15)
    blind = (op.Mueller(np.diag([1.0, 0, 0, 0])) @ op.Polarizer(0.3).mueller()).lu_chipman()
    np.testing.assert_array_equal(blind.retarder.matrix, np.eye(4))
    assert (blind.diattenuation, blind.depolarization) == (1.0, 1.0)
    matrices = np.stack([np.eye(4)] * 3)
    matrices[1, 3], matrices[2, 0, 0] = np.nan, np.inf
    found = op.Mueller(matrices).lu_chipman()
    for part in (found.depolarizer, found.retarder, found.diattenuator):
        np.testing.assert_array_equal(np.isnan(part.matrix).all(axis=(1, 2)), [False, True, True])
    for name in FIGURES:
        values = getattr(found, name).reshape(3, -1)
        np.testing.assert_array_equal(np.isnan(values).all(axis=1), [False, True, True])


@rows("first, second", [(0.0, 0.0), (0.2, 0.9), (0.0, np.pi / 2), (1.0, -1)])
def test_a_polariser_retards_by_the_least_turn_between_its_states(first, second):
    matrix = op.Rotator(second - first).mueller() @ op.Polarizer(first).mueller()
    found = matrix.lu_chipman()
    least = abs(np.angle(np.exp(2j * (second - first))))
    figures = found.diattenuation, found.retardance, found.depolarization
    assert figures == (1.0, pytest.approx(least, abs=1e-14), pytest.approx(0.0, abs=1e-14))
    np.testing.assert_allclose(product(found), matrix.matrix, rtol=0, atol=1e-15)


@given(seed=st.integers(0, 10**6), gap=st.floats(0.0, 16.0))
def test_polarisers_however_near_ideal_still_make_up_their_matrix(seed, gap):
    rng = np.random.default_rng(seed)
    depolarizer, retarder, _ = parts(rng, 20, least=0.0)
    last = np.array([diattenuator((1 - 10.0**-gap) * v) for v in unit_vectors(rng, 20)])
    matrix = depolarizer @ retarder @ last
    found = op.Mueller(matrix).lu_chipman()
    is_rotation(found.retarder.matrix)
    np.testing.assert_allclose(found.diattenuator.matrix, last, rtol=0, atol=2e-7)
    # Of sqrt(1 - D^2), the matrix has so many digits.
    np.testing.assert_allclose(product(found), matrix, rtol=0, atol=3e-14 * 10 ** (gap / 2))


@rows("left", [(0.5, 0.3, 0.0), (0.5, 0.0, 0.0), (0.0, 0.0, 0.0)])
def test_a_depolariser_that_leaves_fewer_axes_is_found(left):
    rng = np.random.default_rng(5)
    for axis, angle in zip(unit_vectors(rng, 50), rng.uniform(0, np.pi, 50), strict=True):
        depolarizer = np.diag([1.0, *left])
        retarder = bordered(turn(axis, angle))
        matrix = depolarizer @ retarder @ diattenuator(0.5 * unit_vectors(rng, 1)[0])
        found = op.Mueller(matrix).lu_chipman()
        np.testing.assert_allclose(found.depolarizer.matrix, depolarizer, rtol=0, atol=1e-14)
        np.testing.assert_allclose(product(found), matrix, rtol=0, atol=1e-14)
        is_rotation(found.retarder.matrix)
        if np.count_nonzero(left) == 2:
            np.testing.assert_allclose(found.retarder.matrix, retarder, rtol=0, atol=1e-13)
        else:
            assert found.retardance <= angle + 1e-13, "the least turn"


def test_axes_of_depolarisers_keep_their_sign_and_turn_by_no_rounding():
    # Lu and Chipman put the sign of the determinant before the whole root.
    matrix = np.diag([1.0, 0.3, 0.4, -0.5]) @ bordered(turn((0.0, 0.6, 0.8), 0.7))
    found = op.Mueller(matrix).lu_chipman()
    left = np.diag([1, -0.3, -0.4, -0.5])
    np.testing.assert_allclose(found.depolarizer.matrix, left, rtol=0, atol=1e-15)
    np.testing.assert_allclose(product(found), matrix, rtol=0, atol=1e-15)
    is_rotation(found.retarder.matrix)
    found = op.Mueller(np.diag([1.0, 0.5, 0.4, -1e-17])).lu_chipman()
    assert found.retardance == 0.0
    assert found.depolarization == pytest.approx(0.7)
    found = op.Retarder(3e-200).mueller().lu_chipman()
    assert found.retardance == pytest.approx(3e-200, rel=1e-14, abs=0.0)
    np.testing.assert_array_equal(found.fast_axis, [1.0, 0.0, 0.0])


@given(matrix=arrays(np.float64, (4, 4), elements=FINITE | AWKWARD))
def test_no_finite_matrix_makes_a_nan_or_a_warning(matrix):
    given = op.Mueller(matrix)
    found = given.lu_chipman()
    for part in (found.depolarizer, found.retarder, found.diattenuator):
        assert np.isfinite(part.matrix).all()
    is_rotation(found.retarder.matrix)
    assert 0.0 <= found.diattenuation <= 1.0 + 1e-15
    assert 0.0 <= found.retardance <= np.pi
    for name in ("diattenuation", "polarizance", "depolarization_index"):
        assert not np.isnan(getattr(given, name)), name
    assert not np.isnan(given.cloude_eigenvalues).any()
    assert given.is_physical() in (True, False)


@given(
    matrix=arrays(np.float64, (4, 4), elements=st.sampled_from([0.0, 1.0, -1.0, 0.5, 1e-17, 1e-8])),
    m00=st.sampled_from([1.0, 2.0, 1e-9]),
)
def test_matrices_of_few_numbers_make_up_themselves_where_the_diattenuation_allows(matrix, m00):
    matrix[0, 0] = m00
    found = op.Mueller(matrix).lu_chipman()
    is_rotation(found.retarder.matrix)
    size = np.linalg.norm(matrix[0, 1:]) / m00
    if size < 1 - 1e-3:
        np.testing.assert_allclose(product(found), matrix, rtol=0, atol=1e-11)


@rows("noise", [1e-16, 1e-12, 1e-3, 0.1])
def test_noise_on_elements_is_borne(noise):
    rng = np.random.default_rng(6)
    elements = [op.Polarizer(0.3), op.Retarder(np.pi, 0.2), op.Interface(1.5, np.arctan(1.5))]
    plain = np.stack([element.mueller().matrix for element in elements])
    noisy = plain + noise * rng.normal(size=(1000, 3, 4, 4))
    found = op.Mueller(noisy).lu_chipman()
    is_rotation(found.retarder.matrix)
    for name in FIGURES:
        assert np.isfinite(getattr(found, name)).all(), name
    assert np.abs(found.retardance[:, 1] - np.pi).max() < 20 * noise + 1e-14


def test_what_is_dark_has_no_parts_and_every_batch_and_precision_is_taken_apart_in_double():
    found = op.Mueller(np.zeros((4, 4))).lu_chipman()
    np.testing.assert_array_equal(found.diattenuator.matrix, 0.0)
    np.testing.assert_array_equal([found.retarder, found.depolarizer], [np.eye(4)] * 2)
    assert found.diattenuation == found.retardance == found.depolarization == 0.0
    assert op.Mueller(np.diag([1.0, 0.0, 0.0, 0.0])).retardance == 0.0
    for batch in ((), (5,), (2, 1, 0)):
        found = op.Mueller(np.ones((*batch, 4, 4))).lu_chipman()
        for name in FIGURES:
            tail = (3,) if name in ("retardance_vector", "fast_axis") else ()
            assert getattr(found, name).shape == (*batch, *tail), name
    for dtype in (np.float32, np.float64, np.longdouble):
        found = op.Mueller(np.eye(4, dtype=dtype)).lu_chipman()
        assert found.retarder.matrix.dtype == np.float64


ANGLES = np.linspace(0.1, 1.4, 200)


def nearly_crossed(e):
    return op.Polarizer(ANGLES + np.pi / 2 - e).mueller() @ op.Polarizer(ANGLES).mueller()


@rows("e", [0.05, 1e-2, 1e-3, 1e-4, 1e-5])
def test_polarisers_nearly_crossed_depolarise_nothing_and_turn_least(e):
    matrix, slack = nearly_crossed(e), 1e-15 / e**2
    found = matrix.lu_chipman()
    np.testing.assert_array_equal(found.depolarizer.matrix, np.broadcast_to(np.eye(4), (200, 4, 4)))
    np.testing.assert_allclose(found.diattenuation, 1.0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.retardance, np.pi - 2 * e, rtol=0, atol=slack)
    np.testing.assert_allclose(matrix.retardance, found.retardance)
    over = matrix.matrix[:, :1, :1]
    np.testing.assert_allclose(product(found) / over, matrix.matrix / over, rtol=0, atol=slack)
    # A retarder between them does not depolarise either; a depolariser behind keeps its degree.
    for retardance in (0.5, 1.5, 3.0):
        between = op.Retarder(retardance, ANGLES + e).mueller()
        last = op.Polarizer(ANGLES + np.pi / 2 - e).mueller()
        found = (last @ between @ op.Polarizer(ANGLES).mueller()).lu_chipman()
        np.testing.assert_array_equal(found.depolarization, 0.0)
        np.testing.assert_allclose(found.diattenuation, 1.0, rtol=0, atol=1e-15)
        np.testing.assert_allclose(found.retardance, np.pi - 2 * e, rtol=0, atol=10 * slack)
    found = (op.Mueller(np.diag([1.0, 0.6, 0.6, 0.6])) @ matrix).lu_chipman()
    np.testing.assert_allclose(found.depolarization, 0.4, rtol=0, atol=slack)
    np.testing.assert_allclose(found.retardance, np.pi - 2 * e, rtol=0, atol=slack)


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
    turned = found.retarder.matrix[1:, 1:]
    np.testing.assert_allclose(turned, turn(axis, angle), rtol=0, atol=1e-14 / a)
    np.testing.assert_allclose(product(found), matrix, rtol=0, atol=1e-14)


def test_the_rounding_of_single_precision_does_not_depolarise():
    elements = [op.Polarizer(0.3), op.Retarder(1.0, 0.2), op.Interface(0.6 + 2.1j, 0.8)]
    matrices = np.stack([element.mueller().matrix for element in elements])
    found = op.Mueller(matrices.astype(np.float32)).lu_chipman()
    np.testing.assert_array_equal(found.depolarization, 0.0)
    np.testing.assert_allclose(found.retardance, op.Mueller(matrices).retardance, rtol=0, atol=1e-6)
