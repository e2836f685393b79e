"""Composing mixed paths of 10 to 100,000 elements, beside a walk of the same graph by hand.

What is by hand walks the graph by networkx and multiplies 4x4 matrices of NumPy from formulas; it
has light in the end, as composing with a first run has. Time should grow as the elements do.
"""

import numpy as np
import pytest

import optipath as op
from optipath.lab.bench import random_values
from optipath.lab.composition import LIGHT, MATRIX, mixed_path, walked
from subjects import COMPILED, finished, long

LENGTHS = [10, 1_000, *long(100, 10_000)]
lengths = pytest.mark.parametrize("length", LENGTHS)
every_length = pytest.mark.parametrize("length", [*LENGTHS, *long(100_000)])


def measured(benchmark, group, length, action):
    benchmark.group = f"{group}, {length:,} elements"
    rounds = max(3, 1_000 // length) if length <= 10_000 else 1
    benchmark.pedantic(action, rounds=rounds, warmup_rounds=int(rounds > 1))


def subject(length, count=1):
    """Return a path, its graph by hand, and values that give the same light by both."""
    path, graph = mixed_path(length)
    values = random_values(mixed_path(10)[0].compose(), count)
    if count == 1:
        values = {name: float(value[0]) for name, value in values.items()}
    if length > 10_000:
        return path, graph, values
    light = walked(graph, values, LIGHT)[..., 0]
    np.testing.assert_allclose(light, path.compose().run(**values).stokes, rtol=0, atol=1e-12)
    return path, graph, values


@every_length
def test_build(benchmark, length):
    measured(benchmark, "build", length, lambda: mixed_path(length))


@every_length
def test_compose(benchmark, length):
    path, _, _ = subject(length)
    measured(benchmark, "compose", length, lambda: op.Composer().compose(path))


@lengths
def test_compose_and_run(benchmark, length):
    path, _, values = subject(length)
    action = lambda: op.Composer().compose(path).run(**values).stokes  # noqa: E731
    measured(benchmark, "compose", length, action)


@every_length
def test_by_hand(benchmark, length):
    _, graph, values = subject(length)
    measured(benchmark, "compose", length, lambda: walked(graph, values, LIGHT))


@pytest.mark.parametrize("who", ["optipath", "by hand"])
@lengths
def test_light(benchmark, who, length):
    path, graph, values = subject(length)
    plan = path.compose()
    actions = {"optipath": lambda: plan.run(**values).stokes}
    actions["by hand"] = lambda: walked(graph, values, LIGHT)
    measured(benchmark, "light of one value", length, actions[who])


@pytest.mark.parametrize("who", ["by hand", *COMPILED])
@pytest.mark.parametrize("what", ["light", "matrices"])
@pytest.mark.parametrize("length", [10, *long(100)])
def test_batch(benchmark, what, who, length):
    path, graph, values = subject(length, 10_000)
    start = {"light": LIGHT, "matrices": MATRIX}[what]
    action = lambda: walked(graph, values, start)  # noqa: E731
    if who != "by hand":
        plan = op.Composer(engine=who).compose(path)
        action = {
            "light": lambda: finished(plan.run(**values).stokes),
            "matrices": lambda: finished(plan.mueller(**values).matrix),
        }[what]
    measured(benchmark, f"{what} of 10,000 values", length, action)
