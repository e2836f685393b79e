"""What runs against each other in a chart: methods, precisions, engines, ways of composing."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import product

from optipath.composer import CHOICES, Composer
from optipath.engines import is_installed
from optipath.errors import ComposerError
from optipath.kernels import METHODS
from optipath.values.precision import DTYPES, precision


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


def contenders(
    composing: tuple[str, ...] = CHOICES["composing"],
    engines: tuple[str, ...] = ("numpy", "numba"),
) -> list[Contender]:
    """Return all that this machine can run.

    JAX is not among them: it compiles anew for every path that it is given.

    Examples
    --------
    >>> Contender("stable", "float64", "numpy", "jones") in contenders()
    True
    """
    found = [
        Contender(*words) for words in product(METHODS, available_dtypes(), engines, composing)
    ]
    return [one for one in found if one.engine == "numpy" or _is_compiled(one)]


def available_dtypes() -> tuple[str, ...]:
    """Return the precisions that this platform has."""
    return tuple(name for name in DTYPES if _exists(name))


def _is_compiled(contender: Contender) -> bool:
    return is_installed(contender.engine) and contender.dtype != "longdouble"


def _exists(name: str) -> bool:
    try:
        precision(name)
    except ComposerError:
        return False
    return True
