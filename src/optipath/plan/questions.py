"""Questions to a path: light, a Mueller matrix, bounds of intensities; formulas that answer them.

A question has its formula, steps, inputs of JAX and results; running is by `Runner`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from optipath.engines.path_formula import bounds_formula, lights_formula, matrix_formula
from optipath.plan.certificate import Certificate
from optipath.values.arrays import CURE
from optipath.values.operands import ABSENT, ONE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from optipath.engines.formula import Formula
    from optipath.engines.program import Program, Reading
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.batch_runner import Results
    from optipath.plan.for_jax import ForJax
    from optipath.plan.inputs import Inputs
    from optipath.plan.interpreter import Interpreter, Shared
    from optipath.plan.reading import Batch, RunOptions
    from optipath.values.operands import InputKey

    Array = np.ndarray[Any, Any]
    Shape = tuple[int, ...]


class Requested(Protocol):
    """What a question asks: a program that is run step by step, or by JAX."""

    interpreter: Interpreter
    for_jax: ForJax

    def refuse_infinite(self, numbers: Any) -> None:
        """Refuse light that is not finite."""


class Question(ABC):
    """What is asked of a runner."""

    key: Hashable
    read: int
    cure = CURE
    is_light = False

    @abstractmethod
    def numbers(self, *, stepped: bool) -> int:
        """Return how many numbers a path takes at least, results and what is made on the way."""

    @abstractmethod
    def formula(self, maker: FormulaMaker, forms: Mapping[Any, str], axes: Any) -> Formula:
        """Return the formula of the results, for numbers of some forms."""

    @abstractmethod
    def rows(self, runner: Requested, arguments: Batch, shared: Shared) -> Array:
        """Return the results step by step. Shape: returns (results, paths)."""

    def by_jax(self, runner: Requested, resolved: Any, shape: Shape, parameters: Any) -> Any:
        """Return what the user gets of JAX; None where NumPy is to be asked."""
        del runner, resolved, shape, parameters

    @abstractmethod
    def answer(self, results: Results, shape: Shape) -> Any:
        """Return what the user gets."""


class LightQuestion(Question):
    """The light by end: Stokes vectors (..., 4), or tuples of their components."""

    key = "light"
    is_light = True
    cure = "take it in smaller parts, plan.stream(size, ...), or give fewer values"

    def __init__(self, program: Program) -> None:
        self.program = program
        self.ends = program.readings
        self.read = 4 * len(self.ends)
        self.counts = [reading.components for reading in self.ends.values()]

    def numbers(self, *, stepped: bool) -> int:
        # Step by step, parts are joined.
        return (8 if stepped else 4) * len(self.ends)

    def formula(self, maker: FormulaMaker, forms: Mapping[Any, str], axes: Any) -> Formula:
        return maker.lights(forms, axes=axes, unreduced=maker.unreduced)

    def rows(self, runner: Requested, arguments: Batch, shared: Shared) -> Array:
        result = runner.interpreter.lights(arguments, shared)
        for stokes, count in zip(result, self.counts, strict=True):
            runner.refuse_infinite(stokes[..., :count])
            stokes[np.isnan(stokes[..., 0])] = np.nan
        return np.concatenate([stokes.reshape(-1, 4).T for stokes in result])

    def by_jax(self, runner: Requested, resolved: Any, shape: Shape, parameters: Any) -> Any:
        result, sound = runner.for_jax.path.lights(resolved, shape, parameters)
        if runner.for_jax.needs_closer_look(sound, resolved):
            return None
        lights = {}
        for stokes, name, count in zip(result, self.ends, self.counts, strict=True):
            lights[name] = runner.for_jax.nan_outside(stokes, resolved, 1)
            runner.refuse_infinite(lights[name][..., :count])
        return lights

    def answer(self, results: Results, shape: Shape) -> dict[str, Any]:
        return {
            name: self._stokes(results, shape, 4 * end, self.counts[end])
            for end, name in enumerate(self.ends)
        }

    def _stokes(self, results: Results, shape: Shape, first: int, count: int) -> Any:
        block = None if count < 4 else results.together(first, first + 4)
        if block is not None:
            return _behind(block, shape, (4,))
        rest = [_in_shape(part, shape) for part in results.each[first + 1 : first + count]]
        return (results.array(first).reshape(shape), *rest, *[np.nan] * (4 - count))


class MatrixQuestion(Question):
    """The Mueller matrix from a source to a reading, shape (..., 4, 4)."""

    read = 16

    def __init__(self, program: Program, source: str, reading: Reading) -> None:
        self.program = program
        self.source = source
        self.reading = reading
        self.key = source, reading.light, reading.components

    def numbers(self, *, stepped: bool) -> int:
        del stepped  # The matrix, twice.
        return 32

    def formula(self, maker: FormulaMaker, forms: Mapping[Any, str], axes: Any) -> Formula:
        kind, limits = maker.dtype.name, maker.limits
        ends = self.source, self.reading
        return matrix_formula(
            self.program,
            *ends,
            kind,
            forms,
            limits,
            axes,
            masks=maker.masks,
        )

    def rows(self, runner: Requested, arguments: Batch, shared: Shared) -> Array:
        del shared  # Each is needed in several columns.
        result = runner.interpreter.matrix(arguments, self.source, self.reading)
        runner.refuse_infinite(result[..., : self.reading.components, :])
        result[np.isnan(result[..., 0, 0])] = np.nan
        return result.reshape(-1, 16).T

    def by_jax(self, runner: Requested, resolved: Any, shape: Shape, parameters: Any) -> Any:
        name = next(n for n, end in self.program.readings.items() if end is self.reading)
        result, sound = runner.for_jax.path.matrix(resolved, shape, parameters, self.source, name)
        if runner.for_jax.needs_closer_look(sound, resolved):
            return None
        result = runner.for_jax.nan_outside(result, resolved, 2)
        runner.refuse_infinite(result[..., : self.reading.components, :])
        return result

    def answer(self, results: Results, shape: Shape) -> Array:
        return _behind(results.block(0, 16), shape, (4, 4))


class BoundsQuestion(Question):
    """Bounds of the intensity by the name of each end, as certificates."""

    model: str | None = None

    def __init__(self, program: Program) -> None:
        self.program = program
        self.ends = program.readings
        self.read = 4 * len(self.ends)
        self.key = ("bounds", self.model)

    def numbers(self, *, stepped: bool) -> int:
        # Step by step, parts are joined.
        return 8 * len(self.ends) if stepped else self.read

    def formula(self, maker: FormulaMaker, forms: Mapping[Any, str], axes: Any) -> Formula:
        kind, limits = maker.dtype.name, maker.limits
        return bounds_formula(self.program, kind, forms, limits, axes, self.model)

    def rows(self, runner: Requested, arguments: Batch, shared: Shared) -> Array:
        del shared  # Those of bounds are of another sort.
        return np.concatenate(
            [rows.reshape(4, -1) for rows in runner.interpreter.bounds(arguments)]
        )

    def answer(self, results: Results, shape: Shape) -> dict[str, Certificate]:
        each = results.block(0, self.read).reshape(len(self.ends), 4, *shape)
        return {
            name: Certificate(*map(np.asarray, result[:3]))
            for name, result in zip(self.ends, each, strict=True)
        }


class ErrorsQuestion(BoundsQuestion):
    """The scalar intensity by the name of each end, and the largest error of a model at any."""

    def __init__(self, program: Program, model: str) -> None:
        self.model = model
        super().__init__(program)
        self.read = len(self.ends) + 1

    def rows(self, runner: Requested, arguments: Batch, shared: Shared) -> Array:
        bounds = super().rows(runner, arguments, shared).reshape(-1, 4, arguments.paths)
        assert self.model is not None  # noqa: S101 - for mypy
        errors = [Certificate(*result[:3]).error_of(self.model) for result in bounds]
        return np.array([*bounds[:, 0], np.max(errors, axis=0)])

    def answer(self, results: Results, shape: Shape) -> Any:
        *totals, error = (row.reshape(shape) for row in results.block(0, self.read))
        return dict(zip(self.ends, totals, strict=True)), error


def _behind(block: Array, shape: Shape, tail: tuple[int, ...]) -> Array:
    """Return rows of results as arrays of a batch's shape, with the rows behind it."""
    count = len(tail)
    axes = (*range(count, count + len(shape)), *range(count))
    return block.reshape(*tail, *shape).transpose(axes)


