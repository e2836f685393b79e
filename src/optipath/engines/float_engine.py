"""The engine of floats: a formula as a Python function, for one path.

Most of a path's formula is physics that other paths have as well. So what a kernel, or an element,
does to arguments of some forms is recorded and made a function once, and a path calls it.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formula import Formula
from optipath.engines.symbols import (
    ONE_AXIS,
    OPERATIONS,
    Recorder,
    Symbol,
    key_of,
    reproducible_symbolic,
)
from optipath.kernels.carriers.carrier import Carrier
from optipath.kernels.primitives import FLOAT

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence

    from optipath.kernels.carriers.carried import Components, SolvedLoop
    from optipath.kernels.carriers.structures import Numbers, Structure
    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import Factory


_DEEPEST = 30
_TWICE = ("maximum", "minimum")
"""Operations whose text names an operand twice."""

_SPACE = {
    "atan2": math.atan2,
    "cos": math.cos,
    "exp": math.exp,
    "exponent": FLOAT.scaling,
    "inf": math.inf,
    "ldexp": math.ldexp,
    "nan": math.nan,
    "product_rest": lambda a, b: FLOAT.two_product(a, b)[1],
    "sin": math.sin,
    "sqrt": math.sqrt,
}


FloatPath: TypeAlias = "Callable[..., tuple[Any, ...] | None]"


def float_path(formula: Formula, known: Sequence[Symbol] = ()) -> Callable[..., FloatPath]:
    """Return what makes a function of floats, for the inputs that are known.

    It gives None, or raises ArithmeticError or ValueError, where the formula fails.
    """
    space: dict[str, Any] = dict(_SPACE)
    exec(_compiled(source(formula, space, known)), space)  # noqa: S102 - our own
    maker: Callable[..., FloatPath] = space["made"]
    return maker


@lru_cache(maxsize=1024)
def _compiled(text: str) -> Any:
    """Return the code of a text: paths that differ in numbers alone mostly have one text."""
    return compile(text, "<formula>", "exec")


def source(formula: Formula, space: dict[str, Any], known: Sequence[Symbol] = ()) -> str:
    """Return the text of ``made(*known)(*given)``, and put the functions it calls into its names.

    What follows from known inputs alone is computed once. What is used once is inlined, so choices
    are lazy.
    """
    texts = {symbol.index: f"t{symbol.index}" for symbol in formula.needed}
    depth: dict[int, int] = {}
    lines: list[str] = []
    early = {symbol.index for symbol in known}
    first: list[str] = []

    def written(operands: Iterable[Any]) -> list[str]:
        return [texts[o.index] if isinstance(o, Symbol) else _literal(o) for o in operands]

    used_twice = set()
    for step in formula.steps:
        if step.operation in _TWICE:
            used_twice.update([o.index for o in step.operands if isinstance(o, Symbol)])
    for step in formula.steps:
        if step.operation == "item":
            continue
        if step.operation == "call":
            template, *arguments = step.operands
            items = formula.items[step.index]
            which = tuple(sorted(items))
            space[f"f{step.index}"], needs = template.function(which, arguments)
            given = ", ".join(written([arguments[place] for place in needs]))
            results = "".join([f"t{items[place]}, " for place in which])
            lines.append(f"{results}= f{step.index}({given})")
            continue
        text = OPERATIONS[step.operation].text.format(*written(step.operands))
        operands = [o.index for o in step.operands if isinstance(o, Symbol)]
        deep = 1 + max([depth.get(index, 0) for index in operands], default=0)
        if early.issuperset(operands):
            early.add(step.index)
            first.append(f"t{step.index} = {text}")
        elif formula.uses[step.index] == 1 and step.index not in used_twice and deep < _DEEPEST:
            texts[step.index] = f"({text})"
            depth[step.index] = deep
        else:
            lines.append(f"t{step.index} = {text}")
    results = ", ".join(written(formula.results))
    holds = " and ".join(written(formula.checks)) or "True"
    given = ", ".join(written([s for s in formula.inputs if s.index not in early]))
    body = [*lines, f"if {holds}:", f"    return ({results},)", "return None"]
    first += [f"def path({given}):", *[f"    {line}" for line in body], "return path"]
    return "\n    ".join([f"def made({', '.join(written(known))}):", *first]) + "\n"


def _literal(number: Any) -> str:
    return f"({number.item()!r})" if isinstance(number, np.generic) else repr(number)


class Template:
    """What a function does to its arguments, which are inputs named by their places."""

    def __init__(self, dtype: np.dtype[Any], factory: Factory, arguments: Sequence[Any]) -> None:
        self._recorder, inputs = Recorder(dtype), []
        for place, argument in enumerate(arguments):
            known, kind, positive = _form_of(argument)
            if not known:
                inputs.append(self._recorder.input(str(place), kind))
                inputs[-1].positive = positive
            else:
                inputs.append(argument)
        self.results = factory(reproducible_symbolic(dtype.name))(*inputs)
        self._parts: dict[tuple[int, ...], tuple[Formula, tuple[int, ...]]] = {}
        self._makers: dict[Any, Callable[..., Callable[..., Any]]] = {}

    def needs(self, which: tuple[int, ...]) -> tuple[int, ...]:
        """Return the places of the arguments that some of the results need."""
        return self._part(which)[1]

    def length(self, which: tuple[int, ...]) -> int:
        """Return how many operations some of the results take."""
        return len(self._part(which)[0].steps)

    def function(
        self, which: tuple[int, ...], arguments: Sequence[Any]
    ) -> tuple[Callable[..., Any], list[int]]:
        """Return the function that gives some of the results, and the places of what it is given.

        Arguments that are known are part of the function.
        """
        places = self.needs(which)
        known = [place for place in places if not isinstance(arguments[place], Symbol)]
        try:
            function = self._made(which, known)(*[float(arguments[place]) for place in known])
        except (ArithmeticError, TypeError, ValueError):
            return self._made(which, [])(), list(places)
        return function, [place for place in places if place not in known]

    def _made(self, which: tuple[int, ...], known: list[int]) -> Callable[..., Callable[..., Any]]:
        key = which, tuple(known)
        if key not in self._makers:
            formula, places = self._part(which)
            symbols = dict(zip(places, formula.inputs, strict=True))
            self._makers[key] = float_path(formula, [symbols[place] for place in known])
        return self._makers[key]

    def _part(self, which: tuple[int, ...]) -> tuple[Formula, tuple[int, ...]]:
        if which not in self._parts:
            results = tuple([self.results[place] for place in which])
            conditions = tuple(self._recorder.requirements)
            formula = Formula(self._recorder.dtype, results, conditions, apart=True)
            places = tuple([int(symbol.operands[0]) for symbol in formula.inputs])
            self._parts[which] = formula, places
        return self._parts[which]


_TEMPLATES: dict[Hashable, Template] = {}
_MOST_TEMPLATES = 4096


def call(
    recorder: Recorder, key: Hashable | None, factory: Factory, arguments: Sequence[Any]
) -> tuple[Any, ...]:
    """Record the call of a function that a factory makes, and return its results.

    The key names the function for all paths; without one, it is recorded for this path alone.
    """
    whole = key, recorder.dtype, tuple(map(_form_of, arguments))
    template = None if key is None else _TEMPLATES.get(whole)
    if template is None:
        template = Template(recorder.dtype, factory, arguments)
        if key is not None:
            if len(_TEMPLATES) >= _MOST_TEMPLATES:
                _TEMPLATES.clear()
            _TEMPLATES[whole] = template
    operands = template, *arguments
    names = map(key_of, arguments)
    made = recorder.entered(("call", id(template), *names), "call", operands, "float", ONE_AXIS)
    results = []
    for place, result in enumerate(template.results):
        if not isinstance(result, Symbol):
            results.append(result)
        elif result.operation == "input":
            results.append(arguments[int(result.operands[0])])
        else:
            item = recorder.entered(
                ("item", made.index, place), "item", (made, place), result.kind, ONE_AXIS
            )
            item.positive = result.positive
            results.append(item)
    return tuple(results)


def _form_of(argument: Any) -> tuple[str, str, bool]:
    """Return what a function knows of an argument: all of it, or its kind and its sign."""
    if isinstance(argument, Symbol):
        return "", argument.kind, argument.positive
    if isinstance(argument, (float, np.floating)) and argument not in (0.0, 1.0):
        return "", "float", bool(argument >= 0.0)
    return repr(argument), "", False  # 0.0 and -0.0 are equal, and so are 1 and True.


class CallingCarrier(Carrier):
    """Carries light as another carrier does, whose actions are recorded as calls."""

    def __init__(self, recorder: Recorder, carrier: Carrier) -> None:
        super().__init__(carrier.xp)
        self.recorder = recorder
        self.carrier = carrier

    def evaluated(self, kernel: Kernel, arguments: Sequence[Any]) -> Numbers:
        if not any(isinstance(argument, Symbol) for argument in arguments):
            return super().evaluated(kernel, arguments)
        # A kernel of a user's own may read what changes.
        key = kernel if kernel.is_built_in else None
        return call(self.recorder, key, kernel.made_for, arguments)

    def emit(self, stokes: Components, count: int = 4) -> Any:
        return self._call("emit", lambda carrier, *of: carrier.emit(*of, count), count, stokes)

    def act(self, structure: Structure, numbers: Numbers, state: Any, count: int = 4) -> Any:
        return self._call(
            "act",
            lambda carrier, *of: carrier.act(structure, *of, count),
            (structure.name, count),
            tuple(numbers),
            state,
        )

    def add(self, first: Any, second: Any) -> Any:
        return self._call("add", lambda carrier, *of: carrier.add(*of), None, first, second)

    def meet(self, solver: SolvedLoop, arriving: Mapping[int, Any]) -> dict[int, Any]:
        return self.carrier.meet(solver, arriving)

    def read(self, state: Any, count: int = 4) -> tuple[Components, Any]:
        result: tuple[Components, Any]
        result = self._call("read", lambda carrier, *of: carrier.read(*of, count), count, state)
        return result

    def _call(self, name: str, method: Callable[..., Any], about: Any, *states: Any) -> Any:
        """Record the call of a method, whose arguments and result are numbers in tuples."""
        leaves: list[Any] = []
        shape = _shape_of(states, leaves)
        if not any(isinstance(leaf, Symbol) for leaf in leaves):
            return method(self.carrier, *states)
        shapes: list[Any] = []

        def factory(xp: Any) -> Callable[..., tuple[Any, ...]]:
            carrier = self.carrier.made_for(xp)

            def function(*numbers: Any) -> tuple[Any, ...]:
                results: list[Any] = []
                result = method(carrier, *_filled(shape, iter(numbers)))
                shapes.append(_shape_of(result, results))
                return tuple(results)

            return function

        key = name, type(self.carrier), about, shape
        results = call(self.recorder, key, factory, leaves)
        if shapes:
            _SHAPES[key] = shapes[0]
        return _filled(_SHAPES[key], iter(results))


_SHAPES: dict[Hashable, Any] = {}


def _shape_of(state: Any, leaves: list[Any]) -> Any:
    """Return how numbers are put together in tuples, and add them to a list."""
    if isinstance(state, tuple):
        return tuple([_shape_of(part, leaves) for part in state])
    leaves.append(state)
    return None


def _filled(shape: Any, leaves: Iterator[Any]) -> Any:
    return next(leaves) if shape is None else tuple([_filled(part, leaves) for part in shape])
