"""Element classes of a user's own, told apart by their code and not by their names alone."""

from __future__ import annotations

import re
from hashlib import sha256
from inspect import unwrap
from types import CodeType, ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


class OwnClass(NamedTuple):
    """What tells a class from another one of its name."""

    module: str
    name: str
    digest: str = ""

    @classmethod
    def of(cls, element_class: type[Any]) -> OwnClass:
        """Return what tells a class from others.

        Examples
        --------
        >>> def made(factor):
        ...     class Times:
        ...         def of(self, x):
        ...             return factor * x
        ...
        ...     return Times
        >>> OwnClass.of(made(2)) == OwnClass.of(made(2))
        True
        >>> OwnClass.of(made(2)) == OwnClass.of(made(3))
        False
        """
        digest = sha256()
        for text in _Content(element_class.__module__).of(element_class):
            digest.update(f"{len(text)} {text}".encode())
        name = element_class.__qualname__
        return cls(element_class.__module__, name, digest.hexdigest()[:16])


class _Content:
    """What is in code, as texts: no addresses, lines, or names of files."""

    def __init__(self, module: str) -> None:
        self._module = module
        self._met = dict[int, Any]()

    def of(self, value: Any) -> Iterator[str]:
        """Yield texts that two values have in common if they do the same."""
        if isinstance(value, (tuple, list)):
            yield from self._once(value, value)
        elif isinstance(value, dict):
            yield from self._once(value, [*value.items()])
        elif isinstance(value, (set, frozenset)):
            yield from sorted(map(repr, value))
        elif isinstance(value, np.ndarray) and not value.dtype.hasobject:
            yield f"{value.dtype.str} {value.shape} {sha256(value.tobytes()).hexdigest()}"
        elif isinstance(value, CodeType):
            yield f"{value.co_code.hex()} {value.co_names} {value.co_varnames}"
            yield from self._each(value.co_consts)
        elif isinstance(value, ModuleType):
            yield value.__name__
        elif isinstance(value, (staticmethod, classmethod)):
            yield from self.of(value.__func__)
        elif isinstance(value, property):
            yield from self._each((value.fget, value.fset))
        elif isinstance(value, type) or hasattr(code := _unwrapped(value), "__code__"):
            named = value if isinstance(value, type) else code
            yield f"{named.__module__}.{named.__qualname__}"
            if _top(named.__module__) == _top(self._module):
                parts = _of_class if isinstance(value, type) else _of_function
                yield from self._once(named, parts(named))
        else:
            yield f"{type(value).__qualname__} {_ADDRESS.sub('', repr(value))}"

    def _once(self, value: Any, parts: Iterable[Any]) -> Iterator[str]:
        """Yield what is in the parts of what may have itself among them."""
        if id(value) not in self._met:
            self._met[id(value)] = value
            yield from self._each(parts)
            if isinstance(value, tuple):
                del self._met[id(value)]

    def _each(self, values: Iterable[Any]) -> Iterator[str]:
        for value in values:
            yield "("
            yield from self.of(value)
            yield ")"


def _of_class(value: type[Any]) -> Iterator[Any]:
    """Yield its bases, its fields, its constants, and its functions."""
    yield value.__bases__
    for name, each in sorted(vars(value).items()):
        # Python and optipath enter what follows from the rest.
        if name == "_kernel" or (name[:2] == "__" and not hasattr(_unwrapped(each), "__code__")):
            continue
        yield name, each


def _of_function(value: Any) -> Iterator[Any]:
    """Yield its code, and all that this uses."""
    yield value.__code__, value.__defaults__, value.__kwdefaults__
    for cell in value.__closure__ or ():
        yield getattr(cell, "cell_contents", None)
    known = value.__globals__
    yield from [(name, known[name]) for name in _names(value.__code__) if name in known]


def _names(code: CodeType) -> list[str]:
    """Return the names that code looks up, with what is defined within it."""
    inner = [name for each in code.co_consts if isinstance(each, CodeType) for name in _names(each)]
    return sorted({*code.co_names, *inner})


def _unwrapped(value: Any) -> Any:
    if isinstance(value, (staticmethod, classmethod)):
        value = value.__func__
    return unwrap(value) if callable(value) else value


def _top(module: str) -> str:
    return module.partition(".")[0]
