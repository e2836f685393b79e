"""Runner: answers questions about a program, for one path or millions."""

from __future__ import annotations

from contextlib import nullcontext
from functools import cached_property
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.choice import FLOATS, NUMPY_STEPS, default_engine
from optipath.engines.path_formula import PathFormula
from optipath.errors import ParameterError
from optipath.kernels.kernel import is_defined_in
from optipath.kernels.trigonometry import DIGITS
from optipath.plan.batches import BatchKind, Recipe, Results, keep
from optipath.plan.first_values import FirstValues
from optipath.plan.for_jax import ForJax
from optipath.plan.interpreter import Interpreter, carrier_of
from optipath.plan.reading import InputReader, Layout, pieces
from optipath.plan.scalar_runner import ScalarRunner
from optipath.values.arrays import CURE, enough_for
from optipath.values.jax_values import is_traced
from optipath.values.operands import ABSENT, ONE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterator, Mapping
    from contextlib import AbstractContextManager

    from optipath.elements.own_element import OwnWays
    from optipath.engines.formula import Formula
    from optipath.engines.program import Program
    from optipath.plan.inputs import Inputs
    from optipath.plan.questions import Question, StokesQuestion
    from optipath.plan.reading import Batch
    from optipath.values.operands import InputKey

    Array = np.ndarray[Any, Any]


CACHED = 8192
"""How many paths are taken at once, step after step."""

LONGEST = 200
"""How many steps are compiled in one piece."""

