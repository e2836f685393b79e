"""A batch: its axes and pieces, and how often the numbers of each step are computed."""

from typing import ClassVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import optipath as op
from optipath.engines.formula import stages
from optipath.engines.path_formula import PathFormula
from optipath.engines.symbols import Symbol
from optipath.kernels.carriers.carrier import StokesCarrier
from optipath.plan.reading import Layout, pieces, sliced
from optipath.values.operands import MANY, InputKey
from paths import chain
from tables import rows, slow

METAL = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12, "filter": 0.3}
PATH = op.load_preset("npgr026", **METAL)
SHAPES = [
    [(100, 1), (1, 90)],
    [(70, 1, 1), (1, 3, 1), (80,)],
    [(2, 1, 50), (1, 30, 1), (50,)],
    [(1500, 1), (1, 2)],
    [(1, 1), (40, 50)],
    [(3, 1, 20, 1), (4, 1, 25), ()],
]
# Numba compiles each anew.
WAYS = [("numpy", dtype, shapes) for dtype in ("float64", "float32") for shapes in SHAPES]
WAYS += [slow(("numba", "float64", shapes)) for shapes in (SHAPES[0], SHAPES[2], SHAPES[5])]
WAYS += [slow(("numba", "float32", SHAPES[0]))]


@pytest.mark.parametrize(("engine", "dtype", "shapes"), WAYS)
def test_a_grid_is_what_its_cells_are_one_by_one(rng, engine, dtype, shapes):
    names = ["delta", "phi", "rho"][: len(shapes)]
    axes = {name: rng.uniform(0.1, 1.5, shape) for name, shape in zip(names, shapes, strict=True)}
    batch = np.broadcast_shapes(*shapes)
    cells = {name: np.broadcast_to(value, batch).copy() for name, value in axes.items()}
    plan = op.Composer(engine=engine, dtype=dtype).compose(PATH)
    # An array of one number is that number, and rounded with it to the precision of the plan.
    slack = 0.0 if dtype == "float64" else 2e-6
    found, wanted = plan.run(**axes).normalized, plan.run(**cells).normalized
    np.testing.assert_allclose(found, wanted, rtol=0, atol=slack)
    if engine == "numpy":
        matrix, whole = plan.mueller(**axes).matrix, plan.mueller(**cells).matrix
        np.testing.assert_allclose(matrix, whole, rtol=0, atol=slack)


def test_interfaces_of_a_grid_are_evaluated_once_for_each_of_their_own_angles(rng):
    axes = {"delta": rng.uniform(0, 1, (1000, 1)), "phi": rng.uniform(0, 1, (1, 1000))}
    counts = PATH.compose().evaluations(**axes)
    assert counts["X1.reflected"] + counts["X2.reflected"] == 2000
    full = op.Composer(model="full").compose(PATH)
    assert full.evaluations(**axes)["X1.reflected"] == 1_000_000


def test_the_last_stage_of_a_grid_has_nothing_of_the_interfaces_left_to_do():
    plan = op.load_preset("npgr026", **METAL, rho=0.2).compose()
    places = {"delta": 0, "phi": 1, "intensity": 1}
    forms = {InputKey(name): MANY for name in places}
    axes = {InputKey(name): frozenset({place}) for name, place in places.items()}
    given = plan.program, "float64", forms, plan.inputs.limits, axes
    whole = PathFormula(*given).lights(StokesCarrier)
    *_, last = parts = stages(whole, frozenset({0, 1}), 1)
    assert [part.axes for part in parts] == [{0}, {1}, {0, 1}]
    done = [step.operation for step in last.steps]
    assert "sqrt" not in done
    assert done.count("divide") <= 1
    assert len(last.steps) < 0.3 * len(whole.steps)
    assert all(isinstance(result, Symbol) for result in last.results[:4])


class Counting(op.Element):
    """Counts how many numbers it is asked for, which no engine can compile."""

    physical: ClassVar[bool] = False
    angle: op.fields.Angle
    asked = 0

    @staticmethod
    def mueller_rows(xp, angle):
        Counting.asked += len(np.ravel(angle))
        first = (np.cos(angle) + 0.0, 0.0 * angle, 0.0, 0.0)
        return first, (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)


