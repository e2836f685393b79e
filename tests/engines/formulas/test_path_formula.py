"""Formulas of whole paths: what they are asked is not left to the steps, silently and slower."""

from typing import ClassVar

import numpy as np
import pytest

import optipath as op
from optipath.engines.automatic import is_installed
from tables import rows


class Watching(op.Element):
    """A rotator that notes when it is computed with numbers: a formula asks it once, in symbols."""

    turn: op.Angle
    seen: ClassVar[list] = []

    @staticmethod
    def mueller_rows(xp, turn):
        if isinstance(turn, (float, np.ndarray, np.generic)):
            Watching.seen.append(np.shape(turn))
        c, s = xp.cos(2.0 * turn), xp.sin(2.0 * turn)
        return (1.0, 0.0, 0.0, 0.0), (0.0, c, -s, 0.0), (0.0, s, c, 0.0), (0.0, 0.0, 0.0, 1.0)


def watched(reads="stokes", *, loops=False):
    """A path of many sorts of element, all of whose numbers are given."""
    path = op.PathGraph(loops="sum")
    elements = {
        "metal": op.Interface(
            op.Material(op.Parameter("m"), op.Parameter("k")),
            op.Parameter("a"),
            outside=op.Parameter("n"),
        ),
        "watch": Watching(op.Parameter("b")),
        "plate": op.Retarder(op.Parameter("c"), op.Parameter("a"), azimuth=op.Parameter("b")),
        "cell": op.Medium(op.Parameter("l"), op.Parameter("d"), rotation=op.Parameter("w")),
        "glass": op.Interface(1.5, op.Parameter("a"), outside=op.Parameter("n")),
        "foil": op.Diattenuator(0.9, op.Parameter("t"), op.Parameter("b")),
        "rod": op.FaradayRotator(verdet=op.Parameter("v"), field=2.0, length=op.Parameter("l")),
        "quartz": op.Waveplate(1e-3, op.Parameter("q"), 1e-3, op.Parameter("b")),
        "circular": op.CircularPolarizer("left", op.Parameter("t"), op.Parameter("e")),
    }
    node = path.add("lamp", op.Source(stokes=[1.0, 0.5, 0.3, 0.4]))
    for name, element in elements.items():
        node = node >> path.add(name, element)
    if loops:
        path.add("split", op.BeamSplitter(0.5))
        path.add("back", op.BeamSplitter(op.Parameter("t")))
        path.connect("circular.out", "split.in")
        path.connect("split.transmitted", "back.in")
        path.connect("back.reflected", "split.back", azimuth=op.Parameter("b"))
        path.add("eye", op.Detector(reads))
        path.connect("back.transmitted", "eye.in")
        return path
    node >> path.add("eye", op.Detector(reads))
    return path


def given(rng, shape):
    """Ordinary values; along two axes where there are two."""
    spans = {"n": (1.1, 1.4), "m": (1.1, 1.4), "a": (0.2, 0.6), "b": (-1.0, 1.0)}
    spans |= dict.fromkeys("kcldwtvqe", (0.1, 0.9))
    shapes = dict.fromkeys(spans, shape)
    if len(shape) == 2:
        shapes |= {"a": (shape[0], 1), "b": (1, shape[1]), "n": (1, shape[1])}
    values = {name: rng.uniform(*spans[name], shapes[name]) for name in shapes}
    return {name: value if shape else float(value) for name, value in values.items()}


RUNS = {
    "light": ({}, "stokes", lambda plan: plan.run),
    "light in single precision": ({"dtype": "float32"}, "stokes", lambda plan: plan.run),
    "an intensity": ({}, "intensity", lambda plan: plan.run),
    "an intensity within a tolerance": ({"tolerance": 0.5}, "intensity", lambda plan: plan.run),
    "a matrix": ({}, "stokes", lambda plan: plan.mueller),
    "a certificate": ({}, "intensity", lambda plan: plan.certificate),
}


def steps_seen(plan, run, rng, shape):
    """The shapes that steps are asked for when a plan is run once more."""
    for _ in range(4):
        run(plan)(**given(rng, shape))
    Watching.seen.clear()
    run(plan)(**given(rng, shape))
    return Watching.seen


@rows("shape", [(3000,), (60, 50)])
@rows("question", RUNS)
def test_of_ordinary_values_no_formula_leaves_any_to_the_steps(rng, question, shape):
    options, reads, run = RUNS[question]
    plan = op.Composer(engine="numpy", **options).compose(watched(reads))
    assert steps_seen(plan, run, rng, shape) == []


@rows("shape", [(), (3000,), (60, 50)])
def test_of_loops_no_formula_leaves_any_to_the_steps(rng, shape):
    plan = op.Composer(engine="numpy").compose(watched(loops=True))
    assert steps_seen(plan, lambda plan: plan.run_all, rng, shape) == []


@rows("shape", [(), (2,), (10,), (300,)])
def test_of_few_paths_that_have_run_before_no_formula_leaves_any_to_the_steps(rng, shape):
    plan = watched().compose()
    assert steps_seen(plan, lambda plan: plan.run, rng, shape) == []


def behind_a_lamp():
    path = op.PathGraph()
    lamp = path.add("lamp", op.Source(op.Parameter("i"), [1.0, 0.5, 0.3, 0.4]))
    lamp >> path.add("watch", Watching(op.Parameter("b"))) >> path.add("eye", op.Detector())
    return path


@pytest.mark.parametrize("engine", ["numpy", "numba"])
def test_faint_light_alone_is_left_to_the_steps(rng, engine):
    if not is_installed(engine):
        pytest.skip("not installed")
    plan = op.Composer(engine=engine).compose(behind_a_lamp())
    for intensity, is_left in ((1.0, False), (1e-300, True)):
        values = {"i": np.full(3000, intensity), "b": rng.uniform(-1.0, 1.0, 3000)}
        plan.run(**values)  # An element's first values are looked at whether they are physical.
        Watching.seen.clear()
        plan.run(**values)
        assert bool(Watching.seen) == is_left
