"""Noise of Mueller matrices and their products: which entries are no more than rounding."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

from optipath.light.frames_on_demand import FramesOnDemand
from optipath.light.inherited_noise import rounding
from optipath.values.arrays.jax_values import known, namespace
from optipath.values.arrays.read_only import locked

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.roundings import Array

_SUMS = 4.0
"""How many roundings a sum of four products has, and the turn of frames before it."""


class KnownNoise(FramesOnDemand):
    """What a matrix knows of its origin: its noise, and whether its numbers were given."""

    matrix: Any

    of: ClassVar[Callable[..., Any]]

    @property
    def noise(self) -> Array:
        """Which entries of `matrix` are no more than rounding: those below it, shape (...).

        The rounding of M00; of a product, and of the matrix of a path, what is left of the
        roundings of all factors: of crossed polarisers it is larger than M00.

        Examples
        --------
        >>> from optipath import Mueller
        >>> print(Mueller(np.eye(4)).noise)
        2.220446049250313e-16
        """
        own = self.__dict__
        if callable(own.get("_noise")):
            own["_noise"] = own["_noise"](self.matrix)
        if "_floor" not in own:
            least = rounding(known(self.matrix)[..., 0, :])
            own["_floor"] = locked(namespace(least).maximum(least, own.get("_noise", 0.0)))
        return own["_floor"]  # type: ignore[no-any-return]

    def with_noise(self, noise: Array | Callable[[Any], Any], *, given: bool = False) -> Self:
        """Return the same matrix, of which more is noise than its own rounding.

        Parameters
        ----------
        noise : ndarray of shape (...), or callable
            The noise, or what returns it for the matrix when somebody asks.
        given : bool, optional
            Whether it `is_given`.

        Returns
        -------
        Mueller
        """
        frames = self._kept_frame("frame_in"), self._kept_frame("frame_out")
        found: Self = self.of(self.matrix, *frames)
        vars(found).update(_noise=noise, _given=given)
        return found

    @property
    def is_given(self) -> bool:
        """Whether its numbers, or some of its factors', come from outside, as measured ones do."""
        return bool(vars(self).get("_given", False))

    def __getstate__(self) -> dict[str, Any]:
        # What computes the noise stays here.
        return {**super().__getstate__(), "_noise": self.noise}


def noise_of_product(behind: tuple[Any, Any], before: tuple[Any, Any]) -> Any:
    """Return the noise in what two matrices make together, shape (...), by running error analysis.

    The noise of each times the other, and the roundings of sums of products of both.

    Examples
    --------
    >>> one = np.eye(4), 2.0**-52
    >>> print(noise_of_product(one, one) * 2.0**52)
    6.0
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        one, two = _size(*behind), _size(*before)
        both = one * two
        eps = float(namespace(both).finfo(both.dtype).eps)
        return one * before[1] + behind[1] * two + _SUMS * eps * both


def _size(matrix: Any, noise: Any) -> Any:
    """Return M00, which no entry exceeds, or the noise where that is more."""
    return namespace(matrix).maximum(abs(known(matrix)[..., 0, 0]), noise)
