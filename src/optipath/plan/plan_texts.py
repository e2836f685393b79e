"""What a plan says of itself, in words and in counts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.engines.automatic import LARGE
from optipath.errors import ParameterError
from optipath.values.arrays.shapes import MOST_PATHS
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from optipath.plan.explanation import Explanation


class PlanTexts:
    """The part of a plan that explains it."""

    answers: Any

    @property
    def engine(self) -> str:
        """What runs large batches; `engine_for` says what runs smaller ones."""
        return self.engine_for(LARGE).partition(",")[0]

    def engine_for(self, count: int, /) -> str:
        """Return what runs a batch of so many paths.

        Examples
        --------
        >>> import optipath as op
        >>> plan = op.Composer(engine="numpy").compose(op.load_preset("malus"))
        >>> plan.engine, plan.engine_for(10)
        ('numpy', 'numpy, step by step')
        """
        if faults := whole_number("the number of paths", count, 0):
            raise ParameterError(*faults)
        return self.answers.light.engine_for(min(count, MOST_PATHS))  # type: ignore[no-any-return]

    def explain(self) -> str:
        """Return the plan in words: its steps in order, what it reads, what leaves unread.

        Examples
        --------
        >>> import optipath as op
        >>> plan = op.Composer(engine="numpy").compose(op.load_preset("malus"))
        >>> print(plan.explain().splitlines()[0])
        1 source, 1 detector, 5 steps; method stable, model linear, engine numpy, float64
        """
        return str(self.explanation())

    def explanation(self) -> Explanation:
        """Return the plan explained, part by part, as `explain` writes it down."""
        # Imported where it is needed, so that the library itself is there quickly.
        from optipath.plan.explaining import explanation_of  # noqa: PLC0415

        return explanation_of(self)

    def evaluations(self, /, **parameters: Any) -> dict[str, int]:
        """Return how often each step's numbers are computed for a batch.

        An element is evaluated only along those axes of a batch on which it depends: an
        interface that sees one of the two axes of a grid once for each value on it, and one
        without open values once.

        Raises
        ------
        ParameterError
            As `run`.

        Examples
        --------
        >>> import numpy as np
        >>> import optipath as op
        >>> plan = op.load_preset("npgr026").compose()
        >>> delta, phi = np.linspace(0, 1, 1000)[:, np.newaxis], np.linspace(0, 1, 1000)
        >>> found = plan.evaluations(delta=delta, phi=phi)
        >>> found["X1.reflected"], found["X2.reflected"]
        (1000, 1000)
        """
        from optipath.plan.running.counts import evaluations  # noqa: PLC0415 - not for every import

        return evaluations(self.answers.light, parameters)
