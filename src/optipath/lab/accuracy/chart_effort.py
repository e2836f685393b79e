"""How much of a chart is measured, and about how long that takes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.lab.accuracy.contenders import contenders

if TYPE_CHECKING:
    from optipath.composer.composer import Composer


class Effort(NamedTuple):
    """How much is measured."""

    samples: int = 24
    rounds: int = 7
    engines: tuple[str, ...] = ("numpy", "numba")
    compiles_all: bool = True

    def measures(self, runner: Composer) -> bool:
        """Tell whether a contender is measured."""
        default = runner.method == "stable" and runner.composing == "stokes"
        return (
            runner.engine == "numpy" or self.compiles_all or (default and runner.dtype == "float64")
        )

    def told(self) -> dict[str, Any]:
        """Return what a chart says of it: the numbers, and a sentence of what is left out."""
        left_out = ""
        if not self.compiles_all and "numba" in self.engines:
            left_out = "of Numba only stable in float64 with Stokes vectors"
        return {"samples": self.samples, "rounds": self.rounds, "left_out": left_out}


FULL = Effort()
QUICK = Effort(samples=3, rounds=3, compiles_all=False)
"""Less than a minute for a path of some elements."""

_COMPILED = 40.0
"""About how many seconds a contender of Numba takes to be compiled for all regions."""


def expected(effort: Effort) -> str:
    """Return about how long a chart of a path of some elements takes, before it is measured.

    Examples
    --------
    >>> expected(QUICK)
    'this takes less than a minute, more on a busy machine'
    >>> print(expected(FULL._replace(engines=("numpy",))))
    this takes about 2 minutes; --quick takes less than one
    """
    compiled = [
        runner
        for runner in contenders(engines=effort.engines)
        if runner.engine != "numpy" and effort.measures(runner)
    ]
    seconds = 20.0 + 4.0 * effort.samples + _COMPILED * len(compiled)
    minutes = round(seconds / 60)
    if not effort.compiles_all:
        return "this takes less than a minute, more on a busy machine"
    wait = " where Numba must compile (what it compiles is kept)" if compiled else ""
    return f"this takes about {minutes} minutes{wait}; --quick takes less than one"
