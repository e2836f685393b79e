"""Material: what an interface separates the light from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from optipath.values.arrays.read_only import read_only, same_fields


@dataclass(frozen=True, eq=False)
class Material:
    """A homogeneous medium, given by its complex index of refraction n + ik.

    Parameters
    ----------
    n : float, array_like or Parameter
        The index of refraction, not negative.
    k : float, array_like or Parameter, optional
        The extinction coefficient, not negative; k > 0 absorbs.

    Examples
    --------
    >>> Material(0.608, 2.12)
    Material(n=0.608, k=2.12)
    """

    n: Any
    k: Any = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", read_only(self.n))
        object.__setattr__(self, "k", read_only(self.k))

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]
