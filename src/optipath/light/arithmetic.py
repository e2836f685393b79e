"""Light that adds up and is dimmed: sums of lights, and light times a number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn, Self

import numpy as np

from optipath.errors import LightError, shown
from optipath.light.array_axes import ArrayAxes
from optipath.light.array_of_light import ArrayOfLight
from optipath.light.frames_on_demand import FramesOnDemand
from optipath.light.inherited_noise import inheriting
from optipath.light.refused_products import why_refused
from optipath.light.underflow import (
    folded,
    normalise_exponent,
    rounded_to,
    times_two_to,
)
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.jax_values import is_traced, known, namespace
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.precision import at_least_single, coarser

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.light.frames import Frame

_CURE = "light adds up, light + light, and is taken times numbers >= 0, 0.5 * light, light / 2"


class Arithmetic(FramesOnDemand, ArrayOfLight):
    """What can be computed with light: incoherent sums, and multiples that are no negative."""

    frame: Frame

    def __add__(self, other: object) -> Self:
        """Return both lights together, incoherently, in the frame of this one.

        Lights whose wavelengths are known to differ are refused.
        """
        if not isinstance(other, Arithmetic):
            self._refuse(f"{shown(other)} is no light to be added")
        check_broadcast({"light": self.shape, "other light": other.shape})
        # Frames that are known to be one need not be made.
        is_one = other._kept_frame("frame") is self._kept_frame("frame")
        aligned = other if is_one else other.in_frame(self.frame)
        if is_traced(self.mantissa) or is_traced(aligned.mantissa):
            one, two = at_least_single(self.stokes), at_least_single(aligned.stokes)
            total = (one + two).astype(coarser(one, two))
            return self._like(total, other=aligned)
        one, two = at_least_single(self._numbers), at_least_single(aligned._numbers)
        # Dark light has no exponent of its own.
        mine = np.where(one[..., 0] == 0.0, aligned.exponent, self.exponent)
        theirs = np.where(two[..., 0] == 0.0, self.exponent, aligned.exponent)
        power = np.maximum(mine, theirs)
        with np.errstate(over="ignore", invalid="ignore"):
            total = times_two_to(one, self.exponent - power)
            total = total + times_two_to(two, aligned.exponent - power)
        total, power = rounded_to(coarser(one, two), total, power)
        return self._like(total, power, inheriting((self, aligned)), aligned)

    def __radd__(self, other: object) -> Self:
        """Begin a sum: 0 and light is light, so that ``sum(lights)`` has one."""
        if not (isinstance(other, (int, float)) and other == 0):
            self._refuse(f"{shown(other)} is no light to be added")
        return self

    def __mul__(self, factor: Any) -> Self:
        """Return the light times a number, or times numbers that broadcast over the batch."""
        return self._times(factor, np.multiply)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Any) -> Self:
        """Return the light divided by a number, or by numbers that broadcast over the batch."""
        return self._times(divisor, np.divide)

    def _times(self, factor: Any, done: Callable[[Any, Any], Any]) -> Self:
        multiplied = done is np.multiply
        factor = self._factor(factor, dark=multiplied)
        batch = check_broadcast({"light": self.shape, "factor": factor.shape})
        if is_traced(self.mantissa) or is_traced(factor):
            factor, stokes = factor[..., np.newaxis], at_least_single(self.stokes)
            product = stokes * factor if multiplied else stokes / factor
            return self._like(product.astype(coarser(product, stokes)))
        # The power of two is the exponent's, so that no factor costs digits.
        share, power = np.frexp(factor)
        stokes, exponent = normalise_exponent(at_least_single(self._numbers), self.exponent)
        stokes = done(stokes, share[..., np.newaxis]).astype(stokes.dtype, copy=False)
        share, power = (share, power) if multiplied else (1.0 / share, -power)
        stokes, exponent = folded(stokes, np.broadcast_to(exponent + power, batch))
        return self._like(stokes, exponent, self._inherited(share, power))

    def _factor(self, factor: Any, *, dark: bool) -> Any:
        """Return an array of finite numbers above 0, or of 0 where that makes light dark."""
        if isinstance(factor, ArrayOfLight):
            self._refuse("light times light has no meaning")
        if hasattr(factor, "mueller") or isinstance(factor, ArrayAxes):
            raise LightError(
                f"{shown(factor)} is what light meets; write element @ light, matrix @ light or "
                f"path.mueller() @ light"
            )
        if is_traced(factor):
            array = factor
        else:
            array = as_given("a factor of light", known(factor), LightError)
        if array.dtype.kind not in "biuf":
            self._refuse(f"{shown(factor)} is no real number")
        allowed = (array >= 0.0 if dark else array > 0.0) & (array < np.inf)
        if is_traced(array):
            # A product, since a choice would have slopes of 0.
            array = array * namespace(array).where(allowed, 1.0, np.nan)
        elif not np.all(allowed):
            bad = array[~allowed].ravel()[0]
            self._refuse(f"light has no {bad!s}-fold" if dark else f"{bad!s} divides none")
        return array if array.dtype.kind == "f" else array.astype(np.float64)

    def __matmul__(self, other: object) -> NoReturn:
        """Refuse: what light meets stands before it."""
        raise LightError("what light meets stands before it; write element @ light")

    def __rmatmul__(self, other: object) -> NoReturn:
        """Refuse a matrix without frames, a path, a class."""
        raise LightError(why_refused(other))

    def _refuse(self, problem: str) -> NoReturn:
        raise LightError(f"{problem}; {_CURE}; for other sums take light.stokes")

    def _refused(self, *_: object) -> NoReturn:
        """Refuse what would be no light."""
        self._refuse("differences, powers and divisors of light are no light")

    __sub__ = __rsub__ = __neg__ = __pow__ = __rtruediv__ = _refused

    def in_frame(self, frame: Frame) -> Self:
        """Return the same light in another frame."""
        raise NotImplementedError

    def _inherited(
        self, factor: Any = 1.0, power: Any = 0, part: Any = None
    ) -> tuple[Any, ...] | None:
        """Return what light that is made of this one has of its noise."""
        if is_traced(self.mantissa):
            return None
        return inheriting((self,), factor, power, part=part)

    def _like(self, mantissa: Any, exponent: Any = 0, noise: Any = None, other: Any = None) -> Self:
        """Return light of other numbers in the frame of this one, with the other one in it."""
        raise NotImplementedError
