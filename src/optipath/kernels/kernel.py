"""Kernel: one piece of the physics, its structure and its methods; kernels of a user's own."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np

from optipath.errors import ComposerError, OptipathError, PathError
from optipath.faults import did_you_mean, unknown
from optipath.kernels.primitives import (
    FLOAT,
    NUMPY,
    Factory,
    KernelFunction,
    Made,
    Primitives,
    made,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from optipath.kernels.carriers.structures import Structure


Entry: TypeAlias = float | None
"""A number that is known before a path runs; None where it depends on arguments."""

Known: TypeAlias = tuple[str, *tuple[int, ...]]
"""A sign for each number, 0, 1 or a dot for what is open, and the places of the arguments that must
be 0 for that, counted from the end if negative: ``("11010", 0)``."""

_SIGNS: dict[str, Entry] = {"0": 0.0, "1": 1.0, ".": None}


@dataclass(frozen=True)
class Kernel:
    """A pure elementwise function, made for any set of primitives.

    `known` declares which of its numbers are constants, by which a path is reduced: a component of
    light that stays 0 is not computed.
    """

    name: str
    structure: Structure | None
    factory: Factory
    without: tuple[int, Kernel] | None = None
    denser: tuple[int, int, Kernel] | None = None
    powers: Kernel | None = None
    unpolarising: Kernel | None = None
    known: tuple[Known, ...] = ()

    def __hash__(self) -> int:
        # Asked for once a step; what else belongs to a name is compared where names are equal.
        return hash(self.name)

    def made_for(self, primitives: Primitives) -> KernelFunction:
        """Return the function in terms of these primitives, made once and kept."""
        factory = self.factory
        if not self.of_library:
            factory = Made(guarded, f"kernel '{self.name}'", factory)
        function: KernelFunction = made(factory, primitives)
        return function

    @cached_property
    def has_cheaper(self) -> bool:
        """Whether another kernel is cheaper for some arguments."""
        return self.without is not None or self.denser is not None

    @cached_property
    def of_library(self) -> bool:
        """Whether it comes with the library, so that nothing it raises is a user's doing."""
        return _is_defined_in("optipath.", self.factory)

    @cached_property
    def is_built_in(self) -> bool:
        """Whether it is one of `optipath.kernels`, of which all are elementwise."""
        return _is_defined_in("optipath.kernels.", self.factory)

    def specialised(
        self, arguments: Sequence[Any], vanishes: Callable[[Any], bool]
    ) -> tuple[Kernel, tuple[Any, ...]]:
        """Return the cheapest kernel for these arguments, and those that it takes."""
        if self.without is None or not vanishes(arguments[self.without[0]]):
            return self, tuple(arguments)
        position, cheaper = self.without
        left = (*arguments[:position], *arguments[position + 1 :])
        return cheaper.specialised(left, vanishes)

    def never_less(
        self, arguments: Sequence[Any], ranges: Callable[[Any], tuple[float, float]]
    ) -> Kernel:
        """Return the cheapest kernel for the ranges that the arguments are known to be in."""
        if self.denser is None:
            return self
        larger, smaller, cheaper = self.denser
        known = ranges(arguments[larger])[0] >= ranges(arguments[smaller])[1]
        return cheaper if known else self

    def known_numbers(self, zeros: Collection[int], count: int) -> tuple[Entry, ...]:
        """Return the declared numbers, for the places of those of so many arguments that are 0."""
        results: tuple[Entry, ...] = ()
        for signs, *places in self.known:
            if all(place % count in zeros for place in places):
                numbers = [_SIGNS[sign] for sign in signs.replace(" ", "")]
                pairs = zip(results or numbers, numbers, strict=True)
                results = tuple([old if new is None else new for old, new in pairs])
        return results

    def by_method(self, method: str) -> Kernel:
        """Return the kernel itself: it has one method only."""
        del method
        return self


@dataclass(frozen=True)
class KernelFamily:
    """One piece of the physics that several methods compute."""

    name: str
    methods: Mapping[str, Kernel]

    def by_method(self, method: str) -> Kernel:
        """Return the kernel of a method."""
        try:
            return self.methods[method]
        except (KeyError, TypeError):
            raise ComposerError(*unknown("method", method, self.methods)) from None


