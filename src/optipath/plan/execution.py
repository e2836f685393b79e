"""Execution: the light that a reduced program gives, one path or millions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines import NUMPY_STEPS
from optipath.errors import ParameterError
from optipath.light.underflow import folded
from optipath.plan.running.found import Found, in_shape, joined
from optipath.plan.running.pieces import pieces
from optipath.plan.running.runner import CACHED, Runner, RunOptions
from optipath.plan.running.scalar_runner import ScalarRunner

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.engines.formulas import Formula
    from optipath.engines.program.reduction import Reduction
    from optipath.plan.running.batch_runner import Results
    from optipath.plan.running.interpreter import Shared
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.values.inputs import Inputs

    Array = np.ndarray[Any, Any]

_IN_PARTS = "take it in smaller parts, plan.stream(size, ...), or give fewer values"


class Execution(Runner):
    """Runs what is left of a path, and gives the light at its ends.

    Parameters
    ----------
    reduction : Reduction
        The steps.
    inputs : Inputs
        What may be given.
    options : RunOptions
        How they are run.
    """

    def __init__(self, reduction: Reduction, inputs: Inputs, options: RunOptions) -> None:
        program = reduction.program
        super().__init__(program, inputs, options, unreduced=reduction.unreduced)
        self.single = ScalarRunner(program, inputs, self.interpreter, lambda: self.compilable)

    def lights(self, parameters: Mapping[str, Any]) -> dict[str, Found]:
        """Return the light at every detector and dump.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if light is not finite.
        """
        lights = self.single.fast_path(parameters)
        if lights is not None:
            return self._named(lights)
        if self.is_for_jax(parameters):
            resolved, batch = self.inputs.resolve(parameters)
            with self.enough_for(batch, 4 * len(self.program.readings), twice=True):
                found, sound = self.jax.lights(resolved, batch, parameters)
            if not self.traces(resolved) and not np.all(sound):
                # Loops that need a closer look get the same one by every engine.
                return self._stepped(self.sorter.sort(parameters))
            found = [self.nan_outside(stokes, resolved, 1) for stokes in found]
            for stokes, reading in zip(found, self.program.readings.values(), strict=True):
                self.refuse_infinite(stokes[..., : reading.components])
            return {n: Found(s, 0) for n, s in zip(self.program.readings, found, strict=True)}
        return self.lights_of(self.sorter.sort(parameters), parameters)

    def stream(
        self, size: int, parameters: Mapping[str, Any]
    ) -> Iterator[tuple[Any, dict[str, Found]]]:
        """Yield the index of a part of the batch, and the light at every end for it."""
        if self.is_for_jax(parameters):
            raise ParameterError(
                "a stream is not for JAX, which keeps a batch whole; use run, or engine 'numba'"
            )
        given = self.sorter.sort(parameters)
        for piece in pieces(given.batch, size):
            yield piece.where, self.lights_of(given.part(piece.where), parameters)

    def lights_of(self, given: ResolvedInputs, parameters: Mapping[str, Any]) -> dict[str, Found]:
        """Return the light at every end for what is given."""
        ends = self.program.readings
        if not given.batch and self.dtype == np.float64 and given.is_single:
            lights = self.single.lights(given)
            if lights is not None:
                return self._named(lights)
        engine = self.engine_for(given.paths)
        # Step after step, light comes with exponents, and its parts are put together.
        stepped = engine == NUMPY_STEPS
        numbers = (5 if stepped else 4) * len(ends)
        with self.enough_for(given.batch, numbers, twice=stepped, cure=_IN_PARTS):
            if not stepped:
                return self._compiled(engine, given, parameters)
            self.inputs.resolve(parameters)
            return self._stepped(given)

    def _compiled(
        self, engine: str, given: ResolvedInputs, parameters: Mapping[str, Any]
    ) -> dict[str, Found]:
        """Return the light at every end, by a formula."""
        ends = self.program.readings

        def formula(forms: Any, axes: Any) -> Formula:
            return self.lights_formula(forms, axes=axes, unreduced=self.unreduced)

        def fallback(part: ResolvedInputs) -> Array:
            found = self._fallback(part)
            rows = [np.moveaxis(f.stokes.reshape(-1, 4), -1, 0) for f in found]
            return np.concatenate([*rows, [f.exponent.ravel() for f in found]])

        read = 4 * len(ends)
        out, underflow = self.filled(engine, "lights", formula, given, parameters, fallback, read)
        return {
            name: self._found(out, end, reading.components, given, underflow=underflow)
            for end, (name, reading) in enumerate(ends.items())
        }

    def _stepped(self, given: ResolvedInputs) -> dict[str, Found]:
        """Return the light at every end, step after step."""
        ends = self.program.readings
        several = given.paths > CACHED and not self.unreduced
        shared = self.interpreter.shared(given) if several else {}
        parts = [self._fallback(part, shared) for part in self.parts(given)]
        lights = [
            Found(
                joined([part[end].stokes for part in parts], given.batch, (4,)),
                joined([part[end].exponent for part in parts], given.batch, ()),
            )
            for end in range(len(ends))
        ]
        return dict(zip(ends, lights, strict=True))

    def _found(
        self, out: Results, end: int, count: int, given: ResolvedInputs, *, underflow: bool
    ) -> Found:
        """Return the light at an end, of which some components are read."""
        first = 4 * end
        if not underflow and (count < 4 or out.together(first, first + 4) is None):
            components: list[Any] = [*out.each[first : first + count], *[np.nan] * (4 - count)]
            if not isinstance(components[0], np.ndarray):
                components[0] = np.full(given.paths, components[0], self.dtype)
            return Found(tuple(in_shape(c, given.batch) for c in components), 0)
        block = self.block(out, first, first + 4)
        block[count:] = np.nan
        stokes = np.moveaxis(block.reshape(4, *given.batch), 0, -1)
        if not underflow:
            return Found(stokes, 0)
        power = out.each[4 * len(self.program.readings) + end]
        exponent = np.broadcast_to(power, given.paths).astype(np.int64)
        return Found(*folded(stokes, exponent.reshape(given.batch)))

    def _named(self, lights: list[tuple[Any, ...]]) -> dict[str, Found]:
        """Return lights of plain floats by the names of their ends."""
        return {
            name: Found(light[:4], light[4])
            for name, light in zip(self.program.readings, lights, strict=True)
        }

    def _fallback(self, given: ResolvedInputs, shared: Shared | None = None) -> list[Found]:
        found = [Found(*light) for light in self.interpreter.lights(given, shared)]
        for light, reading in zip(found, self.program.readings.values(), strict=True):
            self.refuse_infinite(light.stokes[..., : reading.components])
        return found
