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

    Parameters
    ----------
    composing, engines : tuple of str, optional
        Those that are wanted.

    Returns
    -------
    list of Contender
        Those whose engine is installed and has their precision.

    Examples
    --------
    >>> Contender("stable", "float64", "numpy", "jones") in contenders()
    True
    """
    return [
        Contender(method, dtype, engine, way)
        for method, dtype, engine, way in product(METHODS, available_dtypes(), engines, composing)
        if engine == "numpy" or (is_installed(engine) and dtype != "longdouble")
    ]


def available_dtypes() -> tuple[str, ...]:
    """Return the precisions that this platform has."""
    return tuple(name for name in DTYPES if _exists(name))


def _exists(name: str) -> bool:
    try:
        precision(name)
    except ComposerError:
        return False
    return True
