"""What no passive element can do is refused, beyond rounding; measured noise is let in if asked."""

import math
from contextlib import nullcontext

import numpy as np
import pytest

import chains
import optipath as op
from paths import chain
from random_matrices import jones, of_jones
from tables import rows, slow_except
from wired import read, read_back

TURNED_OVER = np.diag([1.0, 1.0, 1.0, -1.0])
NO_MATRIX = (
    r"is unphysical, having a coherency eigenvalue of -1 times .*nearest_physical\(\).*= ?[Ff]alse"
)
BRIGHTER = r"makes light up to 2 times as bright .*physical=False .* for amplifiers"
CASES = [(TURNED_OVER, NO_MATRIX), (2.0 * np.eye(4), BRIGHTER)]
ENGINES = ["auto", *chains.ENGINES]


def passive(rng, *shape, terms=1):
    """Sums of Jones matrices that let through at most as much as comes in, some of them all."""
    T = jones(rng, *shape, terms)
    matrix = of_jones(T).sum(axis=-3)
    return matrix / (matrix[..., :1, :1] + np.linalg.norm(matrix[..., :1, 1:], axis=-1)[..., None])


@rows("matrix, expected", CASES)
def test_a_matrix_that_no_passive_element_has_is_refused(matrix, expected):
    for given, place in ((matrix, ""), ([np.eye(4), matrix], r"\[1\]")):
        with pytest.raises(op.OptipathError, match=rf"atrix{place} {expected}"):
            op.MuellerElement(given)


@pytest.mark.parametrize("engine", slow_except(["auto", "numpy"], ENGINES))
@rows("count", [None, 3, 3000])
@rows("matrix, expected", CASES)
def test_matrices_that_are_given_when_a_path_runs_are_looked_at_each_time(
    matrix, expected, count, engine
):
    plan = op.Composer(engine=engine).compose(chain([op.MuellerElement(op.Parameter("M"))]))
    good = np.eye(4) if count is None else np.broadcast_to(np.eye(4), (count, 4, 4)).copy()
    bad = good.copy()
    bad[() if count is None else -1] = matrix
    for _ in range(5):
        assert np.all(plan.run(M=good).intensity == 1.0)
    with pytest.raises(op.errors.ParameterError, match=rf"'M' \(at e0.matrix\).* {expected}"):
        plan.run(M=bad)


@rows("engine", ["auto", "numpy", "numba"])
def test_states_that_are_given_when_a_path_runs_are_looked_at_each_time(engine):
    path = chain([op.Polarizer(0.2)], op.Parameter("state"))
    plan = op.Composer(engine=engine).compose(path)
    good = np.tile([1.0, 0.6, 0.0, 0.8], (5000, 1))
    bad = good.copy()
    bad[4321] = 1.0
    for _ in range(3):
        plan.run(state=good)
    with pytest.raises(op.errors.ParameterError, match="polarised by more than 100 %"):
        plan.run(state=bad)


@rows("matrix", [TURNED_OVER, 2.0 * np.eye(4)])
def test_physical_false_takes_a_matrix_as_it_is(matrix):
    state = [1.0, 0.0, 0.6, 0.8]
    for value, given in ((matrix, {}), (op.Parameter("M"), {"M": matrix})):
        path = chain([op.MuellerElement(value, physical=False)], state)
        np.testing.assert_allclose(path.trace(**given).stokes, matrix @ state)


def test_measured_states_and_jones_matrices_are_taken_but_no_negative_intensity():
    measured = [1.0, 0.8, 0.7, 0.1]
    with pytest.raises(op.OptipathError, match="or physical=False for what is measured"):
        chain([], measured).check()
    path = op.Source(2.0, measured, physical=False) >> op.Detector()
    np.testing.assert_allclose(path.trace().stokes, 2.0 * np.array(measured))
    path = op.Source(1.0, op.Parameter("s"), physical=False) >> op.Detector()
    with pytest.raises(op.OptipathError, match="negative intensity -1"):
        path.trace(s=[-1.0, 0.0, 0.0, 0.0])
    pure, other = passive(np.random.default_rng(3), 2, 5000)
    for share in (0.0, 1e-16, 1e-12, 1e-8):
        op.MuellerElement((1.0 - share) * pure + share * other)
    op.MuellerElement(op.Mueller(TURNED_OVER).nearest_physical().matrix / 1.5)