def test_elements_that_cannot_be_compiled_are_evaluated_along_their_own_axes_too(rng):
    plan = chain([Counting(op.Parameter("a")), Counting(op.Parameter("b"))]).compose()
    axes = {"a": rng.uniform(0, 1, (300, 1)), "b": rng.uniform(0, 1, 200)}
    expected = np.cos(axes["a"]) * np.cos(axes["b"])
    assert plan.engine_for(60_000) == "numpy, step by step"
    plan.run(**axes)  # The first values are looked at.
    Counting.asked = 0
    np.testing.assert_allclose(plan.run(**axes).intensity, expected, rtol=1e-14)
    assert Counting.asked == 500


ELEMENTS = [
    op.Retarder(op.Parameter("a"), 0.1),
    op.Interface(1.5, op.Parameter("b")),
    op.Attenuator(op.Parameter("t", 0.5)),
    op.Depolarizer(np.linspace(0.0, 1.0, 5).reshape(5, 1, 1)),
    op.Medium(op.Parameter("l"), 2.0, rotation=op.Parameter("w")),
]
COUNTS = {"e0.out": 40, "e1.reflected": 50, "e2.out": 1, "e3.out": 5, "e4.out": 40 * 50}


@rows("b", [np.full(50, 0.4), op.CosSin(np.full(50, 0.6), 0.8)])
def test_a_step_is_evaluated_along_the_axes_of_its_own_values(b):
    values = {"a": np.full((40, 1), 0.3), "b": b, "l": np.full((40, 1), 0.1), "w": np.ones(50)}
    path = chain(ELEMENTS, [1.0, 0.3, 0.2, 0.1])
    counts = path.compose().evaluations(**values)
    assert {name: counts[name] for name in COUNTS} == COUNTS
    full = op.Composer(model="full").compose(path).evaluations(**values)
    assert {full[name] for name in COUNTS} == {5 * 40 * 50}
    # Links that turn nothing are not evaluated.
    counts = chain([op.Polarizer(op.Parameter("a"))]).compose().evaluations(a=np.ones(7))
    assert "eye.in" not in counts
    assert counts["e0.out"] == 7


def test_axes_that_all_arrays_have_together_are_one():
    arrays = {"a": np.ones((4, 1, 1, 2)), "b": np.ones((1, 3, 5, 2))}
    layout = Layout((4, 3, 5, 2), arrays)
    assert layout.shape == (4, 15, 2)
    assert layout.axes == {"a": frozenset({0, 2}), "b": frozenset({1, 2})}


@rows("where", [(slice(1, 3),), (2, slice(0, 2)), (slice(0, 1), slice(2, 4))])
def test_a_part_of_an_array_is_that_of_the_array_laid_out(rng, where):
    batch = (4, 5)
    for shape in [(4, 1), (5,), (4, 5), (1, 1)]:
        array = rng.uniform(size=shape)
        part, whole = sliced(array, batch, where), np.broadcast_to(array, batch)[where]
        np.testing.assert_array_equal(np.broadcast_to(part, whole.shape), whole)


@rows("engine", ["numpy", "numba"])
def test_of_a_grid_a_value_out_of_range_is_refused_and_faint_light_keeps_its_state(rng, engine):
    plan = op.Composer(engine=engine).compose(PATH)
    delta, phi = rng.uniform(0, 1, (100, 1)), rng.uniform(0, 1, 100)
    delta[70] = 2.0
    with pytest.raises(op.errors.ParameterError, match=r"'delta' is 114\.592 deg at"):
        plan.run(delta=delta, phi=phi)
    dimmed = [op.Attenuator(op.Parameter(f"t{name}")) for name in "ab"]
    plan = op.Composer(engine=engine).compose(chain(dimmed, [1.0, 0.6, 0.0, 0.8]))
    shares = np.geomspace(1e-200, 1e-100, 101)
    light = plan.run(ta=shares[:, np.newaxis], tb=shares)
    np.testing.assert_array_equal(light.stokes[0, 0], np.zeros(4))
    np.testing.assert_allclose(light.log10_intensity[0, 100], -300.0)
    np.testing.assert_allclose(light.normalized[0, 100], [1.0, 0.6, 0.0, 0.8])


@given(batch=st.lists(st.integers(0, 6), max_size=4).map(tuple), size=st.integers(1, 50))
def test_pieces_follow_each_other_and_cover_the_batch_by_one_if_it_is_small_enough(batch, size):
    numbers = np.arange(np.prod(batch, dtype=int)).reshape(batch)
    found = list(pieces(batch, size))
    for piece in found:
        part = numbers[piece.where].ravel()
        np.testing.assert_array_equal(part, np.arange(piece.start, piece.stop))
        assert part.size <= size
    assert sum(piece.stop - piece.start for piece in found) == numbers.size
    assert len(found) == 1 or not 0 < numbers.size <= size
