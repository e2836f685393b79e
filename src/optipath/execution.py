"""Execution: a program run by an engine, in the way of carrying light that it needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines import numpy_engine
from optipath.errors import ParameterError
from optipath.faint import folded, is_faint
from optipath.kernels import NUMPY, Jones, Linear, Plain, Scaled
from optipath.precision import wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from optipath.kernels import Components, Way
    from optipath.parameters import Resolved
    from optipath.program import Program, Reading

_LONG = 16
_PLAIN, _SCALED, _JONES, _LINEAR = Plain(NUMPY), Scaled(NUMPY), Jones(NUMPY), Linear(NUMPY)


class Found(NamedTuple):
    """The light at an end: its Stokes vectors, times two to the power of an exponent."""

    stokes: npt.NDArray[Any]
    exponent: npt.NDArray[Any]


class Execution:
    """One run of a program.

    Parameters
    ----------
    program : Program
        The steps.
    given : mapping of str to Resolved
        The values of the open parameters.
    batch : tuple of int
        The shape that they broadcast to.
    composing, dtype, method : str
        How light is carried, in which precision, and how Fresnel's equations are
        computed (for what is said when a number is not finite).
    """

    def __init__(
        self,
        program: Program,
        given: Mapping[str, Resolved],
        batch: tuple[int, ...],
        *,
        composing: str,
        dtype: str,
        method: str,
    ) -> None:
        self.program = program
        self.batch = batch
        self.composing = composing
        self.dtype = np.dtype(dtype)
        self.method = method
        numbers = (view.numbers(given, wide(self.dtype)) for view in program.leaves)
        with np.errstate(over="ignore", under="ignore"):  # What is not finite is told later.
            self._leaves = [
                n if n.dtype == bool else n.astype(self.dtype, copy=False) for n in numbers
            ]

    def lights(self) -> dict[str, Found]:
        """Return the light at every detector and dump.

        Raises
        ------
        ParameterError
            If it is not finite.
        """
        way = self._way()
        found = self._run(way)
        if way is _PLAIN and any(np.any(is_faint(f.stokes[..., 0])) for f in found.values()):
            found = self._run(_SCALED)
        return {name: Found(*folded(*light)) for name, light in found.items()}

    def matrix(self, source: str, reading: Reading) -> npt.NDArray[Any]:
        """Return the Mueller matrix from a source to a reading.

        Raises
        ------
        ParameterError
            If it is not finite.
        """
        dimensions = max((leaf.ndim for leaf in self._leaves), default=0)
        columns = np.eye(4, dtype=self.dtype).reshape(4, 4, *[1] * dimensions)
        none = self.dtype.type(0.0)
        emitted: dict[int, Components] = {
            step: (none, none, none, none) for step, _ in self.program.sources.values()
        }
        begin, _ = self.program.sources[source]
        emitted[begin] = columns[:, 0], columns[:, 1], columns[:, 2], columns[:, 3]
        lights = numpy_engine.run(self.program, self._leaves, _LINEAR, emitted)
        found = self._stacked(*lights[reading.light], (4, *self.batch), reading)
        return np.ascontiguousarray(np.moveaxis(found.stokes, 0, -1))

    def _way(self) -> Way:
        if self.composing == "jones":
            return _JONES
        return _SCALED if len(self.program.steps) > _LONG else _PLAIN

    def _run(self, way: Way) -> dict[str, Found]:
        lights = numpy_engine.run(self.program, self._leaves, way)
        return {
            name: self._stacked(*lights[reading.light], self.batch, reading)
            for name, reading in self.program.readings.items()
        }

    def _stacked(
        self, components: Any, exponent: Any, batch: tuple[int, ...], reading: Reading
    ) -> Found:
        stokes = np.full((*batch, 4), np.nan, dtype=self.dtype)
        for component in range(reading.components):
            stokes[..., component] = components[component]
        if not np.all(np.isfinite(stokes[..., : reading.components])):
            raise ParameterError(
                f"the light is not finite in {self.dtype} by method '{self.method}': a value is "
                f"too extreme; give values nearer to 1"
                + ("" if self.method == "stable" else ", or use method 'stable'")
            )
        return Found(stokes, np.broadcast_to(exponent, batch))
