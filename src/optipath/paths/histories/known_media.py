"""Media of a chain as far as they are known: their indices, and those on both sides of a vertex."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError
from optipath.paths.histories.vertex_events import REFLECTS, REFRACTS, media_in_front
from optipath.values.arrays.jax_values import is_traced
from optipath.values.domains.indices import INDEX
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]


def known(value: Any) -> Any:
    """Return what is known of a value, be it by default; None if nothing is."""
    value = value.default if isinstance(value, Parameter) else value
    return None if value is None or is_traced(value) else value


def known_index(medium: Any) -> Floats | None:
    """Return n of a medium; None where it is not known, or absorbs.

    Examples
    --------
    >>> known_index(1.5), known_index(Parameter("n")), known_index(1.5 + 2j)
    (array(1.5), None, None)
    """
    parts = (medium.n, medium.k) if isinstance(medium, Material) else (medium,)
    several = [known(part) for part in parts]
    if any(part is None for part in several):
        return None
    try:
        n, *k = (INDEX.check("index", INDEX.read("index", part)) for part in several)
    except OptipathError:
        return None  # A fault of its own.
    clear = not (np.any(n.imag) or any(map(np.any, k)) or np.any(n.real <= 0.0))
    return np.asarray(n.real) if clear else None


def sides_of(events: str, materials: Sequence[Any], outside: Any) -> Floats | None:
    """Return the indices in front of the vertices of a chain and behind, as normals need them.

    Shape: returns (..., m, 2).

    Examples
    --------
    >>> sides_of("RT", (1.5, 1.5), 3.0)
    array([[1. , 1. ],
           [1. , 0.5]])
    """
    found: list[Any] = []
    front = media_in_front(events, materials, outside)
    for event, before, behind in zip(events, front, materials, strict=True):
        n1, n2 = (np.ones(()),) * 2 if event == REFLECTS else map(known_index, (before, behind))
        if n1 is None or n2 is None:
            return None
        found.append(over_the_larger(n1, n2, event == REFRACTS))
    try:
        return in_order(found)
    except ValueError:
        return None


def over_the_larger(n1: Any, n2: Any, refracts: Any, otherwise: Any = 1.0) -> tuple[Any, Any]:
    """Return the indices on both sides of a vertex as normals need them.

    Examples
    --------
    >>> [float(n) for n in over_the_larger(1.5, 3.0, True)]
    [0.5, 1.0]
    """
    larger = np.where(n1 == n2, np.inf, np.maximum(n1, n2))
    return np.where(refracts, n1 / larger, otherwise), np.where(refracts, n2 / larger, otherwise)


def in_order(sides: Sequence[tuple[Any, Any]]) -> Floats:
    """Return what stands on both sides of each vertex as one array, shape (..., m, 2)."""
    together = np.broadcast_arrays(*[side for both in sides for side in both])
    return np.stack(together, axis=-1).reshape(*together[0].shape, len(sides), 2)