_LITTLE = 1 << 20
"""How many bytes every machine has memory for."""


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it."""

    method: str
    composing: str
    dtype: str
    engine: str
    threads: int

    @property
    def reproducible(self) -> bool:
        """Whether a path comes to the same bits alone and in any batch, but with JAX."""
        return self.dtype in DIGITS


class Runner:
    """Runs one program, and keeps what has been prepared."""

    def __init__(
        self,
        program: Program,
        inputs: Inputs,
        options: RunOptions,
        own_ways: tuple[OwnWays, ...] = (),
        *,
        unreduced: bool = False,
    ) -> None:
        self.program = program
        self.inputs = inputs
        self.options = options
        self.unreduced = unreduced
        self.first_values = FirstValues(own_ways)
        self.dtype = np.dtype(options.dtype)
        self.carrier = carrier_of(program, options.composing)
        self.may_compile = len(program.steps) <= LONGEST and options.reproducible
        self.for_jax = ForJax(self)
        self.reader = InputReader(program, inputs, self.dtype, reproducible=options.reproducible)
        limits = inputs.limits if options.reproducible else None
        self.interpreter = Interpreter(program, self.carrier, self.dtype, limits)
        self.single = ScalarRunner(self)
        self._ran = ""
        self._kinds: dict[Any, BatchKind] = {}
        self._recipes: dict[Any, Recipe] = {}

    @property
    def ran_by(self) -> tuple[str, ...]:
        """The engines that have answered the last question; none before the first."""
        return (self._ran,) if self._ran else ()

    def answer(self, question: StokesQuestion, parameters: Mapping[str, Any]) -> Any:
        """Return what is asked for."""
        key = self.reader.key(parameters)
        recipe = None if key is None else self._recipes.get((question.key, key))
        numbers = None if recipe is None else recipe.numbers(parameters)
        if recipe is not None and numbers is not None:
            return self._run(recipe.kind, recipe.layout, numbers, parameters)
        if self.for_jax.is_requested(parameters):
            return self._by_jax(question, parameters)
        return self.answer_for(question, self.reader.read(parameters), parameters, key=key)

    def read(self, parameters: Mapping[str, Any]) -> Batch:
        """Return what is given as numbers."""
        return self.reader.read(parameters)

    def answer_for(
        self,
        question: Question,
        arguments: Batch,
        parameters: Mapping[str, Any],
        *,
        key: Any = None,
        ahead: int = 0,
    ) -> Any:
        """Return what is asked for numbers that have been read."""
        if self.first_values.ways:
            values = (arguments.forms(self.dtype), arguments.shape, *parameters)
            self.first_values.check(values, lambda: arguments)
        floats = question.is_light and self.dtype == np.float64 and arguments.is_of_floats
        if floats and not arguments.shape:
            lights = self.single.lights(arguments)
            if lights is not None:
                self._ran = FLOATS
                return dict(zip(self.program.readings, lights, strict=True))
        known = {name: arguments.cut(array) for name, array in self.known_arrays.items()}
        numbers: dict[Any, Any] = {**arguments.numbers, **known}
        arrays = {name: n for name, n in numbers.items() if isinstance(n, np.ndarray)}
        layout = Layout(arguments.shape, arrays)
        kind = self._kind(question, arguments, layout, floats=floats)
        if not arguments.within(self.inputs.limits):
            self.inputs.resolve(parameters)
        elif key is not None:
            recipe = Recipe(kind, layout, known, arguments, parameters)
            if recipe.holds:
                keep(self._recipes, (question.key, key), recipe)
        return self._run(kind, layout, numbers, parameters, arguments, ahead)

    def read_for_bounds(self, parameters: Mapping[str, Any]) -> Batch:
        """Return what is given, for both the bounds of light and the light."""
        if self.program.loops:
            raise ParameterError(
                "there are no certificates for light that goes round in a loop; run the path, "
                "which is exact"
            )
        self.for_jax.refuse_traced(parameters, "certificates are made")
        return self.reader.read(parameters)

    def _kind(
        self, question: Question, arguments: Batch, layout: Layout, *, floats: bool
    ) -> BatchKind:
        """Return what this batch has in common with others."""
        forms = arguments.forms(self.dtype)
        key = question.key, forms, layout.key, floats
        result = self._kinds.get(key)
        if result is None:
            result = BatchKind(question, dict(forms), layout, self, floats=floats)
            keep(self._kinds, key, result)
        return result

    def _run(
        self,
        kind: BatchKind,
        layout: Layout,
        numbers: Mapping[Any, Any],
        parameters: Mapping[str, Any],
        arguments: Batch | None = None,
        ahead: int = 0,
    ) -> Any:
        question = kind.question
        engine = kind.choice.of(layout.paths, kind, ahead)
        stepped = engine == NUMPY_STEPS

        def part(piece: Any) -> Array:
            whole = arguments or self.reader.read(parameters)
            return question.rows(self, whole.part(piece.where), {})

        each = question.numbers(stepped=stepped)
        little = layout.paths * each * self.dtype.itemsize <= _LITTLE
        with nullcontext() if little else self.enough_for(layout.batch, each, question.cure):
            rows = None
            if engine == FLOATS and kind.function is not None:
                rows = kind.function.rows(numbers, layout)
            self._ran = NUMPY_STEPS if engine == FLOATS and rows is None else engine
            if rows is not None:
                results = Results.of(rows, self.dtype)
            elif stepped or engine == FLOATS:
                self.inputs.resolve(parameters)
                return self._stepped(question, arguments or self.reader.read(parameters))
            else:
                assert kind.batches is not None  # noqa: S101 - or it would not be chosen
                results = kind.batches.results(
                    engine, numbers, layout, lambda: self.inputs.resolve(parameters), part
                )
            return question.answer(results, layout.batch)

    def _stepped(self, question: Question, arguments: Batch) -> Any:
        """Return what is asked for, step by step."""
        several = arguments.paths > CACHED and not self.unreduced
        shared = self.interpreter.shared(arguments) if several and question.is_light else {}
        parts = [question.rows(self, part, shared) for part in self.parts(arguments)]
        rows = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        return question.answer(Results.of(rows, self.dtype), arguments.shape)

    def _by_jax(self, question: StokesQuestion, parameters: Mapping[str, Any]) -> Any:
        resolved, batch = self.inputs.resolve(parameters)
        if not self.for_jax.traces(parameters):
            self.first_values.check((*parameters, batch), lambda: self.reader.read(parameters))
        with self.enough_for(batch, 2 * question.read):
            result = question.by_jax(self, resolved, batch, parameters)
        self._ran = NUMPY_STEPS if result is None else "jax"
        if result is None:
            # Loops that need a closer look get the same one by every engine.
            return self._stepped(question, self.reader.read(parameters))
        return result

    def engine_for(self, count: int) -> str:
        """Return what runs a batch of so many paths, once that has been done several times."""
        engine, floats = self.options.engine, self.dtype == np.float64
        if engine == "jax":
            return engine
        if count == 1 and floats:
            return FLOATS
        for kind in self._kinds.values():
            if kind.choice.decided == kind.choice.compiler:
                return kind.choice.compiler
        dtype = self.dtype.name
        return default_engine(engine, count, self.length, floats=floats, dtype=dtype)

    def attempt(self, make: Callable[[], Formula]) -> Formula | None:
        """Return what makes a formula gives; None where it cannot be made."""
        if not self.may_compile:
            return None
        try:
            return make()
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            self.may_compile = False
            return None

    def recorded(self, forms: Mapping[InputKey, str], **options: Any) -> PathFormula:
        """Return what records formulas, for numbers of some forms, as `PathFormula` has options."""
        inputs, kind = self.inputs, self.dtype.name
        return PathFormula(self.program, kind, forms, inputs.limits, masks=inputs.masks, **options)

    def all_passed_as(self, form: str) -> dict[InputKey, str]:
        """Return one form for every number that is not known."""
        return dict.fromkeys([o.input_key for o in self.program.operands if not o.known], form)

    @cached_property
    def length(self) -> int | None:
        """How many operations light takes for real numbers; None where there is no formula."""
        forms, unreduced = self.all_passed_as(ONE), self.unreduced
        forms |= {key: ABSENT for key in forms if key.part == "imag"}
        made = self.attempt(lambda: self.recorded(forms, unreduced=unreduced).lights(self.carrier))
        return None if made is None else len(made.steps)

    @cached_property
    def known_arrays(self) -> dict[str, Array]:
        """The arrays that are known beforehand, as formulas name them."""
        kind = wide(self.dtype)
        return {
            f".{place}": operand.numbers(kind=kind).astype(
                bool if operand.part == "present" else self.dtype, copy=False
            )
            for place, operand in enumerate(self.program.operands)
            if operand.known and operand.numbers().ndim
        }

    def enough_for(
        self, batch: tuple[int, ...], numbers: int, cure: str = CURE
    ) -> AbstractContextManager[None]:
        """Return a context for so many numbers a path."""
        return enough_for(batch, self.dtype.itemsize * numbers, cure, ParameterError)

    def parts(self, arguments: Batch) -> Iterator[Batch]:
        """Return what is given in parts that stay in the cache, step after step."""
        if arguments.paths <= CACHED:
            return iter([arguments])
        return (arguments.part(piece.where) for piece in pieces(arguments.shape, CACHED))

    def refuse_infinite(self, numbers: Array) -> None:
        """Refuse light that is not finite, but for NaN where that says what cannot be."""
        method = self.options.method
        if not is_traced(numbers) and np.any(self.inputs.unsound(numbers)):
            raise ParameterError(
                f"the light is not finite in {self.dtype} by method '{method}': a value is "
                f"too extreme{self.first_values.doubt}; give values nearer to 1"
                + ("" if method == "stable" else ", or use method 'stable'")
            )


_MOST_RUNNERS = 32
"""How many runners are kept; that which was asked for longest ago goes first."""

_LARGEST = 1 << 16
"""How many bytes the arrays of a program have at most that is kept."""

_RUNNERS: dict[Hashable, Runner] = {}
_LOCK = Lock()


def runner_for(
    program: Program,
    inputs: Inputs,
    options: RunOptions,
    own_ways: tuple[OwnWays, ...] = (),
    *,
    unreduced: bool = False,
) -> Runner:
    """Return what runs a program: what ran an equal one before, if that is still kept."""
    key = _key(program, inputs)
    if key is None or own_ways:
        return Runner(program, inputs, options, own_ways, unreduced=unreduced)
    key = key, options, unreduced
    with _LOCK:
        # Taken out and put back, it stands last; an OrderedDict compares keys three times for that.
        runner = _RUNNERS.pop(key, None)
        if runner is None:
            runner = Runner(program, inputs, options, unreduced=unreduced)
        _RUNNERS[key] = runner
        while len(_RUNNERS) > _MOST_RUNNERS:
            del _RUNNERS[next(iter(_RUNNERS))]
        return runner


def _key(program: Program, inputs: Inputs) -> Hashable:
    """Return what equal programs share, names included; None for what is not kept."""
    operands = [operand.key() for operand in program.operands]
    size = sum([getattr(operand.value, "nbytes", 0) for operand in program.operands])
    agreements = [agreement.key() for agreement in (*inputs.agreements, *inputs.for_complex)]
    if None in (*operands, *agreements) or size > _LARGEST or inputs.known:
        return None
    parameters = (*inputs.open.values(), *inputs.bound.values())
    if any(is_traced(parameter.default) for parameter in parameters):
        return None
    if not all(_is_pure(evaluation.kernel.factory) for evaluation in program.evaluations):
        return None
    return (
        tuple(operands),
        program.evaluations,
        program.steps,
        program.counts,
        program.loops,
        tuple([(name, step) for name, (step, _) in program.sources.items()]),
        tuple([(name, end.light, end.components) for name, end in program.readings.items()]),
        tuple(inputs.open.values()),
        tuple(inputs.bound.values()),
        # A default of -0.0 equals 0.0, but is another number.
        tuple([np.asarray(p.default).tobytes() for p in parameters if p.default is not None]),
        tuple(
            [(u.owner, u.value.name, u.value.scale, u.value.offset, u.domain) for u in inputs.uses]
        ),
        tuple(inputs.shapes.items()),
        tuple(agreements),
    )


def _is_pure(factory: Any) -> bool:
    """Tell whether a kernel is of the library; one of a user's own may read what changes."""
    return is_defined_in("optipath.kernels.", factory)
