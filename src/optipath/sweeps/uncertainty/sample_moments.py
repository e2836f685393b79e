"""Mean, standard deviation and covariance of samples that come in blocks."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from optipath.sweeps.uncertainty.light_figures import STOKES

Array = npt.NDArray[np.float64]


class SampleMoments:
    """Sums of what samples of figures differ by from those at the best estimates.

    One sample is added after the other, so that the sums are the same to the last bit in whatever
    blocks.

    Shape: intensity (...).

    Examples
    --------
    >>> moments = SampleMoments(1e-200)
    >>> moments.add(np.full((2, 10), [[1e-200], [3e-200]]))
    >>> print(moments.mean[0], f"{moments.deviation[0]:.3g}")
    2e-200 1.41e-200
    """

    def __init__(self, intensity: Any) -> None:
        power = np.asarray(np.frexp(intensity)[1])[..., np.newaxis]
        self._scale = np.exp2(np.where(np.arange(10) < STOKES, power, 0))
        self._count = 0
        self._first: Any = 0.0
        self._second: Any = 0.0
        self._crossed: Any = 0.0

    def add(self, apart: Array) -> None:
        """Add a block of samples.

        Shape: apart (samples, ..., 10).
        """
        with np.errstate(all="ignore"):
            scaled = apart / self._scale
            self._first = _added(self._first, scaled)
            self._second = _added(self._second, scaled**2)
            self._crossed = _added(self._crossed, _products(scaled))
        self._count += len(apart)

    @property
    def mean(self) -> Array:
        """Their mean, shape (..., 10)."""
        return np.asarray(self._mean * self._scale)

    @property
    def deviation(self) -> Array:
        """Their standard deviation, shape (..., 10)."""
        with np.errstate(all="ignore"):
            left = np.maximum(self._second - self._count * self._mean**2, 0.0)
            return np.asarray(np.sqrt(left / (self._count - 1)) * self._scale)

    @property
    def covariance(self) -> Array:
        """That of the Stokes vector, shape (..., 4, 4)."""
        with np.errstate(all="ignore"):
            left = self._crossed - self._count * _products(self._mean)
            return np.asarray(left / (self._count - 1) * _products(self._scale))

    @property
    def _mean(self) -> Any:
        return self._first / self._count


def _products(figures: Any) -> Any:
    """Return the products of the components of Stokes vectors with each other."""
    stokes = figures[..., :STOKES]
    return stokes[..., :, np.newaxis] * stokes[..., np.newaxis, :]


def _added(total: Any, more: Any) -> Any:
    """Return a sum with what is added to it, one after the other along the first axis."""
    total = np.broadcast_to(total, more.shape[1:])
    return np.cumsum(np.concatenate([total[np.newaxis], more]), axis=0)[-1]
