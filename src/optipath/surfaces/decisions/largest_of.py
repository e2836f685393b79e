"""Whether the largest of noisy numbers is below a limit, above it, or not known."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

_SURE = 3.0
"""How many standard errors a number must be away from the limit."""


class LargestOf(NamedTuple):
    """The largest of noisy numbers, and within what it is.

    Attributes
    ----------
    value, error : float
        Of the largest, as it was found; it is too large, as the largest of noisy numbers is.
    least, most : float
        Within what the largest is: that of all numbers less three standard errors, and that of
        all plus three; infinite where an error is not known.
    """

    value: float
    error: float
    least: float
    most: float

    @classmethod
    def of(cls, values: npt.ArrayLike, errors: npt.ArrayLike) -> Self:
        """Return the largest size among some numbers.

        Parameters
        ----------
        values, errors : array_like, shape (...)
            The numbers, and their standard errors; NaN where these are not known.

        Returns
        -------
        LargestOf
            NaN, and not known at all, where there are no numbers.

        Examples
        --------
        >>> found = LargestOf.of([0.01, -0.05], [0.001, 0.005])
        >>> print(round(found.value, 3), found.is_below(0.07), found.is_above(0.03))
        0.05 True True
        """
        sizes, known = np.abs(np.ravel(values)), np.ravel(errors)
        if not sizes.size:
            return cls(np.nan, np.nan, 0.0, np.inf)
        far = np.where(np.isnan(known), np.inf, _SURE * known)
        at = int(np.argmax(sizes))
        least, most = float((sizes - far).max()), float((sizes + far).max())
        return cls(float(sizes[at]), float(known[at]), max(least, 0.0), most)

    def is_below(self, limit: float) -> bool:
        """Tell whether none is above a limit, as far as three standard errors tell."""
        return self.most <= limit

    def is_above(self, limit: float) -> bool:
        """Tell whether one is above a limit, as far as three standard errors tell."""
        return self.least > limit

    def __str__(self) -> str:
        least, most = 100.0 * self.least, 100.0 * self.most
        return f"{least:.3g} .. {most:.3g} %" if most < np.inf else f"{least:.3g} % or more"
