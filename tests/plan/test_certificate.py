from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from paths import chain
from random_matrices import bordered, jones, of_jones, unit_vectors
from tables import rows

ROUNDS = 8
ROOT = 1.0 / np.sqrt(3.0)
NO_ROW_TOO_LONG = bordered(np.full((3, 3), ROOT))
REFUSED = r"'e0' is unphysical, having a coherency eigenvalue of -.*Mueller\(matrix\)\.nearest_phys"


class OwnElement(op.Element, kind="test-own-matrix"):
    physical: ClassVar[bool] = False
    share: float = 1.0

    @staticmethod
    def mueller_rows(xp, share):
        inner = [xp.absolute(share) * ROOT] * 3
        return (1.0, 0.0, 0.0, 0.0), *[(0.0, *inner)] * 3


def measured(matrix):
    """An element of any matrix, which bounds must look at themselves."""
    return op.MuellerElement(matrix, physical=False)


def asked_in_every_way(path, **values):
    """Everything that gives a bound, or rests on one."""
    tolerated = op.Composer(tolerance=0.5).compose(path)
    yield lambda: path.compose().certificate(**values)
    yield lambda: tolerated.run(**values)
    yield lambda: list(tolerated.stream(100, **values))
    yield lambda: op.polarization(path, **values)


def physical(rng, *shape, terms=4):
    """Sums of pure matrices, M00 being 1: on the boundary of what is physical below four."""
    matrix = of_jones(jones(rng, *shape, terms)).sum(axis=-3)
    return matrix / matrix[..., :1, :1]


def unphysical_with_short_rows(rng, count):
    """Matrices no row or column of which is too long, an eigenvalue being negative even so."""
    found = bordered(rng.normal(size=(20 * count, 3, 3)))
    found[:, 0, 1:], found[:, 1:, 0] = rng.normal(size=(2, 20 * count, 3)) * rng.random()
    rows = np.linalg.norm(found[:, 1:], axis=-1).max(axis=-1)
    columns = np.linalg.norm(found[..., 1:], axis=-2).max(axis=-1)
    longest = np.maximum(np.maximum(rows, columns), np.linalg.norm(found[:, 0, 1:], axis=-1))
    found[:, 0, 1:] /= longest[:, None]
    found[:, 1:] /= longest[:, None, None]
    values = op.Mueller(found).cloude_eigenvalues
    return found[values[:, 3] < -1e-6][:count]


@rows("element", [measured(NO_ROW_TOO_LONG), OwnElement()])
def test_no_bound_is_given_for_an_unphysical_matrix(element):
    path = chain([element, op.Polarizer(0.3)], [1.0, *[ROOT] * 3], reads="intensity")
    for asked in asked_in_every_way(path):
        with pytest.raises(op.ParameterError, match=REFUSED):
            asked()


@rows("size", [(), (3,), (2500,)])
@rows("own", [True, False])
def test_one_unphysical_matrix_of_a_batch_is_refused(size, own):
    values = {"M": np.broadcast_to(np.eye(4), (*size, 4, 4)).copy()}
    values["M"][-1 if size else ...] = NO_ROW_TOO_LONG
    element = measured(op.Parameter("M"))
    if own:
        element, values = OwnElement(op.Parameter("s")), {"s": np.full(size, 0.1)}
        values["s"][-1 if size else ...] = 1.0
    path = chain([element, op.Polarizer(0.3)], [1.0, 0.6, 0.0, 0.0], reads="intensity")
    for asked in asked_in_every_way(path, **values):
        with pytest.raises(op.ParameterError, match=REFUSED):
            asked()


@rows("dtype", ["float64", "float32", "longdouble"])
def test_every_matrix_with_a_negative_eigenvalue_is_refused_however_short_its_rows(dtype):
    plan = op.Composer(dtype=dtype).compose(chain([measured(op.Parameter("M"))]))
    for matrix in unphysical_with_short_rows(np.random.default_rng(1), 100):
        if op.Mueller(matrix).is_physical(1e-4):
            continue
        with pytest.raises(op.ParameterError, match=REFUSED):
            plan.certificate(M=matrix)
        plan.certificate(M=op.Mueller(matrix).nearest_physical().matrix)


@rows("terms", [1, 2, 3, 4])
def test_no_physical_matrix_is_refused_whatever_engine_bounds_it(terms):
    rng = np.random.default_rng(terms)
    scale = rng.choice([1e-150, 1e-3, 1.0], (20_000, 1, 1))
    matrices = scale * physical(rng, 20_000, terms=terms)
    path = chain([measured(op.Parameter("M"))], [1.0, 0.8, 0.0, 0.6], reads="intensity")
    compiled, fallback = (
        op.Composer(engine=engine).compose(path).certificate(M=part)
        for engine, part in (("numba", matrices), ("numpy", matrices[:500]))
    )
    np.testing.assert_allclose(compiled.upper[:500], fallback.upper, rtol=1e-11)
    np.testing.assert_allclose(compiled.lower[:500], fallback.lower, rtol=0.0, atol=1e-11)


