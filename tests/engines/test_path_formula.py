"""Formulas of whole paths: what is recorded, angles of any form, and that nothing is left out.

What formulas are asked is not left to the steps, silently and slower.
"""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from optipath.engines.choice import is_installed
from optipath.engines.symbols import SYMBOLIC, Recorder, Symbol
from paths import chain
from tables import rows


class Turning(op.Element):
    """A rotator that asks for the cosine and sine of twice its angle, and notes its numbers.

    A formula asks it once, in symbols.
    """

    turn: op.fields.Angle
    seen: ClassVar[list] = []

    @staticmethod
    def mueller_rows(xp, turn):
        if isinstance(turn, (float, np.ndarray, np.generic)):
            Turning.seen.append(np.shape(turn))
        c, s = xp.cos(2.0 * turn), xp.sin(2.0 * turn)
        return (1.0, 0.0, 0.0, 0.0), (0.0, c, -s, 0.0), (0.0, s, c, 0.0), (0.0, 0.0, 0.0, 1.0)


A, B, C, D, E, K, L, M, N, Q, T, V, W = map(op.Parameter, "abcdeklmnqtvw")
SORTS = [
    op.Interface(op.Material(M, K), A, outside=N),
    *[Turning(B), op.Retarder(C, A, azimuth=B), op.Medium(L, D, rotation=W)],
    *[op.Interface(1.5, A, outside=N), op.Diattenuator(0.9, T, B)],
    op.FaradayRotator(verdet=V, field=2.0, length=L),
    *[op.Waveplate(1e-3, Q, 1e-3, B), op.CircularPolarizer("left", T, E)],
]


def watched(reads="stokes", *, loops=False):
    """A path of many sorts of element, all of whose numbers are given."""
    path = op.PathGraph(loops="sum")
    node = path.add("lamp", op.Source(stokes=[1.0, 0.5, 0.3, 0.4]))
    for element in SORTS:
        node = node >> element
    if loops:
        path.add("split", op.BeamSplitter(0.5))
        path.add("back", op.BeamSplitter(T))
        node >> path["split.in"]
        path["split.transmitted"] >> path["back.in"]
        path.connect("back.reflected", "split.back", azimuth=B)
        node = path["back.transmitted"]
    node >> op.Detector(reads)
    return path


def given(rng, shape):
    """Ordinary values; along two axes where there are two."""
    spans = {"n": (1.1, 1.4), "m": (1.1, 1.4), "a": (0.2, 0.6), "b": (-1.0, 1.0)}
    spans |= dict.fromkeys("kcldwtvqe", (0.1, 0.9))
    shapes = {"a": (*shape[:-1], 1), "b": (1, *shape[1:]), "n": (1, *shape[1:])}
    shapes = shapes if len(shape) == 2 else {}
    values = {name: rng.uniform(*span, shapes.get(name, shape)) for name, span in spans.items()}
    return {name: value if shape else float(value) for name, value in values.items()}


LARGE, FEW = [(3000,), (60, 50)], [(), (2,), (10,), (300,)]


@rows(
    "options, path, ask, shapes",
    [
        ({"engine": "numpy"}, watched(), "run", LARGE),
        ({"engine": "numpy", "dtype": "float32"}, watched(), "run", LARGE),
        ({"engine": "numpy"}, watched("intensity"), "run", LARGE),
        ({"engine": "numpy", "tolerance": 0.5}, watched("intensity"), "run", LARGE),
        ({"engine": "numpy"}, watched(), "mueller", LARGE),
        ({"engine": "numpy"}, watched("intensity"), "certificate", LARGE),
        ({"engine": "numpy"}, watched(loops=True), "run_all", [(), *LARGE]),
        ({}, watched(), "run", FEW),
    ],
)
def test_of_ordinary_values_no_formula_leaves_any_to_the_steps(rng, options, path, ask, shapes):
    for shape in shapes:
        run = getattr(op.Composer(**options).compose(path), ask)
        for _ in range(4):
            run(**given(rng, shape))
        Turning.seen.clear()
        run(**given(rng, shape))
        assert Turning.seen == [], shape


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_faint_light_alone_is_left_to_the_steps(rng, engine):
    if not is_installed(engine):
        pytest.skip("not installed")
    path = op.Source(op.Parameter("i"), [1.0, 0.5, 0.3, 0.4]) >> Turning(B) >> op.Detector()
    plan = op.Composer(engine=engine).compose(path)
    for intensity, is_left in ((1.0, False), (1e-300, True)):
        values = {"i": np.full(3000, intensity), "b": rng.uniform(-1.0, 1.0, 3000)}
        plan.run(**values)  # An element's first values are looked at whether they are physical.
        Turning.seen.clear()
        plan.run(**values)
        assert bool(Turning.seen) == is_left


