"""One path of plain floats: no arrays, and after a few runs a function of its own."""

from __future__ import annotations

from collections import Counter
from types import NoneType
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.engines.float_engine import FLOATS
from optipath.engines.formulas import lights_formula
from optipath.values.operands import ABSENT, ONE
from optipath.values.parameters import ABSENT as WORD

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.engines.program.program import Program
    from optipath.plan.running.interpreter import Interpreter
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.values.inputs import Inputs

Lights: TypeAlias = list[tuple[Any, ...]]

_SEVERAL, _SHORT = 3, 64
"""After how many runs a function is worth its while, and up to how many steps."""


class ScalarRunner:
    """Runs a program on plain floats.

    Parameters
    ----------
    program : Program
        The steps.
    inputs : Inputs
        What may be given.
    interpreter : Interpreter
        Runs it until a function is made.
    compilable : callable
        Tells whether a function may be made.
    """

    def __init__(
        self,
        program: Program,
        inputs: Inputs,
        interpreter: Interpreter,
        compilable: Callable[[], bool],
    ) -> None:
        self.program = program
        self.inputs = inputs
        self.interpreter = interpreter
        self.compilable = compilable
        self._paths: dict[Any, tuple[Any, list[int]]] = {}
        self._runs = 0
        self._usual: tuple[Any, list[tuple[str, Any]], frozenset[str]] | None = None

    def fast_path(self, parameters: Mapping[str, Any]) -> Lights | None:
        """Return what `lights` gives for plain floats beside defaults, without sorting them.

        None where no function has been made, or where it takes more care.
        """
        if self._usual is None:
            return None
        path, order, names = self._usual
        for name, value in parameters.items():
            if type(value) is not float or name not in names:
                return None
        get = parameters.get
        return _called(path, [get(name, default) for name, default in order])

    def lights(self, given: ResolvedInputs) -> Lights | None:
        """Return (S0, S1, S2, S3, exponent) at every end; None where that takes more care."""
        numbers = list(given.numbers.values())
        # Which optional elements are there.
        key = tuple(number for number in numbers if number is True or number is False)
        if key not in self._paths:
            self._runs += 1
            if (
                self._runs <= max(_SEVERAL, len(self.program.steps) - _SHORT)
                or not self.compilable()
            ):
                return self._stepped(given)
            self._paths[key] = self._made(given)
            if self._is_usual(given):
                self._usual = self._unsorted(given, *self._paths[key])
        path, places = self._paths[key]
        return _called(path, [numbers[place] for place in places])

    def _stepped(self, given: ResolvedInputs) -> Lights | None:
        if not given.within(self.inputs.limits):
            return None
        return self.interpreter.single(given.numbers)

    def _made(self, given: ResolvedInputs) -> tuple[Any, list[int]]:
        """Return the function, and the places of what it takes among what is given."""
        absent = {key.name for key, number in given.numbers.items() if number is False}
        forms = {key: ABSENT if key.name in absent else ONE for key in given.numbers}
        limits = self.inputs.limits
        formula = lights_formula(
            self.program, self.interpreter.carrier, "float64", forms, limits, polynomials=False
        )
        places = {str(key): place for place, key in enumerate(given.numbers)}
        return FLOATS.compiled(formula), [places[s.operands[0]] for s in formula.inputs]

    def _is_usual(self, given: ResolvedInputs) -> bool:
        """Tell whether the optional elements are there as they are by default."""
        there = {key.name: n for key, n in given.numbers.items() if key.part == "present"}
        opened = self.inputs.open
        return all(n is (opened[name].default != WORD) for name, n in there.items())

    def _unsorted(self, given: ResolvedInputs, path: Any, places: list[int]) -> Any:
        keys = list(given.numbers)
        optional = {key.name for key in keys if key.part == "present"}
        parts = Counter(key.name for key in keys if key.part != "present")
        order = []
        for place in places:
            default = self.inputs.open[keys[place].name].default
            # One number may be given to several kernels, an index as its two parts.
            if keys[place].part != "value" or type(default) not in (float, int, NoneType):
                return None
            order.append((keys[place].name, default))
        asked = {name for name, _ in order}
        if any(p.default is None for name, p in self.inputs.open.items() if name not in asked):
            return None  # What nothing needs must be given all the same.
        return path, order, frozenset(n for n, _ in order if n not in optional and parts[n] == 1)


def _called(path: Any, numbers: list[Any]) -> Lights | None:
    """Return the lights that a function gives."""
    try:
        found = path(*numbers)
    except (ArithmeticError, TypeError, ValueError):
        return None
    if found is None or len(found) == 5:
        return found and [found]
    ends = len(found) // 5
    return [(*found[4 * end : 4 * end + 4], found[4 * ends + end]) for end in range(ends)]
