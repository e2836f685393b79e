"""Question: what is asked of a path, whatever it is.

A question says which formula answers it, how it is answered step by step, what JAX is asked,
and what becomes of the results. How a batch is run is the same for all: see `Runner`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, Protocol

from optipath.values.arrays.memory import CURE

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping

    import numpy as np

    from optipath.engines.formulas.formula import Formula
    from optipath.plan.running.batch_runner import Results
    from optipath.plan.running.for_jax import ForJax
    from optipath.plan.running.formula_maker import FormulaMaker
    from optipath.plan.running.interpreter import Interpreter, Shared
    from optipath.plan.running.reading import ResolvedInputs

    Array = np.ndarray[Any, Any]
    Batch = tuple[int, ...]


class Asked(Protocol):
    """What a question asks: a program that is run step by step, or by JAX."""

    interpreter: Interpreter
    for_jax: ForJax

    def refuse_infinite(self, numbers: Any) -> None:
        """Refuse light that is not finite."""


class Question(ABC):
    """What is asked of a runner."""

    key: Hashable
    read: int
    cure = CURE
    is_light = False

    @abstractmethod
    def numbers(self, *, stepped: bool) -> int:
        """Return how many numbers a path takes at least, results and what is made on the way."""

    @abstractmethod
    def formula(self, maker: FormulaMaker, forms: Mapping[Any, str], axes: Any) -> Formula:
        """Return the formula of the results, for numbers of some forms."""

    @abstractmethod
    def rows(self, runner: Asked, given: ResolvedInputs, shared: Shared) -> Array:
        """Return the results step by step.

        Shape: returns (results, paths).
        """

    def by_jax(self, runner: Asked, resolved: Any, batch: Batch, parameters: Any) -> Any:
        """Return what the user gets of JAX; None where NumPy is to be asked."""
        del runner, resolved, batch, parameters

    @abstractmethod
    def answer(self, results: Results, batch: Batch) -> Any:
        """Return what the user gets."""
