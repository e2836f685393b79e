"""A plan as it travels: the text of its path, and the options of its composer."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import lru_cache
from importlib import import_module
from threading import Lock
from typing import TYPE_CHECKING, Any

from optipath.composer.composer import Composer
from optipath.elements.own_couplings import is_own
from optipath.errors import PathError
from optipath.paths.presets.preset_text import path_of_text

if TYPE_CHECKING:
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan


@dataclass(frozen=True)
class PlanRecipe:
    """What a plan is made of, wherever it is to run: texts, and no code.

    Each process makes the plan once, and compiles it or finds its own compiled code.

    Attributes
    ----------
    text : str
        The path, as `PathGraph.to_toml` writes it.
    options : tuple of (str, Any)
        Those of the `Composer` that are not as they are by default.
    modules : tuple of str
        Where elements of a user's own are defined; they are imported first.

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
    modules: tuple[str, ...] = ()

    @classmethod
    def of(cls, path: PathGraph, composer: Composer | None = None) -> PlanRecipe:
        """Return the recipe of a path.

        Parameters
        ----------
        path : PathGraph
            What is to run.
        composer : Composer, optional
            How it is composed; the default one if not given.

        Returns
        -------
        PlanRecipe

        Raises
        ------
        PathError
            If the path has no form in TOML.
        """
        chosen = composer or Composer()
        options = ((each.name, getattr(chosen, each.name)) for each in fields(Composer))
        usual = Composer()
        told = tuple([(name, value) for name, value in options if value != getattr(usual, name)])
        classes = {type(node["element"]) for node in path.graph.nodes.values()}
        own = sorted({each.__module__ for each in classes if is_own(each)})
        return cls(path.to_toml(), told, tuple(own))

    @property
    def plan(self) -> Plan:
        """The plan, made once a process.

        Raises
        ------
        PathError
            If an element of a user's own is not there in this process.
        """
        with _making:
            return _plan_of(self)


_making = Lock()
"""Threads that ask for one plan at once share it."""


@lru_cache(maxsize=8)
def _plan_of(recipe: PlanRecipe) -> Plan:
    for module in recipe.modules:
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
        if "__main__" not in recipe.modules:
            raise
        raise PathError(
            *error.faults,
            "elements that are defined in the script itself are not there in another process; put "
            "their classes into a module of its own and import it, or use threads",
        ) from None
    return Composer(**dict(recipe.options)).compose(path)