def behind(state, matrices):
    for matrix in matrices:
        state = (matrix @ state[..., np.newaxis])[..., 0]
    return state[..., 0]


def drawn(rng, count, length, terms):
    """Sources of any degree of polarisation, and Jones matrices of what they meet."""
    dop = rng.choice([0.0, 1.0, 0.9], (count, 1)) * rng.random((count, 1)) ** 0.1
    state = np.concatenate([np.ones((count, 1)), dop * unit_vectors(rng, count)], axis=-1)
    return state, jones(rng, length, count, terms)


@rows("terms", [1, 2, 3, 4])
@rows("length", [2, 3])
@rows("end", ["lower", "upper"])
def test_no_physical_matrices_found_by_climbing_violate_a_bound(terms, length, end):
    rng, count = np.random.default_rng([terms, length]), 500
    names = [f"M{i}" for i in range(length)]
    elements = [measured(op.Parameter(name)) for name in names]
    path = chain(elements, op.Parameter("state"), reads="intensity")
    plan = op.Composer(engine="numpy").compose(path)

    def nearness(state, T):
        """How near the bound the intensity comes: at most 1."""
        matrices = of_jones(T).sum(axis=-3)
        matrices /= matrices[..., :1, :1]
        found = plan.certificate(state=state, **dict(zip(names, matrices, strict=True)))
        true = behind(state, matrices)
        assert np.all(true <= found.upper * found.scalar)
        assert np.all(true >= found.lower * found.scalar)
        if end == "upper":
            return true / (found.upper * found.scalar)
        return (1e-3 + found.lower) / (1e-3 + true / found.scalar)

    state, T = drawn(rng, count, length, terms)
    best = nearness(state, T)
    for step in np.geomspace(1.0, 1e-3, ROUNDS):
        tried = state, T + step * jones(rng, length, count, terms)
        found = nearness(*tried)
        better = found > best
        best[better], T[:, better] = found[better], tried[1][:, better]
    assert best.max() > 0.3


@rows("share", [1e-12, 1e-10, 0.9e-9])
def test_what_a_rounded_matrix_lacks_is_given_away_and_no_more(share):
    rng = np.random.default_rng(5)
    for _ in range(30):
        first, second = physical(rng, 2, terms=1)
        # An eigenvalue as negative as is taken for a rounding.
        spoilt = first - share * physical(rng, terms=1)
        spoilt /= spoilt[0, 0]
        state = np.concatenate([np.ones((200, 1)), unit_vectors(rng, 200)], axis=-1)
        found, exact = (
            chain(list(map(measured, pair)), state).compose().certificate()
            for pair in ([spoilt, second], [first, second])
        )
        true = behind(state, [spoilt, second])
        assert np.all(found.lower * found.scalar <= true)
        assert np.all(true <= found.upper * found.scalar)
        np.testing.assert_allclose(found.upper, exact.upper, rtol=50.0 * share)


@rows("engine", ["numpy", "numba"])
def test_light_polarised_by_a_rounding_too_much_stays_within_its_bounds(engine):
    rng = np.random.default_rng(8)
    axes = unit_vectors(rng, 20_000) * [1.0, 1.0, 1e-7]
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    state = np.concatenate([np.ones((20_000, 1)), (1.0 + 9e-13) * axes], axis=-1)
    angle = 0.5 * np.arctan2(axes[:, 1], axes[:, 0])
    path = chain([op.Polarizer(op.Parameter("a"))], op.Parameter("state"), reads="intensity")
    plan = op.Composer(engine=engine).compose(path)
    along = np.linalg.norm(state[:, 1:3], axis=-1)
    for turned, true in ((angle, 0.5 * (1.0 + along)), (angle + np.pi / 2, 0.5 * (1.0 - along))):
        found = plan.certificate(a=turned, state=state)
        assert np.all(found.lower * found.scalar <= np.maximum(true, 0.0))
        assert np.all(true <= found.upper * found.scalar)


def test_matrices_are_bounded_in_single_precision_and_refused_if_unphysical():
    rng = np.random.default_rng(6)
    matrices = physical(rng, 200, terms=1).astype(np.float32)
    state = np.concatenate([np.ones((200, 1)), 0.999 * unit_vectors(rng, 200)], axis=-1)
    for matrix, values in ((matrices, {}), (op.Parameter("M"), {"M": matrices})):
        elements = [measured(matrix), measured(matrix)]
        found = chain(elements, state, reads="intensity").compose().certificate(**values)
        true = behind(state, [matrices.astype(np.float64)] * 2)
        assert np.all(found.lower * found.scalar <= true)
        assert np.all(true <= found.upper * found.scalar)
        assert np.all(found.upper < 4.0)
    matrices = np.broadcast_to(np.eye(4), (20_000, 4, 4)).copy()
    matrices[12_345] = NO_ROW_TOO_LONG
    plan = op.Composer(engine="numba").compose(chain([measured(op.Parameter("M"))]))
    with pytest.raises(op.ParameterError, match=REFUSED):
        plan.certificate(M=matrices)
