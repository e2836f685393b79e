"""Diattenuation, polarizance, depolarisation, psi and delta of Mueller matrices."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from random_matrices import jones, of_jones
from tables import rows

pytestmark = pytest.mark.filterwarnings(
    "ignore::optipath.errors.CoherenceWarning"
)  # Of films, on purpose.

SCALARS = ["diattenuation", "polarizance", "depolarization_index", "psi", "delta"]
VECTORS = ["diattenuation_vector", "polarizance_vector"]
METALS = [0.6 + 2.1j, 1.5, 0.05 + 3.3j, 0.7]


def amplitudes(m, incidence):
    c, s = np.cos(incidence), np.sin(incidence)
    g = np.sqrt(m**2 - s**2 + 0j)
    return (c - g) / (c + g), (m**2 * c - g) / (m**2 * c + g)


@rows("angle", [0.0, 0.4, -1.0])
def test_an_ideal_polariser_diattenuates_and_polarises_along_its_axis(angle):
    matrix = op.Polarizer(angle).mueller()
    axis = [np.cos(2 * angle), np.sin(2 * angle), 0.0]
    assert (matrix.diattenuation, matrix.polarizance) == pytest.approx((1.0, 1.0), abs=1e-15)
    found = [matrix.diattenuation_vector, matrix.polarizance_vector]
    np.testing.assert_allclose(found, [axis] * 2, rtol=0, atol=1e-15)


@given(retardance=st.floats(-3.0, 3.0), angle=st.floats(-3.0, 3.0))
def test_a_retarder_does_neither(retardance, angle):
    matrix = op.Retarder(retardance, angle).mueller()
    assert matrix.diattenuation == matrix.polarizance == 0.0
    assert matrix.depolarization_index == pytest.approx(1.0, abs=1e-14)


def test_diattenuation_is_of_what_comes_in_and_polarizance_of_what_goes_out():
    matrix = op.Rotator(np.pi / 4).mueller() @ op.Polarizer().mueller()
    found = [matrix.diattenuation_vector, matrix.polarizance_vector]
    np.testing.assert_allclose(found, [[1, 0, 0], [0, 1, 0]], rtol=0, atol=1e-15)


@given(before=st.floats(-4.0, 4.0), after=st.floats(-4.0, 4.0))
def test_frames_leave_sizes_as_they_are(before, after):
    matrix = of_jones(jones(np.random.default_rng(1), 3)).sum(axis=0)
    plain = op.Mueller(matrix)
    turned = op.Rotator(after).mueller() @ plain @ op.Rotator(before).mueller()
    for name in ("diattenuation", "polarizance", "depolarization_index", "cloude_eigenvalues"):
        np.testing.assert_allclose(getattr(turned, name), getattr(plain, name), rtol=0, atol=1e-13)
    assert turned.lu_chipman().depolarization == pytest.approx(plain.lu_chipman().depolarization)


@rows("scale", [1e-300, 1e-160, 1.0, 1e300])
def test_what_jones_describes_has_the_index_1_at_any_scale(scale):
    matrices = op.Mueller(of_jones(jones(np.random.default_rng(2), 50)) * scale)
    np.testing.assert_allclose(matrices.depolarization_index, 1.0, rtol=1e-14)
    np.testing.assert_allclose(matrices.diattenuation, matrices.polarizance, rtol=1e-14)


@rows("m", METALS)
@rows("incidence", [0.0, 0.5, 1.2, 1.5])
@rows("scale", [1e-300, 1.0])
def test_psi_and_delta_are_those_of_the_ratio_of_amplitudes(m, incidence, scale):
    rs, rp = amplitudes(m, incidence)
    rho = np.conj(rp / rs)
    sample = op.Mueller(op.Interface(m, incidence).mueller().matrix * scale)
    assert np.tan(sample.psi) == pytest.approx(abs(rho), rel=1e-12)
    np.testing.assert_allclose(np.exp(1j * sample.delta), rho / abs(rho), rtol=0, atol=1e-12)


def test_delta_of_metals_and_glass_is_that_of_the_textbook():
    incidence = np.linspace(0.0, np.pi / 2 - 1e-9, 200)
    delta = op.Interface(0.6 + 2.1j, incidence).mueller().delta
    assert delta[0] == np.pi
    assert (np.diff(delta) < 0.0).all()
    assert 0.0 <= delta[-1] < 1e-6
    brewster = np.arctan(1.5)
    sample = op.Interface(1.5, brewster + np.array([-0.1, 0.1])).mueller()
    np.testing.assert_array_equal(sample.delta, [np.pi, 0.0])
    assert op.Interface(1.5, brewster).mueller().psi == pytest.approx(0.0, abs=1e-15)
    sample = op.Interface(0.6 + 2.1j, np.linspace(0.0, 1.5, 7)).mueller()
    light = sample @ op.Light([1.0, 0.0, 1.0, 0.0])
    np.testing.assert_allclose(light.psi, sample.psi, rtol=1e-14)
    np.testing.assert_allclose(light.delta, sample.delta, rtol=1e-14)


@rows("name", SCALARS)
def test_no_matrix_has_none_of_it(name):
    none = np.nan if name in ("psi", "delta") else 0.0
    for matrix in (np.zeros((4, 4)), np.ones((4, 4)) - np.diag([1.0, 0, 0, 0])):
        np.testing.assert_equal(getattr(op.Mueller(matrix), name), none)


def test_what_has_no_delta_or_is_not_read_is_not_known():
    depolarised, polarizer = op.Mueller(np.diag([1.0, 0, 0, 0])), op.Polarizer(0.0).mueller()
    assert np.isnan([depolarised.psi, depolarised.delta, polarizer.delta]).all()
    assert polarizer.psi == 0.0
    matrix = np.array(op.Interface(0.6 + 2.1j, 0.8).mueller().matrix)
    whole = op.Mueller(matrix.copy())
    matrix[3] = np.nan
    read = op.Mueller(matrix)
    for name in ("diattenuation", "psi", "delta"):
        assert getattr(read, name) == getattr(whole, name)
    assert np.isnan([read.polarizance, read.depolarization_index]).all()
    np.testing.assert_array_equal(np.isnan(read.polarizance_vector), [False, False, True])


@rows("name", SCALARS + VECTORS)
def test_each_figure_has_the_shape_of_the_batch_and_keeps_its_precision(name):
    tail = (3,) if name in VECTORS else ()
    for batch in ((), (5,), (2, 1, 0)):
        assert getattr(op.Mueller(np.ones((*batch, 4, 4))), name).shape == (*batch, *tail)
    single = np.asarray(op.Interface(0.6 + 2.1j, 0.8).mueller().matrix, np.float32)
    for matrix in (single, single[np.newaxis]):
        assert getattr(op.Mueller(matrix), name).dtype == np.float32


def test_jax_gives_what_numpy_gives_and_finite_slopes(jacobian):
    jax = pytest.importorskip("jax")

    def figures(m):
        return {name: getattr(op.Mueller(m), name) for name in SCALARS}

    both = jacobian(lambda m: (figures(m),) * 2, has_aux=True)
    for matrix in (np.diag([1.0, 0, 0, 0]), np.eye(4), np.ones((4, 4))):
        sloping, found = both(jax.numpy.array(matrix))
        for name, expected in figures(matrix).items():
            np.testing.assert_allclose(found[name], expected, rtol=1e-6, err_msg=name)
            assert np.isfinite(sloping[name]).all(), name


@rows("place", [(0, 0), (0, 1), (1, 0), (2, 2), (3, 2)])
@rows("infinite", [np.inf, -np.inf])
def test_what_is_infinite_makes_no_warning(place, infinite):
    matrix = np.array(op.Interface(0.6 + 2.1j, 0.8).mueller().matrix)
    matrix[place] = infinite
    given = op.Mueller(matrix)
    for name in (*SCALARS, *VECTORS, "retardance", "coherency", "cloude_eigenvalues"):
        getattr(given, name)
    assert not given.is_physical()
    assert np.isnan(given.nearest_physical().matrix).all()
    assert not np.isfinite(given.depolarization_index)
    assert not np.isfinite((given @ op.Rotator(0.3).mueller() @ given).matrix).all()
    assert not np.isfinite((given @ op.Light([1.0, 0.5, 0.3, 0.2])).stokes).all()