def many(value):
    if isinstance(value, op.CosSin):
        return op.CosSin(many(value.cos), many(value.sin))
    return np.full(2000, value)


@rows("sign", [1, -1])
@rows("rotator", [op.Rotator, Turning])
@rows("angle", [0.3, 1.2, 2.0, -0.7])
def test_an_angle_and_its_pair_turn_light_alike(rotator, sign, angle):
    path = chain([rotator(A if sign > 0 else -A)], [1.0, 1.0, 0.0, 0.0])
    expected = [1.0, np.cos(2 * angle), sign * np.sin(2 * angle), 0.0]
    for value in (angle, op.CosSin(float(np.cos(angle)), float(np.sin(angle)))):
        plan = op.Composer(engine="numpy").compose(path)
        found = [plan.run(a=many(value)).stokes[-1]]
        # Of single runs, the later are compiled.
        found += [plan.run(a=value).stokes for _ in range(5)]
        np.testing.assert_allclose(found, [expected] * 6, rtol=0, atol=1e-15)


@pytest.mark.filterwarnings(
    "ignore::optipath.errors.AngleWarning"
)  # Of each run, as one test says.
@rows("most", [1.5, 3.0, 6.0, 1e3])
@rows("least", [0.0, -1.0])
def test_angles_up_to_any_limit_are_right(least, most):
    angles = np.linspace(least, most, 3001)
    limits = {"minimum": f"{least} rad", "maximum": f"{most} rad"}
    path = chain([op.Polarizer(op.Parameter("a", **limits))], [1.0, 1.0, 0.0, 0.0])
    plan = op.Composer(engine="numpy").compose(path)
    expected = np.cos(angles) ** 2
    if most > 2 * np.pi:
        with pytest.warns(op.errors.AngleWarning, match="parameter 'a' is a plain number"):
            plan.run(a=angles)
    np.testing.assert_allclose(plan.run(a=angles).intensity, expected, rtol=0, atol=1e-15)
    for place in (0, 7, 1000, 1500, 2000, 2900, 3000):
        found = plan.run(a=float(angles[place])).intensity
        np.testing.assert_allclose(found, expected[place], rtol=0, atol=1e-15)


def test_an_operation_is_kept_once_and_what_changes_nothing_left_out():
    recorder = Recorder(np.dtype("float64"))
    x, y = recorder.input("x"), recorder.input("y")
    assert x * y is y * x
    assert (x - y) is not (y - x)
    assert len(recorder.symbols) == 5
    x = recorder.input("x")
    negative = -x
    chosen = SYMBOLIC.where(True, x, 3.0)  # noqa: FBT003 - a condition that is known
    for same in (x + 0.0, 1.0 * x, -negative, chosen):
        assert same is x
    product = recorder.input("x") * 0.0
    assert not isinstance(product, Symbol)
    assert product == 0.0


def test_numbers_are_of_the_precision_of_the_record_and_whole_ones_like_those_beside_them():
    x = Recorder(np.dtype("float32")).input("x")
    third = (x * (np.float32(1.0) / np.float32(3.0))).operands[1]
    assert third.dtype == (x + 0.1).operands[1].dtype == np.float32
    x = Recorder(np.dtype("float64")).input("x")
    assert (4 * x).operands[0].dtype == np.float64
    exponent = SYMBOLIC.scaling(x)
    assert ((exponent + 1).kind, SYMBOLIC.ldexp(x, exponent).kind) == ("int", "float")


def test_what_is_known_of_numbers_is_not_asked_and_what_is_not_is_no_truth():
    x = Recorder(np.dtype("float64")).input("x")
    square = x * x
    assert abs(square) is SYMBOLIC.maximum(square, 0.0) is square
    assert SYMBOLIC.minimum(square, 0.0) == 0.0
    assert not (square < 0.0)
    with pytest.raises(TypeError, match=r"xp\.where"):
        bool(x > 0.0)
