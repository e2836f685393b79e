"""Grid: the outer product of the axes of a sweep, and whether it fits in memory."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib import import_module
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ShapeError
from optipath.faults import Cure, Fault
from optipath.values.arrays import memory
from optipath.values.text import IdleValues

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.plan.plan import Plan
    from optipath.values.parameters import Parameter
    from optipath.values.text import AxisValues


@dataclass(frozen=True)
class SweepGrid:
    """The outer product of some axes; those of one dimension vary together."""

    axes: tuple[SweepAxis, ...]
    fixed: Mapping[str, Any] = field(default_factory=dict)
    labels: Mapping[str, tuple[Any, str]] = field(default_factory=dict)

    @cached_property
    def sizes(self) -> dict[str, int]:
        """How many values each dimension has, in order."""
        return {axis.dimension: len(axis) for axis in self.axes}

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the grid."""
        return tuple(self.sizes.values())

    @property
    def points(self) -> int:
        """How many paths it has."""
        return prod(self.shape)

    @property
    def varied(self) -> SweepGrid:
        """The same grid with one value along each dimension on which nothing depends."""
        held = {axis.dimension for axis in self.axes if not axis.idle}
        if len(held) == len(self.sizes):
            return self
        return self.part([slice(0, None if name in held else 1) for name in self.sizes])

    def part(self, region: Sequence[slice]) -> SweepGrid:
        """Return a part of the grid."""
        cuts = dict(zip(self.sizes, region, strict=True))
        axes = [
            replace(
                axis, shown=axis.shown[cuts[axis.dimension]], given=axis.given[cuts[axis.dimension]]
            )
            for axis in self.axes
        ]
        return replace(self, axes=tuple(axes))

    def given(self) -> dict[str, Any]:
        """Return what `Plan.run` is given for the grid."""
        results = dict(self.fixed)
        for axis in self.axes:
            if not axis.idle:
                shape = [-1 if name == axis.dimension else 1 for name in self.sizes]
                results[axis.name] = axis.given.reshape(shape)
        return results


@dataclass(frozen=True)
class SweepAxis:
    """The values that one parameter takes in a sweep. Shapes: shown (count,); given (count,)."""

    name: str
    dimension: str
    shown: npt.NDArray[Any]
    unit: str
    given: npt.NDArray[Any]
    help: str = ""
    idle: bool = False

    def __len__(self) -> int:
        return len(self.given)


def sweep_axis(
    known: Mapping[str, Parameter], name: str, values: AxisValues, dimension: str = ""
) -> SweepAxis:
    """Return the axis of a parameter."""
    idle = isinstance(values, IdleValues)
    message = "nothing depends on it" if idle else known[name].help
    return SweepAxis(name, dimension or name, *values, message, idle)


_LITTLE, _MOST_BYTES = 2**26, 2**9
"""What memory nobody misses, and what a point takes at most."""


def refuse_more_than_free(plan: Plan, grid: SweepGrid) -> None:
    """Refuse a sweep in memory that takes more than there is."""
    if grid.points * _MOST_BYTES <= _LITTLE:
        return
    needed = grid.points * bytes_of_a_point(plan, grid.points)
    if needed <= (free := free_memory()):
        return
    sizes = " x ".join(f"{size:,}" for size in grid.shape)
    cure = Cure(
        "give chunks='auto' for Dask arrays, store='sweep.zarr' to keep it on disk, or fewer "
        "values",
        "write it to a file by 'optipath sweep ... --out FILE.zarr' (or .nc, .csv), or give fewer "
        "values",
    )
    needs = f"a sweep of {sizes} points needs {_text(needed)}, and {_text(free)} is free"
    raise ShapeError(Fault(needs, cure))


def bytes_of_a_point(plan: Plan, points: int) -> int:
    """Return how many bytes a run takes for each point, with what is made on the way."""
    # Jones columns keep exponents, as what is run step by step does.
    stepped = plan.composing == "jones" or "step by step" in plan.engine_for(points)
    return plan.answers.question.numbers(stepped=stepped) * np.dtype(plan.dtype).itemsize


def free_memory() -> int:
    """Return how many bytes this process may still take."""
    try:
        psutil: Any = import_module("psutil")  # Dask's cluster brings it.
    except ImportError:
        return memory()
    free = [memory(), int(psutil.virtual_memory().available)]
    for name in ("memory.max", "memory/memory.limit_in_bytes"):  # Of a container, on Linux.
        with suppress(OSError, ValueError):  # No such file, or "max".
            limit = int((Path("/sys/fs/cgroup") / name).read_text("ascii"))
            free.append(max(0, limit - psutil.Process().memory_info().rss))
    return min(free)


def _text(size: int) -> str:
    return f"{size / 1e9:,.1f} GB"
