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


@rows("scale", [1e-300, 1e-160, 1.0, 1e160, 1e300])
def test_the_parts_of_a_product_come_back(scale):
    depolarizer, retarder, first = parts(np.random.default_rng(4), 2000)
    found = op.Mueller(scale * (depolarizer @ retarder @ first)).lu_chipman()
    np.testing.assert_allclose(found.depolarizer.matrix, depolarizer, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.retarder.matrix, retarder, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.diattenuator.matrix / scale, first, rtol=0, atol=1e-13)


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
    np.testing.assert_allclose(
        np.sin(angle) * found.fast_axis, np.sin(angle) * axis, rtol=0, atol=1e-11
    )
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
    np.testing.assert_allclose(
        sign * found.fast_axis, axis, rtol=0, atol=1e-15 / min(retardance, 1.0)
    )
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
    metal = op.Mueller(
        numbers, op.Frame().turned(0.3), op.Frame.from_direction((1, 0, 0), (0, 1, 0))
    )
    found = metal.lu_chipman()
    assert found.diattenuator.frame_in == found.diattenuator.frame_out == metal.frame_in
    assert found.depolarizer.frame_in == found.depolarizer.frame_out == metal.frame_out
    assert (found.retarder.frame_in, found.retarder.frame_out) == (metal.frame_in, metal.frame_out)
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
    assert found.diattenuation == 1.0
    assert found.retardance == pytest.approx(least, abs=1e-14)
    assert found.depolarization == pytest.approx(0.0, abs=1e-14)
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
    np.testing.assert_allclose(
        found.depolarizer.matrix, np.diag([1, -0.3, -0.4, -0.5]), rtol=0, atol=1e-15
    )
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


def test_what_does_not_depolarise_or_is_dark_has_no_depolariser():
    matrices = of_jones(jones(np.random.default_rng(7), 500))
    found = op.Mueller(matrices).lu_chipman()
    gap = 1 - found.diattenuation
    assert (np.abs(found.depolarization) < 1e-14 / gap).all()
    np.testing.assert_allclose(product(found), matrices, rtol=0, atol=1e-13)
    found = op.Mueller(np.zeros((4, 4))).lu_chipman()
    np.testing.assert_array_equal(found.diattenuator.matrix, 0.0)
    np.testing.assert_array_equal(found.retarder.matrix, np.eye(4))
    np.testing.assert_array_equal(found.depolarizer.matrix, np.eye(4))
    assert found.diattenuation == found.retardance == found.depolarization == 0.0
    assert op.Mueller(np.diag([1.0, 0.0, 0.0, 0.0])).retardance == 0.0


@rows("batch", [(), (5,), (2, 1, 0)])
def test_each_figure_has_the_shape_of_the_batch(batch):
    found = op.Mueller(np.ones((*batch, 4, 4))).lu_chipman()
    for name in FIGURES:
        tail = (3,) if name in ("retardance_vector", "fast_axis") else ()
        assert getattr(found, name).shape == (*batch, *tail), name


@rows("dtype", [np.float32, np.float64, np.longdouble])
def test_matrices_of_any_precision_are_taken_apart_in_double(dtype):
    found = op.Mueller(np.eye(4, dtype=dtype)).lu_chipman()
    assert found.retarder.matrix.dtype == np.float64
