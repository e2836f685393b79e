"""What tells one sweep from all others, so that blocks of it can be kept and found again."""

from __future__ import annotations

from hashlib import sha256
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.sweeps.axes.sweep_axis import SweepAxis
    from optipath.sweeps.axes.sweep_grid import SweepGrid
    from optipath.sweeps.chunked.plan_recipe import PlanRecipe

LAYOUT = 1
"""The version of what a store of a sweep has in it."""


def sweep_identity(
    recipe: PlanRecipe, grid: SweepGrid, sizes: Mapping[str, int], types: Mapping[str, str]
) -> str:
    """Return all of what a sweep computes, a line each, so that the first other one can be told."""
    lines = [f"a sweep by optipath {version('optipath')}, layout {LAYOUT}"]
    lines += [f"option {name}: {value!r}" for name, value in recipe.options]
    lines += [f"element class {' '.join(each)}" for each in recipe.own]
    lines += [f"fixed {name}: {_single(grid, name)}" for name in grid.fixed]
    lines += [f"axis {axis.name}: {_told(axis)}" for axis in grid.axes]
    lines += [f"chunks of {name}: {size}" for name, size in sizes.items()]
    lines += [f"variable {name}: {each}" for name, each in types.items()]
    return "\n".join([*lines, recipe.text])


def _single(grid: SweepGrid, name: str) -> str:
    """Return what tells a fixed value from others: what is run, and how it was given."""
    value = repr(_plain(grid.fixed[name]))
    shown, unit = grid.labels.get(name, (grid.fixed[name], ""))
    label = f"{_plain(shown)} {unit}".rstrip()
    return value if label in (value, value.strip("'")) else f"{value}, given as {label}"


def _plain(value: Any) -> Any:
    """Return a single number of NumPy as one of Python: they are the same sweep."""
    return value.item() if isinstance(value, np.generic | np.ndarray) else value


def _told(axis: SweepAxis) -> str:
    """Return what tells an axis from all others, to the last bit."""
    ends = f"{axis.shown[0]} to {axis.shown[-1]} {axis.unit}".rstrip()
    digest = sha256()
    for values in (axis.given, axis.shown):
        held = values.tobytes() if values.dtype.kind != "O" else repr(values.tolist()).encode()
        digest.update(f"{values.dtype.str} {values.shape} ".encode() + held)
    return f"{len(axis)} values, {ends}, along {axis.dimension}, {digest.hexdigest()[:16]}"
