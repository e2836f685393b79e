from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from optipath.engines.formulas.path_formula import lights_formula
from optipath.engines.formulas.stages import stages
from optipath.engines.formulas.symbol import Symbol
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.plan.running.batch import Layout, sliced
from optipath.values.input_key import InputKey
from optipath.values.operands import MANY
from tables import rows, slow

METAL = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12, "filter": 0.3}
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
WAYS += [("numba", "float64", SHAPES[0])]
WAYS += [slow(("numba", "float64", shapes)) for shapes in (SHAPES[2], SHAPES[5])]
WAYS += [slow(("numba", "float32", SHAPES[0]))]


@pytest.mark.parametrize(("engine", "dtype", "shapes"), WAYS)
def test_a_grid_is_what_its_cells_are_one_by_one(rng, engine, dtype, shapes):
    names = ["delta", "phi", "rho"][: len(shapes)]
    axes = {name: rng.uniform(0.1, 1.5, shape) for name, shape in zip(names, shapes, strict=True)}
    batch = np.broadcast_shapes(*shapes)
    cells = {name: np.broadcast_to(value, batch).copy() for name, value in axes.items()}
    plan = op.Composer(engine=engine, dtype=dtype).compose(op.load_preset("npgr026", **METAL))
    # An array of one number is that number, and rounded with it to the precision of the plan.
    slack = 0.0 if dtype == "float64" else 2e-6
    found, wanted = plan.run(**axes).normalized, plan.run(**cells).normalized
    np.testing.assert_allclose(found, wanted, rtol=0, atol=slack)
    if engine == "numpy":
        matrix, whole = plan.mueller(**axes).matrix, plan.mueller(**cells).matrix
        np.testing.assert_allclose(matrix, whole, rtol=0, atol=slack)


def test_interfaces_of_a_grid_are_evaluated_once_for_each_of_their_own_angles(rng):
    plan = op.load_preset("npgr026", **METAL).compose()
    axes = {"delta": rng.uniform(0, 1, (1000, 1)), "phi": rng.uniform(0, 1, (1, 1000))}
    counts = plan.evaluations(**axes)
    assert counts["X1.reflected"] + counts["X2.reflected"] == 2000
    full = op.Composer(model="full").compose(op.load_preset("npgr026", **METAL))
    assert full.evaluations(**axes)["X1.reflected"] == 1_000_000


def test_the_last_stage_of_a_grid_has_nothing_of_the_interfaces_left_to_do():
    plan = op.load_preset("npgr026", **METAL, rho=0.2).compose()
    forms = {InputKey("delta"): MANY, InputKey("phi"): MANY, InputKey("intensity"): MANY}
    axes = {"delta value": frozenset({0}), "phi value": frozenset({1})}
    axes["intensity value"] = frozenset({1})
    whole = lights_formula(
        plan.program,
        StokesCarrier,
        "float64",
        forms,
        plan.inputs.limits,
        axes=axes,
    )
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
    angle: op.Angle
    asked = 0

    @staticmethod
    def mueller_rows(xp, angle):
        del xp
        Counting.asked += len(np.ravel(angle))
        return (
            (np.cos(angle) + 0.0, 0.0 * angle, 0.0, 0.0),
            (0, 1, 0, 0),
            (0, 0, 1, 0),
            (0, 0, 0, 1),
        )


def test_elements_that_cannot_be_compiled_are_evaluated_along_their_own_axes_too(rng):
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for name in "ab":
        node = node >> path.add(name, Counting(op.Parameter(name)))
    node >> path.add("eye", op.Detector())
    plan = path.compose()
    axes = {"a": rng.uniform(0, 1, (300, 1)), "b": rng.uniform(0, 1, 200)}
    expected = np.cos(axes["a"]) * np.cos(axes["b"])
    assert plan.engine_for(60_000) == "numpy, step by step"
    plan.run(**axes)  # The first values are looked at.
    Counting.asked = 0
    np.testing.assert_allclose(plan.run(**axes).intensity, expected, rtol=1e-14)
    assert Counting.asked == 500


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
def test_a_value_out_of_range_on_one_axis_of_a_grid_is_refused(rng, engine):
    plan = op.Composer(engine=engine).compose(op.load_preset("npgr026", **METAL))
    delta, phi = rng.uniform(0, 1, (100, 1)), rng.uniform(0, 1, 100)
    delta[70] = 2.0
    with pytest.raises(op.ParameterError, match="'delta' is 2 rad, which is 114"):
        plan.run(delta=delta, phi=phi)


@rows("engine", ["numpy", "numba"])
def test_faint_light_in_a_corner_of_a_grid_keeps_its_exponent(engine):
    path = op.PathGraph()
    node = path.add("lamp", op.Source(stokes=[1.0, 0.6, 0.0, 0.8]))
    for name in "ab":
        node = node >> path.add(name, op.Attenuator(op.Parameter(f"t{name}")))
    node >> path.add("eye", op.Detector())
    shares = np.geomspace(1e-200, 1.0, 100)
    light = op.Composer(engine=engine).compose(path).run(ta=shares[:, np.newaxis], tb=shares)
    assert light.intensity[0, 0] == 0.0
    np.testing.assert_allclose(light.log10_intensity[0, 0], -400.0)
    np.testing.assert_allclose(light.normalized[0, 0], [1.0, 0.6, 0.0, 0.8])
