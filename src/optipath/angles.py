"""CosSin: an angle given by its cosine and its sine."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.errors import ParameterError
from optipath.jax_values import is_jax, namespace
from optipath.quoting import shown
from optipath.shapes import broadcast_fault

_APART = 1e-6


class CosSin:
    """An angle by its cosine and sine, as scenes in space have it.

    May be given for any angle when a plan runs: next to the normal and at grazing incidence it
    has more digits than the angle, and no sine need be computed.

    Parameters
    ----------
    cos, sin : float or array_like
        They broadcast together.

    Raises
    ------
    ParameterError
        If they do not broadcast, or belong to no angle: cos^2 + sin^2 is not 1.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("npgr026")
    >>> grazing = CosSin(1e-20, 1.0)
    >>> float(100.0 - path.trace(delta=grazing, phi=grazing).intensity) < 1e-12
    True
    """

    __slots__ = ("cos", "sin")

    cos: Any
    sin: Any

    def __init__(self, cos: Any, sin: Any) -> None:
        for name, value in (("cos", cos), ("sin", sin)):
            object.__setattr__(self, name, value if is_jax(value) else _numbers(name, value))
        if faults := broadcast_fault({"cos": np.shape(self.cos), "sin": np.shape(self.sin)}):
            raise ParameterError(*faults)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape that both broadcast to."""
        return np.broadcast_shapes(np.shape(self.cos), np.shape(self.sin))

    @property
    def angle(self) -> Any:
        """The angle in radians."""
        return namespace(self.cos).arctan2(self.sin, self.cos)

    def check(self, what: str) -> None:
        """Raise unless cosine and sine belong to an angle.

        Raises
        ------
        ParameterError
            Naming what they were given for.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            off = np.abs(np.square(self.cos) + np.square(self.sin) - 1.0)
        if not np.all(off <= _APART):
            raise ParameterError(
                f"{what} is given by a cosine and a sine that belong to no angle: "
                f"cos^2 + sin^2 is not 1; divide both by its root"
            )

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a CosSin cannot change; make a new one instead of setting '{name}'")

    def __repr__(self) -> str:
        return f"CosSin({self.cos!r}, {self.sin!r})"


def _numbers(name: str, value: Any) -> Any:
    try:
        array = np.asarray(value)
    except ValueError:
        raise ParameterError(f"{name} has rows of unequal lengths; make it one shape") from None
    if array.dtype.kind not in "iuf":
        raise ParameterError(f"{name} must be real numbers, not {shown(value)}")
    return array if array.dtype.char in "fd" else array.astype(np.float64)