def test_whether_a_matrix_is_physical_goes_to_toml_and_back(tmp_path):
    for matrix, physical in ((np.eye(4), True), (TURNED_OVER, False)):
        path = chain([op.MuellerElement(matrix, physical=physical)])
        assert f"physical = {str(physical).lower()}\n" in path.to_toml()
        assert read_back(path, tmp_path) == path
    with pytest.raises(op.OptipathError, match=NO_MATRIX.replace("=False", " = false")):
        read(path.to_toml().replace("physical = false\n", ""), tmp_path)


@rows("dtype", [np.float64, np.float32])
@rows("terms", [1, 2, 3, 4])
def test_no_sum_of_jones_matrices_is_refused_in_the_precision_it_is_computed_in(terms, dtype):
    rng = np.random.default_rng(terms)
    size = 10.0 ** rng.uniform(-12, 0, (5_000, 1, 1))
    matrices = (size * passive(rng, 5_000, terms=terms)).astype(dtype)
    chain([op.MuellerElement(matrices)]).check()
    path = chain([op.MuellerElement(op.Parameter("M"))])
    path.trace(M=matrices)
    for matrix in matrices[:20]:
        path.trace(M=matrix)


def test_the_quick_answer_is_cloudes_criterion_up_to_its_border():
    rng = np.random.default_rng(4)
    pure, other = passive(rng, 2, 4000)
    lack = 10.0 ** rng.uniform(-12, -6, (4000, 1, 1))
    matrices = 0.5 * (pure - lack * other)
    known = op.Mueller(matrices).is_physical()
    assert 0.1 < known.mean() < 0.9
    for matrix, physical in zip(matrices[:300], known, strict=False):
        refused = pytest.raises(op.OptipathError, match="unphysical")
        with nullcontext() if physical else refused:
            op.MuellerElement(matrix)
    op.MuellerElement(matrices[known])


def test_light_that_passes_is_never_polarised_by_more_than_100_percent_nor_brighter():
    rng = np.random.default_rng(5)
    state = rng.normal(size=(4000, 4))
    state[:, 0] = np.linalg.norm(state[:, 1:], axis=-1)
    chosen = passive(rng, 4000, terms=2) + 1e-10 * rng.normal(size=(4000, 4, 4))
    taken = op.Mueller(chosen).is_physical()
    light = chain([op.MuellerElement(op.Parameter("M"))], op.Parameter("s")).trace(
        M=chosen[taken] * (1.0 - 1e-9), s=state[taken]
    )
    assert np.all(light.intensity <= state[taken, 0] * (1.0 + 1e-8))
    assert np.all(light.dop[light.intensity > 0.1] <= 1.0 + 1e-6)


def test_jax_gives_nan_for_traced_matrices_that_cannot_be():
    jax = pytest.importorskip("jax")
    path = chain([op.MuellerElement(op.Parameter("M"))])
    plan = op.Composer(dtype="float32").compose(path)
    found = jax.jit(lambda M: plan.run(M=M).stokes)(np.array([TURNED_OVER, np.eye(4)]))
    assert np.isnan(found[0]).all()
    np.testing.assert_array_equal(found[1], [1.0, 0.0, 0.0, 0.0])


COUNTED = np.diag([1.0, 1.0, math.sqrt(0.91), math.sqrt(0.91)])
COUNTED[0, 1] = COUNTED[1, 0] = 0.3


@rows(
    "matrix, cure",
    [
        (1.0000001 * np.eye(4), "give matrix / 1.0000001,"),
        (1.00000000123456 * np.eye(4), "give matrix / 1.000000002,"),
        (np.array([2.0 * np.eye(4), 3.0 * np.eye(4)]), "give matrix / 3,"),
        (1e12 * COUNTED, "give matrix / 1.3e+12,"),
        (1e200 * COUNTED, "give matrix / 1.3e+200,"),
        (np.array([4.0 * np.eye(4), TURNED_OVER]), "nearest_physical().matrix / 4,"),
        (TURNED_OVER, "nearest_physical().matrix / 1.5,"),
    ],
)
def test_the_cure_of_matrices_ends_the_matter_for_all_of_them(matrix, cure):
    with pytest.raises(op.errors.ValueFault) as caught:
        op.MuellerElement(matrix)
    assert cure in str(caught.value)
    nearest = op.Mueller(matrix).nearest_physical().matrix if "nearest" in cure else matrix
    op.MuellerElement(nearest / float(cure.rstrip(",").split(" / ")[1]))
