"""Whether the largest of noisy numbers is below a limit, above it, or not known."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

_SURE = 3.0
"""How many standard errors one number is taken to be away from what it is, at most."""


class LargestOf(NamedTuple):
    """The largest of noisy numbers, and within what it is."""

    value: float
    error: float
    least: float
    most: float

    @classmethod
    def of(cls, values: npt.ArrayLike, errors: npt.ArrayLike) -> Self:
        """Return the largest size among some numbers.

        Shape: values, errors (...).

        Examples
        --------
        >>> found = LargestOf.of([0.01, -0.05], [0.001, 0.005])
        >>> print(round(found.value, 3), found.is_below(0.07), found.is_above(0.03))
        0.05 True True
        """
        sizes, known = np.abs(np.ravel(values)), np.ravel(errors)
        told = ~np.isnan(sizes)
        if not told.any():
            return cls(np.nan, np.nan, 0.0, np.inf)
        # A pixel that is dark at one of several wavelengths has no ratio there.
        sizes, known = np.where(told, sizes, 0.0), np.where(told, known, np.nan)
        known = np.where(np.isnan(known), np.inf, known)
        at = int(np.argmax(sizes))
        # The tail of the normal distribution beyond k is below exp(-k^2 / 2).
        several = max(int(np.isfinite(known).sum()), 1)
        among = np.sqrt(_SURE * _SURE + 2.0 * np.log(several))
        least = float((sizes - among * known).max())
        most = float((sizes + _SURE * known).max())
        error = float(known[at])
        return cls(float(sizes[at]), error if error < np.inf else np.nan, max(least, 0.0), most)

    def is_below(self, limit: float) -> bool:
        """Tell whether none is above a limit, noise taken in."""
        return self.most <= limit

    def is_above(self, limit: float) -> bool:
        """Tell whether one is above a limit, noise taken in."""
        return self.least > limit

    def __str__(self) -> str:
        least, most = 100.0 * self.least, 100.0 * self.most
        return f"{least:.3g} .. {most:.3g} %" if most < np.inf else f"{least:.3g} % or more"
