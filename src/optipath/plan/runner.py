"""Runner: answers questions about a program, for one path or millions."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass
from functools import cached_property
from threading import Lock
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.choice import (
    COMPILER,
    FLOATS,
    NUMPY_STEPS,
    REGISTRY,
    SEVERAL,
    EngineChoice,
)
from optipath.errors import ValueFault
from optipath.plan.batches import BatchRunner, Results
from optipath.plan.reading import Layout, pieces
from optipath.plan.runnable import Runnable
from optipath.plan.scalar_runner import ScalarRunner
from optipath.values.jax_values import is_traced
from optipath.values.operands import ABSENT

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping

    from optipath.elements.own_element import OwnWays
    from optipath.engines.program import Program
    from optipath.plan.inputs import Inputs
    from optipath.plan.questions import Question, StokesQuestion
    from optipath.plan.reading import Batch
    from optipath.plan.runnable import RunOptions
    from optipath.plan.scalar_runner import FloatFunction
    from optipath.values.operands import InputKey
    from optipath.values.precision import Array


CACHED = 8192
"""How many paths are taken at once, step after step."""

_LITTLE = 1 << 20
"""How many bytes every machine has memory for."""


MOST_CACHED = 64
"""How many kinds of batches are kept prepared; the oldest goes first."""


def keep(store: dict[Any, Any], key: Any, value: Any) -> None:
    """Keep a value with others, the oldest of which go."""
    for oldest in list(store)[: max(0, len(store) - MOST_CACHED + 1)]:
        store.pop(oldest, None)
    store[key] = value


@dataclass(eq=False, repr=False)
class BatchKind:
    """Batches of one kind: one question, numbers of the same forms, the same axes."""

    question: Question
    forms: Mapping[InputKey, str]
    layout: Layout
    runner: Runner
    choice: EngineChoice

    @cached_property
    def batches(self) -> BatchRunner | None:
        """What does the formula to batches; None where it cannot be made."""
        runner, axes = self.runner, self.layout.axes
        made = runner.attempt(lambda: self.question.formula(runner, self.forms, axes))
        if made is None:
            return None
        staged = not runner.unreduced
        return BatchRunner(made, self.layout, threads=runner.options.threads, staged=staged)

    @cached_property
    def function(self) -> FloatFunction | None:
        """What does one path after the other; None where it cannot be made."""
        nothing = frozenset([key for key, form in self.forms.items() if form == ABSENT])
        return self.runner.single.function(nothing)

    @property
    def has_floats(self) -> bool:
        """Whether a function of floats has been made."""
        return bool(self.runner.single.functions)

    def operations(self, *, floats: bool) -> int | None:
        """Return how many operations a path takes; None where no formula can be made."""
        if floats:
            return None if self.function is None else self.function.operations
        return None if self.batches is None else len(self.batches.formula.steps)

    @property
    def is_stored(self) -> bool:
        """Whether the compiler's code is on disk."""
        return self.batches is not None and all(
            map(REGISTRY[COMPILER].is_ready, self.batches.parts)
        )