def _in_shape(part: Any, shape: Shape) -> Any:
    return part.reshape(shape) if isinstance(part, np.ndarray) else part


LONGEST = 200
"""How many steps are compiled in one piece."""


class FormulaMaker:
    """Makes the formulas of one program."""

    def __init__(
        self,
        program: Program,
        inputs: Inputs,
        carrier: type[Carrier],
        options: RunOptions,
        *,
        unreduced: bool,
    ) -> None:
        self.program = program
        self.limits = inputs.limits
        self.masks = inputs.masks
        self.carrier = carrier
        self.dtype = np.dtype(options.dtype)
        self.unreduced = unreduced
        self.may_make = len(program.steps) <= LONGEST and options.reproducible

    def attempt(self, make: Callable[[], Formula]) -> Formula | None:
        """Return what makes a formula gives; None where it cannot be made."""
        if not self.may_make:
            return None
        try:
            return make()
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            self.may_make = False
            return None

    def of_floats(self, forms: Mapping[InputKey, str]) -> Formula | None:
        """Return the formula of light for plain floats; None where it cannot be made."""
        return self.attempt(lambda: self.lights(forms, single=True))

    def lights(
        self, forms: Mapping[InputKey, str], *, carrier: type[Carrier] | None = None, **options: Any
    ) -> Formula:
        """Return the formula of the light at every end, as `lights_formula` takes options."""
        kind, carrier = self.dtype.name, carrier or self.carrier
        own = self.limits
        return lights_formula(self.program, carrier, kind, forms, own, masks=self.masks, **options)

    def all_passed_as(self, form: str) -> dict[InputKey, str]:
        """Return one form for every number that is not known."""
        return dict.fromkeys([o.input_key for o in self.program.operands if not o.known], form)

    @cached_property
    def length(self) -> int | None:
        """How many operations light takes for real numbers; None where there is no formula."""
        forms, unreduced = self.all_passed_as(ONE), self.unreduced
        forms |= {key: ABSENT for key in forms if key.part == "imag"}
        made = self.attempt(lambda: self.lights(forms, unreduced=unreduced))
        return None if made is None else len(made.steps)

    @cached_property
    def known_arrays(self) -> dict[str, np.ndarray[Any, Any]]:
        """The arrays that are known beforehand, as formulas name them."""
        kind = wide(self.dtype)
        return {
            f".{place}": operand.numbers(kind=kind).astype(
                bool if operand.part == "present" else self.dtype, copy=False
            )
            for place, operand in enumerate(self.program.operands)
            if operand.known and operand.numbers().ndim
        }
