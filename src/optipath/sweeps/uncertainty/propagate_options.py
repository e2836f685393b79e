"""What `PathGraph.propagate` is told besides values, and what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from optipath.composer.composer import Composer
from optipath.errors import shown, unknown
from optipath.values.whole_numbers import is_whole, whole_number

if TYPE_CHECKING:
    from optipath.values.inputs import Inputs

METHODS = ("auto", "gradients", "differences", "monte-carlo")
_SAMPLES, _SEED = 10_000, 0
_FEWEST, _MOST = 2, 10_000_000


@dataclass(frozen=True)
class PropagateOptions:
    """The options of `PathGraph.propagate`, as they are given."""

    method: str = "auto"
    samples: int | None = None
    seed: int | None = None
    correlation: object = None
    detector: str | None = None
    composer: Composer | None = None

    @property
    def draws(self) -> bool:
        """Whether samples are drawn."""
        return self.method == METHODS[-1]

    @property
    def count(self) -> int:
        """How many samples are drawn."""
        return _SAMPLES if self.samples is None else int(self.samples)

    @property
    def beginning(self) -> int:
        """What random numbers begin with."""
        return _SEED if self.seed is None else int(self.seed)

    def clashes(self, inputs: Inputs) -> list[str]:
        """Return what is said of parameters that are called as options, a sentence each."""
        return [
            f"'{each.name}' is an option of propagate() and a parameter of this path; "
            f"path.bind({each.name}=...) gives the parameter its value"
            for each in fields(self)
            if each.name in inputs.open
        ]

    def faults(self) -> list[str]:
        """Return what is wrong with them, a sentence each."""
        found = unknown("method", self.method, METHODS)
        if self.composer is not None and not isinstance(self.composer, Composer):
            found.append(f"composer must be an op.Composer(...), not {shown(self.composer)}")
        if self.samples is not None and not is_whole(self.samples, _FEWEST, _MOST):
            found.append(
                f"samples must be a whole number within {_FEWEST} .. {_MOST:,}, "
                f"not {shown(self.samples)}"
            )
        if self.seed is not None:
            found += whole_number("seed", self.seed, 0)
        drawn = [name for name in ("samples", "seed") if getattr(self, name) is not None]
        if drawn and not unknown("method", self.method, METHODS) and not self.draws:
            found.append(
                f"method='{self.method}' draws no samples; leave {' and '.join(drawn)} out, or "
                f"write method='monte-carlo'"
            )
        return found
