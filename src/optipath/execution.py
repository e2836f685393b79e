"""Execution: runs a program on what is given, one path or millions, by the engine that fits."""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.certificate import Certificate
from optipath.engines import NUMPY_STEPS, compile_array_path, engine_for, jax_path
from optipath.errors import ParameterError
from optipath.faint import folded
from optipath.formulas import bounds_formula, lights_formula, matrix_formula
from optipath.jax_values import is_jax, is_traced
from optipath.running.given import Given, Sorter
from optipath.running.layout import Layout
from optipath.running.many import Many, known_arrays
from optipath.running.pieces import pieces
from optipath.running.single import Single
from optipath.running.stepwise import Stepwise, way_of
from optipath.views import MANY, ONE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from optipath.formulas import Formula
    from optipath.inputs import Inputs
    from optipath.kernels import Way
    from optipath.program import Program, Reading
    from optipath.reduction import Reduction
    from optipath.running.many import Results
    from optipath.running.stepwise import Shared

    Array = np.ndarray[Any, Any]

_CACHED = 8192
"""How many paths are taken at once, step after step."""


class Found(NamedTuple):
    """The light at an end: its Stokes vectors, times two to the power of an exponent.

    `stokes` is an array (..., 4), or a tuple of its four components.
    """

    stokes: Any
    exponent: Any

    def whole(self, batch: tuple[int, ...]) -> tuple[Array, Array]:
        """Return Stokes vectors (..., 4) and exponents (...) as arrays."""
        if not isinstance(self.stokes, tuple):
            return self.stokes, np.broadcast_to(self.exponent, batch)
        parts = [np.broadcast_to(part, batch) for part in self.stokes]
        return np.stack(parts, axis=-1), np.broadcast_to(self.exponent, batch)


