"""A plan as it travels: the text of its path, and the options of its composer."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import lru_cache
from importlib import import_module
from threading import Lock
from typing import TYPE_CHECKING, Any

from optipath.composer.composer import Composer
from optipath.elements.own_couplings import is_own
from optipath.errors import PathError
from optipath.paths.presets.preset_text import path_of_text
from optipath.sweeps.chunked.own_class import OwnClass

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


@dataclass(frozen=True)
class PlanRecipe:
    """What a plan is made of, wherever it is to run: texts, and no code.

    Each process makes the plan once, and compiles it or finds its own compiled code.

    Examples
    --------
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
        told = tuple([(name, value) for name, value in options if value != getattr(usual, name)])
        own = _own_classes(path)
        # Where a class was defined anew since, its kind stands for another one.
        made = path.plan_by(chosen) if own else None
        return cls(path.to_toml(), told, own, made)

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