def sloped(values: Factory, slopes: Factory, xp: Primitives) -> KernelFunction:
    """Make a kernel with the slopes of another, more exact one."""
    return (slopes if xp.within else values)(xp)


T = TypeVar("T")

FUNCTIONS = tuple(f.name for f in fields(Primitives))
"""What ``xp`` has."""

_LONGEST = 200

_OTHERWISE = {
    "abs": "xp.absolute(x)",
    "arctan2": "xp.atan2(y, x)",
    "arcsin": "xp.atan2(x, xp.sqrt(1.0 - x * x))",
    "arccos": "xp.atan2(xp.sqrt(1.0 - x * x), x)",
    "tan": "xp.sin(x) / xp.cos(x)",
    "power": "x**y",
    "pi": "math.pi",
    "array": "the rows as tuples of entries",
}
"""How what other libraries have is written by what ``xp`` has."""

_CHOOSE = "choose by xp.where(condition, yes, no) in place of 'if', 'and', 'min', 'max'"
_CALL = "call xp.cos, xp.sqrt, ... in place of the functions of numpy and math"
_CURES = (
    ("truth value", _CHOOSE),
    ("boolean conversion of traced", _CHOOSE),
    ("true nor false", _CHOOSE),
    ("arrays can be converted", _CALL),
    ("must be real number, not", _CALL),
    ("tracer", _CALL),
    ("inhomogeneous", "return the rows as tuples of entries, and no array of them"),
    ("read-only", "make a new number, a = a + 1, in place of a += 1: arguments are the caller's"),
    ("division by zero", "let xp.where choose another divisor there"),
)
"""Cures by words of the message of Python, NumPy or JAX."""


def in_words(what: str, error: BaseException) -> OptipathError:
    """Return an error of the library for what code of a user's own has raised."""
    if isinstance(error, AttributeError) and isinstance(error.obj, Primitives):
        known = _OTHERWISE.get(str(error.name))
        cure = f"; write {known}" if known else did_you_mean(error.name, FUNCTIONS)
        return PathError(f"{what} calls xp.{error.name}, which does not exist{cure}")
    text = " ".join(str(error).split())
    lower = text.lower()
    cure = next((cure for sign, cure in _CURES if sign in lower), "")
    text = text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
    return PathError(f"{what} raises {type(error).__name__}: {text}{cure and '; ' + cure}")


def called(
    what: str,
    function: Callable[..., T],
    *arguments: Any,
    left: tuple[type[Exception], ...] = (),
) -> T:
    """Return what code of a user's own gives, which raises errors of the library alone."""
    stored: tuple[type[Exception], ...] = (MemoryError, OptipathError, Warning, *left)
    try:
        return function(*arguments)
    except stored:
        raise
    except (Exception, SystemExit) as error:
        raise in_words(what, error) from error


def _is_defined_in(package: str, factory: Any) -> bool:
    """Tell whether what makes a kernel is defined in a package, or its class is."""
    maker = factory if hasattr(factory, "__name__") else type(factory)
    return str(getattr(maker, "__module__", "")).startswith(package)


def guarded(what: str, factory: Factory, xp: Primitives) -> KernelFunction:
    """Return a function of a user's own that raises errors of the library alone."""
    if xp is not FLOAT:
        function = called(what, factory, xp)
        return lambda *values: called(what, function, *_of_one_path(values))
    of_numbers = called(what, factory, NUMPY)

    def of_floats(*values: float) -> tuple[float, ...]:
        return tuple(map(float, of_numbers(*map(np.float64, values))))

    def single(*values: float) -> tuple[float, ...]:
        with np.errstate(all="raise", under="ignore"):
            return called(what, of_floats, *values, left=(ArithmeticError, ValueError))

    return single


def _of_one_path(values: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return arrays of one number each as numbers; where one has more, all as they are."""
    if any(isinstance(value, np.ndarray) and value.shape != (1,) for value in values):
        return values
    return tuple(value[0] if isinstance(value, np.ndarray) else value for value in values)
