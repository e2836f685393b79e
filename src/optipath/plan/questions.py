"""Questions to a path: light, a Mueller matrix, bounds of intensities.

A question knows its formula, its way step by step and by JAX, and what its rows of results mean;
running is by `Runner`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.certificate import Certificate
from optipath.values.arrays import CURE

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping

    from optipath.engines.formula import Formula
    from optipath.engines.program import Program
    from optipath.plan.batches import Results
    from optipath.plan.interpreter import Shared
    from optipath.plan.reading import Batch
    from optipath.plan.runnable import Runnable
    from optipath.values.precision import Array

    Shape = tuple[int, ...]


class Question(ABC):
    """What is asked of a runner: so many numbers ``read`` of ``made`` step by step."""

    key: Hashable
    made: int
    read: int
    cure = CURE
    is_light = False

    def numbers(self, *, stepped: bool) -> int:
        """Return how many numbers a path takes at least; step by step, parts are joined."""
        return 2 * self.made if stepped else self.read

    @abstractmethod
    def formula(self, runner: Runnable, forms: Mapping[Any, str], axes: Any) -> Formula:
        """Return the formula of the results, for numbers of some forms."""

    @abstractmethod
    def rows(self, runner: Runnable, arguments: Batch, shared: Shared) -> Array:
        """Return the results step by step. Shape: returns (results, paths)."""

    @abstractmethod
    def answer(self, results: Results, shape: Shape) -> Any:
        """Return what the user gets."""


class StokesQuestion(Question):
    """Asks for arrays (..., *tail) of a few components of light, NaN where not read."""

    tail: Shape
    counts: list[int]
    matrix_of: tuple[str, str] | None = None

    @abstractmethod
    def stepped(self, runner: Runnable, arguments: Batch, shared: Shared) -> list[Array]:
        """Return the arrays step by step."""

    @abstractmethod
    def named(self, arrays: list[Any]) -> Any:
        """Return what the user gets of the arrays."""

    def rows(self, runner: Runnable, arguments: Batch, shared: Shared) -> Array:
        arrays = self.stepped(runner, arguments, shared)
        self._refuse_infinite(runner, arrays)
        first: Any = (..., *[0] * len(self.tail))
        for array in arrays:
            array[np.isnan(array[first])] = np.nan
        size = self.made // len(arrays)
        return np.concatenate([array.reshape(-1, size).T for array in arrays])

    def by_jax(self, runner: Runnable, resolved: Any, shape: Shape, parameters: Any) -> Any:
        """Return what the user gets of JAX; None where NumPy is to be asked."""
        jax = runner.for_jax
        arrays, sound = jax.path.run(resolved, shape, parameters, self.matrix_of)
        if jax.needs_closer_look(sound, resolved):
            return None
        arrays = [jax.nan_outside(array, resolved, len(self.tail)) for array in arrays]
        self._refuse_infinite(runner, arrays)
        return self.named(arrays)

    def _refuse_infinite(self, runner: Runnable, arrays: list[Any]) -> None:
        for array, count in zip(arrays, self.counts, strict=True):
            runner.refuse_infinite(array[(..., slice(count), *[slice(None)] * len(self.tail[1:]))])


class LightQuestion(StokesQuestion):
    """The light by end: Stokes vectors (..., 4), or tuples of their components."""

    key = "light"
    is_light = True
    tail = (4,)
    cure = "take it in smaller parts, plan.stream(size, ...), or give fewer values"

    def __init__(self, program: Program) -> None:
        self.ends = program.readings
        self.made = self.read = 4 * len(self.ends)
        self.counts = [reading.components for reading in self.ends.values()]

    def formula(self, runner: Runnable, forms: Mapping[Any, str], axes: Any) -> Formula:
        recorded = runner.recorded(forms, axes=axes, unreduced=runner.unreduced)
        return recorded.lights(runner.carrier)

    def stepped(self, runner: Runnable, arguments: Batch, shared: Shared) -> list[Array]:
        return runner.interpreter.lights(arguments, shared)

    def named(self, arrays: list[Any]) -> dict[str, Any]:
        return dict(zip(self.ends, arrays, strict=True))

    def answer(self, results: Results, shape: Shape) -> dict[str, Any]:
        return self.named([self._stokes(results, shape, end) for end in range(len(self.ends))])

    def _stokes(self, results: Results, shape: Shape, end: int) -> Any:
        first, count = 4 * end, self.counts[end]
        block = None if count < 4 else results.together(first, first + 4)
        if block is not None:
            return _behind(block, shape, self.tail)
        rest = [
            part.reshape(shape) if isinstance(part, np.ndarray) else part
            for part in results.each[first + 1 : first + count]
        ]
        return (results.array(first).reshape(shape), *rest, *[np.nan] * (4 - count))


class MatrixQuestion(StokesQuestion):
    """The Mueller matrix from a source to a reading, shape (..., 4, 4)."""

    made, read = 16, 32
    tail = (4, 4)

    def __init__(self, program: Program, source: str, end: str) -> None:
        self.matrix_of = source, end
        self.source = source
        self.reading = reading = program.readings[end]
        self.counts = [reading.components]
        self.key = source, reading.light, reading.components

    def formula(self, runner: Runnable, forms: Mapping[Any, str], axes: Any) -> Formula:
        return runner.recorded(forms, axes=axes).matrix(self.source, self.reading)

    def stepped(self, runner: Runnable, arguments: Batch, shared: Shared) -> list[Array]:
        del shared  # Each is needed in several columns.
        return [runner.interpreter.matrix(arguments, self.source, self.reading)]

    def named(self, arrays: list[Any]) -> Any:
        return arrays[0]

    def answer(self, results: Results, shape: Shape) -> Array:
        return _behind(results.block(0, 16), shape, self.tail)


class BoundsQuestion(Question):
    """Bounds of the intensity by the name of each end, as certificates.

    With a model, the scalar intensity by the name of each end, and the largest error of the model
    at any.
    """

    def __init__(self, program: Program, model: str | None = None) -> None:
        self.model = model
        self.ends = program.readings
        self.made = 4 * len(self.ends)
        self.read = self.made if model is None else len(self.ends) + 1
        self.key = ("bounds", model)

    def formula(self, runner: Runnable, forms: Mapping[Any, str], axes: Any) -> Formula:
        return runner.recorded(forms, axes=axes).bounds(self.model)

    def rows(self, runner: Runnable, arguments: Batch, shared: Shared) -> Array:
        del shared  # Those of bounds are of another sort.
        bounds = [rows.reshape(4, -1) for rows in runner.interpreter.bounds(arguments)]
        if self.model is None:
            return np.concatenate(bounds)
        errors = [Certificate(*each[:3]).error_of(self.model) for each in bounds]
        return np.array([*(each[0] for each in bounds), np.max(errors, axis=0)])

    def answer(self, results: Results, shape: Shape) -> Any:
        rows = [row.reshape(shape) for row in results.block(0, self.read)]
        if self.model is not None:
            return dict(zip(self.ends, rows, strict=False)), rows[-1]
        return {name: Certificate(*rows[4 * i : 4 * i + 3]) for i, name in enumerate(self.ends)}


def _behind(block: Array, shape: Shape, tail: Shape) -> Array:
    """Return rows of results as arrays of a batch's shape, with the rows behind it."""
    count = len(tail)
    axes = (*range(count, count + len(shape)), *range(count))
    return block.reshape(*tail, *shape).transpose(axes)
