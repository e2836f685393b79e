"""Plans for other processes: the path as text, options, classes of a user's own."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, fields
from functools import lru_cache
from hashlib import sha256
from importlib import import_module
from inspect import unwrap
from threading import Lock
from types import CodeType, ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.composer import Composer
from optipath.elements.own_element import is_own
from optipath.errors import PathError
from optipath.paths.files.reader import path_of_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


@dataclass(frozen=True)
class PlanRecipe:
    """The texts that a plan is made of, compiled once by each process.

    >>> import pickle
    >>> import optipath as op
    >>> recipe = PlanRecipe.of(op.load_preset("malus"))
    >>> there = pickle.loads(pickle.dumps(recipe))
    >>> print(there.plan.run(angle=0.0).intensity)
    0.5
    """

    text: str
    options: tuple[tuple[str, Any], ...] = ()
    own: tuple[OwnClass, ...] = ()
    made: Plan | None = field(default=None, compare=False, repr=False)

    @classmethod
    def of(cls, path: PathGraph, composer: Composer | None = None) -> PlanRecipe:
        """Return the recipe of a path."""
        chosen = composer or Composer()
        options = ((each.name, getattr(chosen, each.name)) for each in fields(Composer))
        usual = Composer()
        messages = tuple(
            [(name, value) for name, value in options if value != getattr(usual, name)]
        )
        own = _own_classes(path)
        # Where a class was defined anew since, its kind stands for another one.
        made = path.plan_by(chosen) if own else None
        return cls(path.to_toml(), messages, own, made)

    def __getstate__(self) -> dict[str, Any]:
        """Leave the plan where it was made."""
        return {**self.__dict__, "made": None}

    def __dask_tokenize__(self) -> tuple[Any, ...]:
        """Return what tells it from others."""
        return self.text, self.options, self.own

    @property
    def plan(self) -> Plan:
        """The plan, made once a process."""
        if self.made is not None:
            return self.made
        with _making:
            return _plan_of(self)


def _own_classes(path: PathGraph) -> tuple[OwnClass, ...]:
    classes = {type(node["element"]) for node in path.graph.nodes.values()}
    return tuple(sorted(OwnClass.of(each) for each in classes if is_own(each)))


_making = Lock()
"""Threads that ask for one plan at once share it."""


@lru_cache(maxsize=8)
def _plan_of(recipe: PlanRecipe) -> Plan:
    modules = sorted({each.module for each in recipe.own})
    for module in modules:
        try:
            import_module(module)
        except ImportError as error:
            raise PathError(
                f"elements of the path are defined in '{module}', which cannot be imported here: "
                f"{error}; put it where every worker finds it"
            ) from None
    try:
        path = path_of_text(recipe.text, "the path of a sweep")
    except PathError as error:
        if "__main__" not in modules:
            raise
        raise PathError(
            *error.faults,
            "elements that are defined in the script itself are not there in another process; put "
            "their classes into a module of its own and import it, or use threads",
        ) from None
    _check_own(recipe.own, _own_classes(path))
    return Composer(**dict(recipe.options)).compose(path)


def _check_own(there: tuple[OwnClass, ...], here: tuple[OwnClass, ...]) -> None:
    """Refuse classes that are other ones than where the recipe was made."""
    # What is a script in one process may have another name in the next.
    known = {(each.name, each.digest) for each in here}
    if faults := [
        f"element class '{each.name}' of module '{each.module}' is another one on the worker than "
        f"in the path that is swept; start workers anew when its code was edited, and put what was "
        f"defined by hand, such as in a cell of a notebook, into a module"
        for each in there
        if (each.name, each.digest) not in known
    ]:
        raise PathError(*faults)


_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


class OwnClass(NamedTuple):
    """What tells a class from another one of its name."""

    module: str
    name: str
    digest: str = ""

    @classmethod
    def of(cls, element_class: type[Any]) -> OwnClass:
        """Return what tells a class from others.

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
