"""What runs against each other in a chart: methods, precisions, engines, ways of composing."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import product

from optipath.composer import CHOICES, Composer
from optipath.errors import ComposerError
from optipath.kernels import METHODS
from optipath.precision import DTYPES, precision


@dataclass(frozen=True)
class Contender:
    """One way to compute a path.

    Attributes
    ----------
    method, dtype, engine, composing : str
        As `Composer` takes them.
    """

    method: str = "stable"
    dtype: str = "float64"
    engine: str = "numpy"
    composing: str = "stokes"

    @property
    def composer(self) -> Composer:
        """The composer that computes so."""
        return Composer(**asdict(self))


def contenders(composing: tuple[str, ...] = CHOICES["composing"]) -> list[Contender]:
    """Return all that this machine can run.

    Examples
    --------
    >>> Contender("stable", "float64", "numpy", "jones") in contenders()
    True
    """
    engines = tuple(engine for engine in CHOICES["engine"] if engine != "auto")
    found = product(METHODS, available_dtypes(), engines, composing)
    return [Contender(*words) for words in found]


def available_dtypes() -> tuple[str, ...]:
    """Return the precisions that this platform has."""
    return tuple(name for name in DTYPES if _exists(name))


def _exists(name: str) -> bool:
    try:
        precision(name)
    except ComposerError:
        return False
    return True
