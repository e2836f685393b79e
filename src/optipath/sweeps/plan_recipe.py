"""Plans for other processes: the path as text, options, classes of a user's own."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field, fields
from functools import lru_cache
from hashlib import sha256
from importlib import import_module
from inspect import unwrap
from pathlib import Path
from threading import Lock
from types import CodeType
from typing import TYPE_CHECKING, Any, NamedTuple
from uuid import uuid4

import numpy as np

from optipath.composer.composer import Composer
from optipath.elements.own_element import is_own
from optipath.errors import PathError
from optipath.paths.files.reader import path_of_text

if TYPE_CHECKING:
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
        chosen, usual = composer or Composer(), Composer()
        options = [(each.name, getattr(chosen, each.name)) for each in fields(Composer)]
        unusual = tuple([(name, n) for name, n in options if n != getattr(usual, name)])
        own = _own_classes(path)
        # Where a class was defined anew since, its kind stands for another one.
        made = path.plan_by(chosen) if own else None
        return cls(path.to_toml(), unusual, own, made)

    def __getstate__(self) -> dict[str, Any]:
        """Leave the plan where it was made."""
        return {**self.__dict__, "made": None}

    def __dask_tokenize__(self) -> tuple[Any, ...]:
        """Return what tells it from others."""
        return self.text, self.options, self.own, uuid4().hex if self.without_source else ""

    @property
    def without_source(self) -> list[str]:
        """The names of classes that no file defines."""
        return [each.name for each in self.own if not each.digest]

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
    try:
        for module in {each.module for each in recipe.own}:
            import_module(module)
        path = path_of_text(recipe.text, "the path of a sweep")
    except (ImportError, PathError) as error:
        if not recipe.own:
            raise
        modules = ", ".join(sorted({f"'{each.module}'" for each in recipe.own}))
        raise PathError(
            f"element classes of the path, of {modules}, are not there in another process: "
            f"{error}; define them in a module that workers can import, or use threads"
        ) from None
    # What is a script in one process may have another name in the next.
    here = {(each.name, each.digest) for each in _own_classes(path)}
    PathError.raise_for(
        f"element class '{each.name}' of module '{each.module}' is another one on the worker than "
        f"in the path that is swept; define it in a module, and start workers anew after edits"
        for each in recipe.own
        if not each.digest or (each.name, each.digest) not in here
    )
    return Composer(**dict(recipe.options)).compose(path)


class OwnClass(NamedTuple):
    """What tells a class from another one of its name; no digest for one that no file defines."""

    module: str
    name: str
    digest: str = ""

    @classmethod
    def of(cls, element_class: type[Any]) -> OwnClass:
        """Return what tells a class from others: files of its package, its code and numbers."""
        module, name = element_class.__module__, element_class.__qualname__
        package = sys.modules.get(module.partition(".")[0])
        file = getattr(package, "__file__", None)
        if file is None or "<locals>" in name or not Path(file).is_file():
            return cls(module, name)
        is_one = not hasattr(package, "__path__")
        digest = sha256()
        for source in [Path(file)] if is_one else sorted(Path(file).parent.rglob("*.py")):
            digest.update(sha256(source.read_bytes()).digest())
        # A file may have been edited after the class was imported.
        used = dict(vars(element_class))
        todo = [*used.values()]
        while todo:
            each = todo.pop(0)
            function = unwrap(getattr(each, "__func__", each)) if callable(each) else each
            code = getattr(function, "__code__", None)
            if code is None or function.__module__ != module:
                continue
            known, codes = function.__globals__, [code]
            for inner in codes:  # Functions within it, and comprehensions before Python 3.12.
                codes += [part for part in inner.co_consts if isinstance(part, CodeType)]
                constants = [n for n in inner.co_consts if isinstance(n, int | float | complex)]
                digest.update(repr((inner.co_code, inner.co_names, constants)).encode())
                more = {n: known[n] for n in inner.co_names if n in known and n not in used}
                used |= more
                todo += more.values()
        # Numbers may be out of other files, or from the command line.
        for key in sorted(used):
            if key[:2] != "__":
                digest.update(key.encode() + _numbers_in(used[key]))
        return cls(module, name, digest.hexdigest()[:16])


def _numbers_in(value: Any) -> bytes:
    """Return what tells numbers and texts from others; nothing of what is neither."""
    if isinstance(value, np.ndarray | np.generic) and not value.dtype.hasobject:
        return f"{value.dtype.str} {value.shape} ".encode() + value.tobytes()
    if isinstance(value, int | float | complex | str):
        return repr(value).encode()
    parts = value.items() if isinstance(value, dict) else value
    return b"(%b)" % b",".join(map(_numbers_in, parts)) if isinstance(value, _SEVERAL) else b""


_SEVERAL = tuple, list, dict
