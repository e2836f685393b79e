"""What depends on the names, shapes and types of what is given: prepared once for all batches."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines.choice import COMPILER, REGISTRY, EngineChoice
from optipath.errors import ValueFault
from optipath.plan.batch_runner import BatchRunner
from optipath.values.operands import ABSENT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.plan.questions import FormulaMaker, Question
    from optipath.plan.reading import Batch, InputReader, Layout, RunOptions
    from optipath.plan.scalar_runner import FloatFunction, ScalarRunner
    from optipath.values.operands import InputKey


MOST_CACHED = 64
"""How many kinds of batches are kept prepared; the oldest goes first."""


def keep(store: dict[Any, Any], key: Any, value: Any) -> None:
    """Keep a value with others, the oldest of which go."""
    for oldest in list(store)[: max(0, len(store) - MOST_CACHED + 1)]:
        store.pop(oldest, None)
    store[key] = value


class BatchKind:
    """Batches of one kind: one question, numbers of the same forms, the same axes."""

    def __init__(
        self,
        question: Question,
        forms: Mapping[InputKey, str],
        layout: Layout,
        formulas: FormulaMaker,
        single: ScalarRunner,
        options: RunOptions,
        *,
        floats: bool,
    ) -> None:
        self.question = question
        self.forms = forms
        self.layout = layout
        self.formulas = formulas
        self.single = single
        self.options = options
        self.choice = EngineChoice(options.engine, floats=floats, dtype=formulas.dtype.name)

    @cached_property
    def batches(self) -> BatchRunner | None:
        """What does the formula to batches; None where it cannot be made."""
        made = self.formulas.attempt(
            lambda: self.question.formula(self.formulas, self.forms, self.layout.axes)
        )
        if made is None:
            return None
        staged = not self.formulas.unreduced
        return BatchRunner(made, self.layout, threads=self.options.threads, staged=staged)

    @cached_property
    def function(self) -> FloatFunction | None:
        """What does one path after the other; None where it cannot be made."""
        nothing = frozenset([key for key, form in self.forms.items() if form == ABSENT])
        return self.single.function(nothing)

    @property
    def has_floats(self) -> bool:
        """Whether a function of floats has been made."""
        return bool(self.single.functions)

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


class Prepared(NamedTuple):
    """A batch of which all is known but the numbers."""

    kind: BatchKind
    layout: Layout
    known: Mapping[str, np.ndarray[Any, Any]]


class Recipe:
    """How the numbers of a prepared batch are taken out of what is given."""

    def __init__(
        self,
        prepared: Prepared,
        reader: InputReader,
        arguments: Batch,
        parameters: Mapping[str, Any],
    ) -> None:
        self.prepared = prepared
        self.reader = reader
        self.batch = arguments.shape
        self.names: dict[str, str] = {}
        self.parts: list[InputKey] = []
        self.fixed: dict[str, Any] = dict(prepared.known)
        self.ranges: list[tuple[str, float, float]] = []
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
                self.fixed[str(key)] = number
            elif key.part in ("value", "real") and not key.is_affine:
                self.names[str(key)] = key.name
            else:
                self.parts.append(key)
            if type(value) is float:
                self.ranges.append((key.name, *reader.inputs.limits[key.name]))

    @staticmethod
    def holds(reader: InputReader, arguments: Batch, parameters: Mapping[str, Any]) -> bool:
        """Tell whether what was read says as much of the next batch of the same shapes."""
        if not parameters.keys() <= {key.name for key in arguments.numbers}:
            return False  # What nothing needs is looked at each time.
        if any(key.name not in reader.inputs.open for key in arguments.numbers):
            return False  # As is what follows from others.
        return all(
            isinstance(number, np.ndarray)
            for key, number in arguments.numbers.items()
            if type(parameters.get(key.name)) is np.ndarray and key.part not in ("present", "imag")
        )

    def numbers(self, parameters: Mapping[str, Any]) -> dict[str, Any] | None:
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
        for name, parameter in self.names.items():
            results[name] = parameters[parameter]
        for key in self.parts:
            results[str(key)] = self.reader.part(key, parameters[key.name])
        return results
