"""What runs against each other in a chart: methods, precisions, engines, ways of composing."""

from __future__ import annotations

from itertools import product

from optipath.composer.composer import CHOICES, Composer
from optipath.engines.automatic import is_installed
from optipath.errors import ComposerError
from optipath.kernels.catalogue import METHODS
from optipath.values.precision import DTYPES, precision

WORDS = ("method", "dtype", "engine", "composing")
"""What tells contenders apart, as `Composer` takes it."""


def contenders(
    composing: tuple[str, ...] = CHOICES["composing"], engines: tuple[str, ...] = ("numpy", "numba")
) -> list[Composer]:
    """Return all that this machine can run.

    JAX is not among them: it compiles anew for every path that it is given.

    Examples
    --------
    >>> Composer("stable", engine="numpy", composing="jones") in contenders()
    True
    """
    return [
        Composer(method, dtype=dtype, engine=engine, composing=way)
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