class Execution:
    """Runs a program, and keeps what has been compiled for it.

    Parameters
    ----------
    reduction : Reduction
        The steps that give light.
    whole : Program
        The steps that give matrices.
    inputs : Inputs
        What may be given.
    method, composing, dtype, engine : str
        As `Composer` takes them.
    threads : int
        How many threads share a large batch.

    Attributes
    ----------
    longest : int
        How many steps are compiled in one piece.
    """

    longest = 64

    def __init__(
        self,
        reduction: Reduction,
        whole: Program,
        inputs: Inputs,
        *,
        method: str,
        composing: str,
        dtype: str,
        engine: str,
        threads: int,
    ) -> None:
        program = reduction.program
        self.program = program
        self.whole = whole
        self.as_it_stands = reduction.as_it_stands
        self.inputs = inputs
        self.method = method
        self.dtype = np.dtype(dtype)
        self.engine = engine
        self.threads = threads
        self.way = way_of(program, composing)
        self.sorter = Sorter(program, inputs, self.dtype)
        self.stepwise = Stepwise(program, self.way, self.dtype)
        self.single = Single(program, inputs, self.stepwise, lambda: self.compilable)
        self._many: dict[Any, Many] = {}

    @cached_property
    def compilable(self) -> bool:
        """Whether the program can be made a formula."""
        kind = self.dtype.name
        if len(self.program.steps) > self.longest or kind not in ("float64", "float32"):
            return False
        forms = dict.fromkeys((v.raw for v in self.program.leaves if not v.known), ONE)
        limits = self.inputs.limits
        try:
            lights_formula(self.program, self.way, kind, forms, limits, polynomials=True)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            return False
        return True

    def engine_for(self, count: int) -> str:
        """Return the engine for a batch of so many paths."""
        return engine_for(self.engine, count, compilable=self.compilable)

    def lights(self, parameters: Mapping[str, Any]) -> dict[str, Found]:
        """Return the light at every detector and dump.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if light is not finite.
        """
        lights = self.single.usual(parameters)
        if lights is not None:
            return self._named(lights)
        if self.is_for_jax(parameters):
            resolved, batch = self.inputs.resolve(parameters)
            found = self._jax.lights(resolved, batch)
            for stokes, reading in zip(found, self.program.readings.values(), strict=True):
                self._refuse_infinite(stokes[..., : reading.components])
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
        for where, part in self.parts(self.sorter.sort(parameters), size):
            yield where, self.lights_of(part, parameters)

    def parts(self, given: Given, size: int) -> Iterator[tuple[Any, Given]]:
        """Yield the index of each part of what is given, and the part."""
        return ((piece.where, given.part(piece.where)) for piece in pieces(given.batch, size))

    def matrix(self, source: str, reading: Reading, parameters: Mapping[str, Any]) -> Array:
        """Return the Mueller matrices (..., 4, 4) from a source to a reading.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if a matrix is not finite.
        """
        if self.is_for_jax(parameters):
            resolved, batch = self.inputs.resolve(parameters)
            name = next(n for n, end in self.whole.readings.items() if end is reading)
            found = self._whole_jax.matrix(resolved, batch, source, name)
            self._refuse_infinite(found[..., : reading.components, :])
            return found  # type: ignore[no-any-return]
        given = self._whole_sorter.sort(parameters)

        def careful(part: Given) -> Array:
            found = self._whole_steps.matrix(part, source, reading)
            self._refuse_infinite(found[..., : reading.components, :])
            return found

        engine = self.engine_for(given.paths)
        if engine == NUMPY_STEPS:
            self.inputs.resolve(parameters)
            return _joined([careful(part) for part in self._parts(given)], given.batch, (4, 4))

        def formula(forms: Any, axes: Any) -> Formula:
            limits, kind = self.inputs.limits, self.dtype.name
            return matrix_formula(self.whole, source, reading, kind, forms, limits, axes)

        out, _ = self._filled(
            engine,
            (source, reading.light, reading.components),
            formula,
            given,
            parameters,
            lambda part: np.moveaxis(careful(part).reshape(-1, 16), -1, 0),
            16,
        )
        block = out.together(0, 16)
        block = self._stacked(out, 0, 16) if block is None else block
        return np.moveaxis(block.reshape(4, 4, *given.batch), (0, 1), (-2, -1))

    def given(self, parameters: Mapping[str, Any]) -> Given:
        """Return what is given, checked, for both the bounds and the light.

        Raises
        ------
        ParameterError
            With every fault of what is given.
        """
        self.inputs.resolve(parameters)
        return self._whole_sorter.sort(parameters)

    def certificates(self, given: Given, parameters: Mapping[str, Any]) -> dict[str, Certificate]:
        """Return bounds of the intensity at every end."""
        ends = self.whole.readings
        engine = self.engine_for(given.paths)
        if engine not in ("numpy", "numba"):
            parts = [self._whole_steps.bounds(part) for part in self._parts(given)]
            joined = [
                np.concatenate([part[end].reshape(4, -1) for part in parts], axis=1)
                for end in range(len(ends))
            ]
        else:

            def formula(forms: Any, axes: Any) -> Formula:
                kind, limits = self.dtype.name, self.inputs.limits
                return bounds_formula(self.whole, kind, forms, limits, axes)

            def careful(part: Given) -> Array:
                found = self._whole_steps.bounds(part)
                return np.concatenate([rows.reshape(4, -1) for rows in found])

            read = 4 * len(ends)
            out, _ = self._filled(engine, "bounds", formula, given, parameters, careful, read)
            joined = [self._stacked(out, 4 * end, 4 * end + 4) for end in range(len(ends))]
        shaped = (rows[:3].reshape(3, *given.batch) for rows in joined)
        return {name: Certificate(*rows) for name, rows in zip(ends, shaped, strict=True)}

    def lights_of(self, given: Given, parameters: Mapping[str, Any]) -> dict[str, Found]:
        """Return the light at every end for what is given."""
        ends = self.program.readings
        if not given.batch and self.dtype == np.float64 and given.is_single:
            lights = self.single.lights(given)
            if lights is not None:
                return self._named(lights)
        engine = self.engine_for(given.paths)
        if engine == NUMPY_STEPS:
            self.inputs.resolve(parameters)
            several = given.paths > _CACHED and not self.as_it_stands
            shared = self.stepwise.shared(given) if several else {}
            parts = [self._careful(part, shared) for part in self._parts(given)]
            joined = [
                Found(
                    _joined([part[end].stokes for part in parts], given.batch, (4,)),
                    _joined([part[end].exponent for part in parts], given.batch, ()),
                )
                for end in range(len(ends))
            ]
            return dict(zip(ends, joined, strict=True))

        def formula(forms: Any, axes: Any) -> Formula:
            return lights_formula(
                self.program,
                self.way,
                self.dtype.name,
                forms,
                self.inputs.limits,
                polynomials=True,
                axes=axes,
                as_it_stands=self.as_it_stands,
            )

        def careful(part: Given) -> Array:
            found = self._careful(part)
            rows = [np.moveaxis(f.stokes.reshape(-1, 4), -1, 0) for f in found]
            return np.concatenate([*rows, [f.exponent.ravel() for f in found]])

        read = 4 * len(ends)
        out, faint = self._filled(engine, None, formula, given, parameters, careful, read)
        found = {}
        for end, (name, reading) in enumerate(ends.items()):
            first, count = 4 * end, reading.components
            block = out.together(first, first + 4) if count == 4 or faint else None
            if block is None and not faint:
                components = (*out.each[first : first + count], *[np.nan] * (4 - count))
                found[name] = Found(tuple(_in_shape(c, given.batch) for c in components), 0)
                continue
            block = self._stacked(out, first, first + 4) if block is None else block
            block[count:] = np.nan
            stokes = np.moveaxis(block.reshape(4, *given.batch), 0, -1)
            if faint:
                exponent = np.broadcast_to(out.each[read + end], given.paths).astype(np.int64)
                found[name] = Found(*folded(stokes, exponent.reshape(given.batch)))
            else:
                found[name] = Found(stokes, 0)
        return found

    def _stacked(self, results: Results, start: int, stop: int) -> Array:
        """Return results, some of which may be known, as an array (results, paths)."""
        rows = np.empty((stop - start, results.out.shape[1]), self.dtype)
        for row, result in zip(rows, results.each[start:stop], strict=True):
            row[...] = result
        return rows

    def is_for_jax(self, parameters: Mapping[str, Any]) -> bool:
        """Tell whether a run is asked of JAX: by name, or by what is given."""
        traced = self._has_traced or any(map(is_jax, parameters.values()))
        if traced and self.engine not in ("auto", "jax"):
            raise ParameterError(
                f"values of JAX were given, but the plan was composed for engine "
                f"'{self.engine}'; compose with engine='jax' or 'auto'"
            )
        return traced or self.engine == "jax"

    def operations(self) -> dict[str, dict[str, int]] | None:
        """Return how many operations a path takes, as it is run and as it stands.

        None for what cannot be compiled, and so not counted.
        """
        if not self.compilable or len(self.whole.steps) > self.longest:
            return None
        limits, kind = self.inputs.limits, self.dtype.name

        def counted(program: Program, way: type[Way], *, as_it_stands: bool) -> dict[str, int]:
            forms = dict.fromkeys((v.raw for v in program.leaves if not v.known), MANY)
            formula = lights_formula(
                program, way, kind, forms, limits, polynomials=False, as_it_stands=as_it_stands
            )
            return formula.operations

        return {
            "plan": counted(self.program, self.way, as_it_stands=self.as_it_stands),
            "full": counted(self.whole, self.way, as_it_stands=True),
        }

    def evaluations(self, parameters: Mapping[str, Any]) -> dict[str, int]:
        """Return how often the numbers of each step are computed for a batch."""
        given = self.sorter.sort(parameters)
        self.inputs.resolve(parameters)
        if self.as_it_stands:
            return {s.label: given.paths for s in self.program.steps if s.evaluation is not None}
        known = self._known_arrays
        found: dict[str, int] = {}
        for step in self.program.steps:
            if step.evaluation is None:
                continue
            shapes = []
            evaluation = self.program.evaluations[step.evaluation]
            for leaf in evaluation.arguments:
                view = self.program.leaves[leaf]
                array: Any = known.get(f".{leaf}") if view.known else given.numbers.get(view.raw)
                shapes.append(np.shape(array))
            found[step.label] = int(np.prod(np.broadcast_shapes(*shapes), dtype=np.int64))
        return found

    @cached_property
    def _has_traced(self) -> bool:
        return any(view.traced for view in self.program.leaves)

    @cached_property
    def _jax(self) -> Any:
        return jax_path(self.program, self.way, self.dtype)

    @cached_property
    def _known_arrays(self) -> dict[str, Array]:
        return known_arrays(self.program, self.dtype)

    @cached_property
    def _whole_arrays(self) -> dict[str, Array]:
        return known_arrays(self.whole, self.dtype)

    @cached_property
    def _whole_jax(self) -> Any:
        return jax_path(self.whole, self.way, self.dtype)

    @cached_property
    def _whole_sorter(self) -> Sorter:
        return Sorter(self.whole, self.inputs, self.dtype)

    @cached_property
    def _whole_steps(self) -> Stepwise:
        return Stepwise(self.whole, self.way, self.dtype)

    def _named(self, lights: list[tuple[Any, ...]]) -> dict[str, Found]:
        """Return lights of plain floats by the names of their ends."""
        return {
            name: Found(light[:4], light[4])
            for name, light in zip(self.program.readings, lights, strict=True)
        }

    def _filled(
        self,
        engine: str,
        what: Any,
        formula: Callable[[Any, Any], Formula],
        given: Given,
        parameters: Mapping[str, Any],
        careful: Callable[[Given], Array],
        read: int,
    ) -> tuple[Results, bool]:
        """Return the results of a formula, and whether their exponents say anything."""
        forms = given.forms(self.dtype)
        all_known = self._known_arrays if what is None else self._whole_arrays
        known = {name: given.cut(array) for name, array in all_known.items()}
        arrays = {str(raw): n for raw, n in given.numbers.items() if isinstance(n, np.ndarray)}
        layout = Layout(given.batch, arrays | known)
        key = engine, what, forms, layout.key
        if key not in self._many:
            made = formula(dict(forms), layout.axes)
            compiled = partial(compile_array_path, engine)
            self._many[key] = Many(
                made,
                compiled,
                layout,
                threads=self.threads,
                read=read,
                staged=not self.as_it_stands,
            )
        many = self._many[key]
        if not given.within(self.inputs.limits):
            self.inputs.resolve(parameters)
        found, failed = many.results(
            given, layout, known, lambda: self.inputs.resolve(parameters), careful
        )
        return found, failed or many.has_exponents

    def _careful(self, given: Given, shared: Shared | None = None) -> list[Found]:
        found = [Found(*light) for light in self.stepwise.lights(given, shared)]
        for light, reading in zip(found, self.program.readings.values(), strict=True):
            self._refuse_infinite(light.stokes[..., : reading.components])
        return found

    def _parts(self, given: Given) -> Iterator[Given]:
        if given.paths <= _CACHED:
            return iter([given])
        return (given.part(piece.where) for piece in pieces(given.batch, _CACHED))

    def _refuse_infinite(self, numbers: Array) -> None:
        if not is_traced(numbers) and not np.all(np.isfinite(numbers)):
            raise ParameterError(
                f"the light is not finite in {self.dtype} by method '{self.method}': a value is "
                f"too extreme; give values nearer to 1"
                + ("" if self.method == "stable" else ", or use method 'stable'")
            )


def _joined(parts: list[Array], batch: tuple[int, ...], tail: tuple[int, ...]) -> Array:
    """Return the parts of a batch as one array of its shape, with some axes behind it."""
    if len(parts) == 1:
        return parts[0]
    return np.concatenate([part.reshape(-1, *tail) for part in parts]).reshape(*batch, *tail)


def _in_shape(part: Any, batch: tuple[int, ...]) -> Any:
    """Return a component as an array of the batch's shape, or the number that it is."""
    return part.reshape(batch) if isinstance(part, np.ndarray) else part
