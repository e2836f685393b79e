"""What each variable of a sweep costs, in nanoseconds of processor time a point.

python benchmarks/sweep_costs.py
"""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from click import echo

import optipath as op
from optipath.light.quantities import QUANTITIES
from optipath.sweeps.axes import grid_of
from optipath.sweeps.chunks import run_block
from optipath.sweeps.plan_recipe import PlanRecipe

if TYPE_CHECKING:
    from collections.abc import Callable

GOLD = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4, "filter": "horizontal"}
AXES = {
    "delta": np.linspace(0.01, 1.5, 100),
    "rho": np.linspace(0.0, 3.1, 100),
    "phi": np.linspace(0.01, 1.5, 100),
}


def cost(function: Callable[[], object], points: int) -> float:
    """Return the least of five runs."""
    taken = []
    for _ in range(5):
        began = time.process_time_ns()
        function()
        taken.append(time.process_time_ns() - began)
    return min(taken) / points


def table(path: op.PathGraph, axes: dict[str, object], given: dict[str, object]) -> None:
    """Print the costs of a path, by each engine."""
    for engine in ("numpy", "numba"):
        recipe = PlanRecipe.of(path, op.Composer(engine=engine))
        grid = grid_of(recipe.plan.inputs, axes | given)
        echo(f"{engine}: the light {cost(partial(run_block, recipe, grid), grid.points):.0f}")
    light = run_block(recipe, grid)
    began = time.process_time_ns()
    for several in light.lights:
        for each in several:
            _ = each.noise
    noise = (time.process_time_ns() - began) / grid.points
    told = [
        f"{each.variable} {cost(partial(light.of, each), grid.points):.0f}" for each in QUANTITIES
    ]
    echo(f"noise {noise:.0f}, {', '.join(told)}")


if __name__ == "__main__":
    echo("npgr026, ns a point:")
    table(op.load_preset("npgr026"), AXES, GOLD)
    echo("crossed polarisers, whose light is noise:")
    first = op.Polarizer(op.Parameter("angle"))
    crossed = op.Source(op.Parameter("power")) >> first >> op.Polarizer("90 deg") >> op.Detector()
    axes = {"power": np.linspace(1.0, 2.0, 1000), "angle": np.linspace(0.0, 1e-9, 1000)}
    table(crossed, axes, {})
