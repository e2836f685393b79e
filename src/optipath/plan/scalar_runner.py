"""Scalar runs: one path by plain floats, as one function."""

from __future__ import annotations

from collections import Counter
from functools import partial
from itertools import islice, repeat
from types import NoneType
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.engines.float_engine import float_path
from optipath.plan.runnable import LONGEST, LONGEST_ALONE
from optipath.values.curve_value import computed_values
from optipath.values.operands import ABSENT, ONE
from optipath.values.parameters import ABSENT as WORD
from optipath.values.parameters import THERE, Resolved

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.engines.float_engine import FloatPath
    from optipath.plan.inputs import Inputs
    from optipath.plan.reading import Batch, Layout
    from optipath.plan.runnable import Runnable
    from optipath.values.operands import InputKey
    from optipath.values.precision import Array


Lights: TypeAlias = list[tuple[Any, ...]]

_REAL = (float, int, NoneType)
"""The sorts of defaults that floats may stand for."""

_REFUSED = (ArithmeticError, TypeError, ValueError)


class FloatFunction(NamedTuple):
    """A function of floats."""

    path: FloatPath
    names: tuple[Any, ...]
    operations: int

    def rows(self, numbers: Mapping[Any, Any], layout: Layout) -> Array | None:
        """Return the results of a few paths, shape (results, paths); None where it takes care."""
        columns: list[Any] = []
        for name in self.names:
            number = numbers[name]
            if isinstance(number, np.ndarray):
                if number.shape != layout.batch:
                    number = np.broadcast_to(number, layout.batch)
                columns.append(number.ravel().tolist())
            else:
                columns.append(repeat(number))
        try:
            results = [self.path(*row) for row in islice(zip(*columns), layout.paths)]  # noqa: B905
        except _REFUSED:
            return None
        if None in results or not results or len(results) < layout.paths:
            return None
        return np.array(results).T


class ScalarRunner:
    """Runs the program of a runner on plain floats."""

    def __init__(self, runner: Runnable) -> None:
        self.runner = runner
        self.inputs = runner.inputs
        self.functions: dict[frozenset[InputKey], FloatFunction | None] = {}
        self._looked_at: set[frozenset[InputKey]] = set()
        self.following = FollowingFloats(self.inputs) if self.inputs.computed else None
        self._default_call: tuple[FloatPath, list[tuple[str, Any]], frozenset[str]] | None = None

    def fast_path(self, parameters: Mapping[str, Any], place: int) -> tuple[Any, ...] | None:
        """Return the light at one end for plain floats, unread; None where it takes more care."""
        if self._default_call is None:
            return None
        path, order, names = self._default_call
        for name, value in parameters.items():
            if type(value) is not float or name not in names:
                return None
        numbers = parameters if self.following is None else self.following.beside(parameters)
        if numbers is None:
            return None
        get = numbers.get
        try:
            result = path(*[get(name, default) for name, default in order])
        except _REFUSED:
            return None
        if result is None or len(result) == 4:
            return result
        return result[4 * place : 4 * place + 4]

    def lights(self, arguments: Batch) -> Lights | None:
        """Return (S0, S1, S2, S3) at every end; None where that takes more care."""
        nothing = arguments.nothing
        function = self.function(nothing)
        if function is None:
            return None
        if nothing not in self._looked_at:
            self._looked_at.add(nothing)
            if self._is_default(arguments) and not self.inputs.agreements and self._defaults_hold():
                self._default_call = self._unread(arguments, function)
        try:
            result = function.path(*[arguments.numbers[name] for name in function.names])
        except _REFUSED:
            return None
        if result is None:
            return None
        return [result[first : first + 4] for first in range(0, len(result), 4)]

    def function(self, nothing: frozenset[InputKey]) -> FloatFunction | None:
        """Return the function for what is not there, as `Batch.nothing`, if it can be."""
        if nothing in self.functions:
            return self.functions[nothing]
        runner, result = self.runner, None
        keys = runner.all_passed_as(ONE)
        absent = {key.name for key in nothing if key.part == "present"}
        forms = {k: ABSENT if k in nothing or k.name in absent else ONE for k in keys}
        recorded = partial(runner.recorded, forms, single=True)
        longest = LONGEST if runner.program.loops else LONGEST_ALONE
        formula = runner.attempt(lambda: recorded().lights(runner.carrier), longest)
        if formula is not None:
            names = tuple(map(formula.name_of, formula.inputs))
            result = FloatFunction(float_path(formula)(), names, formula.length)
        self.functions[nothing] = result
        return result

    def _is_default(self, arguments: Batch) -> bool:
        """Tell whether the optional elements are there as they are by default."""
        there = {key.name: n for key, n in arguments.numbers.items() if key.part == "present"}
        opened = self.inputs.open
        return all(n is (opened[name].default != WORD) for name, n in there.items())

    def _defaults_hold(self) -> bool:
        """Tell whether elements of a user's own can be what they are by default."""
        if not self.runner.first_values.ways:
            return True
        opened = self.inputs.open.items()
        defaults = {name: p.resolve(p.default) for name, p in opened if p.default is not None}
        known = [way for way in self.runner.first_values.ways if way.are_known(defaults)]
        return not any(way.faults(lambda operand: operand.numbers(defaults)) for way in known)

    def _unread(self, arguments: Batch, function: FloatFunction) -> Any:
        """Return what `fast_path` needs: the function, and the default of each that it takes."""
        optional = {key.name for key in arguments.numbers if key.part == "present"}
        # A plain float has no imaginary part, and the function has been made for none.
        parts = Counter(
            key.name for key in arguments.numbers if key.part not in ("present", "imag")
        )
        opened = self.inputs.open
        real = {name for name, p in opened.items() if type(p.default) in _REAL}
        following = self.following.defaults if self.following else {}
        real |= {value.name for value in self.inputs.computed}
        if any(key.part == "imag" and key.name not in real for key in arguments.numbers):
            return None
        order = []
        for key in function.names:
            # One number may be given to several kernels.
            if key.part not in ("value", "real") or key.is_affine or key.name not in real:
                return None
            order.append((key.name, opened[key.name].default if key.name in opened else None))
        request = {name for name, _ in order} | following.keys()
        if any(p.default is None for name, p in opened.items() if name not in request):
            return None  # What nothing needs must be given all the same.
        return (
            function.path,
            order,
            frozenset(n for n in request & opened.keys() if n not in optional and parts[n] <= 1),
        )


class FollowingFloats:
    """Puts numbers that follow from the wavelength beside those that are given."""

    def __init__(self, inputs: Inputs) -> None:
        self.computed = inputs.computed
        arguments = {one.name: one for value in self.computed for one in value.arguments}
        self.defaults = {n: inputs.open[n].default for n in arguments if n in inputs.open}
        self._ranges = [inputs.limits[name] for name in self.defaults]
        self._last: tuple[tuple[Any, ...], dict[str, float]] = (), {}

    def beside(self, arguments: Mapping[str, float]) -> Mapping[str, float] | None:
        """Return what is given and what follows from it; None where that is to be looked at."""
        numbers = tuple([arguments.get(name, default) for name, default in self.defaults.items()])
        last, results = self._last
        if numbers != last:
            for number, (low, high) in zip(numbers, self._ranges, strict=True):
                if type(number) is not float or not low <= number <= high:
                    return None
            pairs = zip(self.defaults, numbers, strict=True)
            resolved = {name: Resolved(number, THERE) for name, number in pairs}
            computed = computed_values(self.computed, resolved)
            results = {name: of_it.value.item() for name, of_it in computed.items()}
            self._last = numbers, results
        return {**arguments, **results}
