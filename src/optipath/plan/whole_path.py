"""WholePath: what a path as it stands gives: its matrices, and bounds of its intensities."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines import COMPILED, NUMPY_STEPS
from optipath.engines.formulas import bounds_formula, matrix_formula
from optipath.errors import ParameterError
from optipath.plan.certificate import Certificate
from optipath.plan.running.found import joined
from optipath.plan.running.runner import Runner

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.engines.formulas import Formula
    from optipath.engines.program.program import Reading
    from optipath.plan.running.reading import ResolvedInputs

    Array = np.ndarray[Any, Any]


class WholePath(Runner):
    """Runs a path of which nothing is left out."""

    def matrix(self, source: str, reading: Reading, parameters: Mapping[str, Any]) -> Array:
        """Return the Mueller matrices (..., 4, 4) from a source to a reading.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if a matrix is not finite.
        """
        if self.is_for_jax(parameters):
            resolved, batch = self.inputs.resolve(parameters)
            name = next(n for n, end in self.program.readings.items() if end is reading)
            with self.enough_for(batch, 16, twice=True):
                found, sound = self.jax.matrix(resolved, batch, parameters, source, name)
            if not self.traces(resolved) and not np.all(sound):
                given = self.sorter.sort(parameters)
                parts = [self.interpreter.matrix(p, source, reading) for p in self.parts(given)]
                found = joined(parts, given.batch, (4, 4))
            found = self.nan_outside(found, resolved, 2)
            self.refuse_infinite(found[..., : reading.components, :])
            return found  # type: ignore[no-any-return]
        given = self.sorter.sort(parameters)

        def fallback(part: ResolvedInputs) -> Array:
            found = self.interpreter.matrix(part, source, reading)
            self.refuse_infinite(found[..., : reading.components, :])
            return found

        def formula(forms: Any, axes: Any) -> Formula:
            limits, kind = self.inputs.limits, self.dtype.name
            return matrix_formula(self.program, source, reading, kind, forms, limits, axes)

        engine = self.engine_for(given.paths)
        with self.enough_for(given.batch, 16, twice=True):
            if engine == NUMPY_STEPS:
                self.inputs.resolve(parameters)
                return joined([fallback(part) for part in self.parts(given)], given.batch, (4, 4))
            out, _ = self.filled(
                engine,
                (source, reading.light, reading.components),
                formula,
                given,
                parameters,
                lambda part: np.moveaxis(fallback(part).reshape(-1, 16), -1, 0),
                16,
            )
            rows = self.block(out, 0, 16).reshape(4, 4, *given.batch)
            return np.moveaxis(rows, (0, 1), (-2, -1))

    def given(self, parameters: Mapping[str, Any]) -> ResolvedInputs:
        """Return what is given, for both the bounds and the light.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if light goes round.
        """
        if self.program.loops:
            raise ParameterError(
                "there are no certificates for light that goes round in a loop; run the path, "
                "which is exact"
            )
        self.refuse_traced(parameters, "certificates are made")
        return self.sorter.sort(parameters)

    def certificates(
        self, given: ResolvedInputs, parameters: Mapping[str, Any]
    ) -> dict[str, Certificate]:
        """Return bounds of the intensity at every end.

        Raises
        ------
        ParameterError
            If a value is out of its range, or a Mueller matrix unphysical.
        """
        ends = self.program.readings
        stepped = self.engine_for(given.paths) not in COMPILED
        with self.enough_for(given.batch, 4 * len(ends), twice=stepped):
            if stepped:
                self.inputs.resolve(parameters)
                parts = [self._fallback(part) for part in self.parts(given)]
                rows = np.concatenate(parts, axis=1)
            else:
                rows = self._bounds(None, given, parameters, self._fallback, 4 * len(ends))
        each = rows.reshape(len(ends), 4, *given.batch)
        return {
            name: Certificate(*map(np.asarray, found[:3]))
            for name, found in zip(ends, each, strict=True)
        }

    def errors(
        self, model: str, given: ResolvedInputs, parameters: Mapping[str, Any]
    ) -> tuple[dict[str, Array], Array]:
        """Return the scalar intensity at every end, and the largest error of a model at any.

        Raises
        ------
        ParameterError
            If a value is out of its range, or a Mueller matrix unphysical.
        """
        ends = self.program.readings

        def found(part: ResolvedInputs) -> Array:
            each = self.certificates(part, parameters).values()
            totals = [one.scalar.reshape(-1) for one in each]
            return np.array(
                [*totals, np.max([one.error_of(model).ravel() for one in each], axis=0)]
            )

        with self.enough_for(given.batch, len(ends) + 1, twice=False):
            if self.engine_for(given.paths) not in COMPILED:
                rows = found(given)
            else:
                rows = self._bounds(model, given, parameters, found, len(ends) + 1)
        *totals, error = (row.reshape(given.batch) for row in rows)
        return dict(zip(ends, totals, strict=True)), error

    def _fallback(self, given: ResolvedInputs) -> Array:
        """Return the bounds of a part, step after step."""
        return np.concatenate([rows.reshape(4, -1) for rows in self.interpreter.bounds(given)])

    def _bounds(
        self,
        model: str | None,
        given: ResolvedInputs,
        parameters: Mapping[str, Any],
        fallback: Callable[[ResolvedInputs], Array],
        count: int,
    ) -> Array:
        """Return the results of a formula of bounds, shape (results, paths)."""

        def formula(forms: Any, axes: Any) -> Formula:
            kind, limits = self.dtype.name, self.inputs.limits
            return bounds_formula(self.program, kind, forms, limits, axes, model)

        engine, what = self.engine_for(given.paths), ("bounds", model)
        out, _ = self.filled(engine, what, formula, given, parameters, fallback, count)
        return self.block(out, 0, count)