class Recipe:
    """How the numbers of a batch are taken out of what is given, for batches of its shapes."""

    def __init__(
        self, kind: BatchKind, layout: Layout, known: Mapping[Any, Any], arguments: Batch
    ) -> None:
        parameters = arguments.parameters
        self.kind = kind
        self.layout = layout
        self.fixed: dict[Any, Any] = dict(known)
        self.plain: list[InputKey] = []
        self.parts: list[InputKey] = []
        self.ranges: list[tuple[str, float, float]] = []
        self.reader = reader = kind.runner.reader
        # What is more than numbers within limits, which formulas look at, is looked at each time.
        self.whole = [
            use
            for use in reader.inputs.distinct_uses
            if type(value := parameters.get(use.value.name)) is np.ndarray
            and not reader.is_plain(use.value.name, value)
        ]
        for key, number in arguments.numbers.items():
            value = parameters.get(key.name)
            if value is None or type(value) is str or key.part == "present":
                self.fixed[key] = number
            elif key.part in ("value", "real") and not key.is_affine:
                self.plain.append(key)
            else:
                self.parts.append(key)
            if type(value) is float:
                self.ranges.append((key.name, *reader.inputs.limits[key.name]))
        # What nothing needs is looked at each time, as is what follows from others, and what says
        # more of this batch than its shapes do.
        names = {key.name for key in arguments.numbers}
        self.holds = parameters.keys() <= names <= reader.inputs.open.keys() and all(
            isinstance(number, np.ndarray)
            for key, number in arguments.numbers.items()
            if type(parameters.get(key.name)) is np.ndarray and key.part not in ("present", "imag")
        )

    def numbers(self, parameters: Mapping[str, Any]) -> dict[Any, Any] | None:
        """Return the numbers by the names of a formula's inputs; None if one is not allowed."""
        for name, low, high in self.ranges:
            if not low <= parameters[name] <= high or abs(parameters[name]) == np.inf:
                return None
        try:
            for use in self.whole:
                use.check_arguments(parameters[use.value.name])
        except ValueFault:
            return None
        results = dict(self.fixed)
        for key in self.plain:
            results[key] = parameters[key.name]
        for key in self.parts:
            results[key] = self.reader.part(key, parameters[key.name])
        return results


class Runner(Runnable):
    """Runs one program, and keeps what has been prepared."""

    def __post_init__(self) -> None:
        super().__post_init__()
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
        return self.answer_for(question, self.reader.read(parameters), key)

    def read(self, parameters: Mapping[str, Any]) -> Batch:
        """Return what is given as numbers."""
        return self.reader.read(parameters)

    def answer_for(self, question: Question, arguments: Batch, key: Any = None) -> Any:
        """Return what is asked for numbers that have been read; with a key, prepare for others."""
        parameters = arguments.parameters
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
        forms = arguments.forms(self.dtype)
        kind_key = question.key, forms, layout.key, floats
        kind = self._kinds.get(kind_key)
        if kind is None:
            options = self.options
            choice = EngineChoice(options.engine, floats=floats, dtype=options.dtype)
            kind = BatchKind(question, dict(forms), layout, self, choice)
            keep(self._kinds, kind_key, kind)
        if not arguments.within(self.inputs.limits):
            self.inputs.resolve(parameters)
        elif key is not None:
            recipe = Recipe(kind, layout, known, arguments)
            if recipe.holds:
                keep(self._recipes, (question.key, key), recipe)
        return self._run(kind, layout, numbers, parameters, arguments)

    def _run(
        self,
        kind: BatchKind,
        layout: Layout,
        numbers: Mapping[Any, Any],
        parameters: Mapping[str, Any],
        arguments: Batch | None = None,
    ) -> Any:
        question = kind.question
        engine = kind.choice.of(layout.paths, kind, arguments.ahead if arguments else 0)
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
        # Parts stay in the cache, step after step.
        if arguments.paths > CACHED:
            wheres = (piece.where for piece in pieces(arguments.shape, CACHED))
            parts = [question.rows(self, arguments.part(where), shared) for where in wheres]
        else:
            parts = [question.rows(self, arguments, shared)]
        rows = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        return question.answer(Results.of(rows, self.dtype), arguments.shape)

    def _by_jax(self, question: StokesQuestion, parameters: Mapping[str, Any]) -> Any:
        resolved, batch = self.inputs.resolve(parameters)
        if not self.for_jax.traces(parameters):
            self.first_values.check((*parameters, batch), lambda: self.reader.read(parameters))
        with self.enough_for(batch, question.numbers(stepped=True)):
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
        choice = EngineChoice(engine, floats=floats, dtype=self.dtype.name, runs=SEVERAL)
        work = SimpleNamespace(is_stored=False, operations=lambda **_: self.length)
        return choice.of(count, work)


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
    # A kernel of a user's own may read what changes.
    kernels = [evaluation.kernel for evaluation in program.evaluations]
    if not all(kernel.is_built_in for kernel in kernels):
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
