"""Wavelengths of light, found when somebody asks for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import LightError, ShapeError
from optipath.light.arithmetic import Arithmetic
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.read_only import locked
from optipath.values.displayed import displayed
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.values.roundings import Array

_ROUNDING = 2.0 * float(np.finfo(np.float32).eps)
"""By how much, as a share, wavelengths differ that are one, given in single precision."""


class WavelengthOnDemand(Arithmetic):
    """What has wavelengths that broadcast over its batch, or what returns them, or none."""

    @property
    def wavelength(self) -> Array | None:
        """The wavelengths in vacuum, in metres; None of light that is of no known ones.

        They broadcast to the shape of the light. Those of a run that was given its
        `Wavelength`, or was bound to it. An index takes its part of them; a sum has those
        that both lights have; lights of different wavelengths are not added, and with light
        of no known ones a sum has none.

        Examples
        --------
        >>> from optipath import Light
        >>> light = Light([[1.0, 0.0, 0.0, 0.0]] * 2, wavelength=["500 nm", "600 nm"])
        >>> light.wavelength, light[1].wavelength
        (array([5.e-07, 6.e-07]), array(6.e-07))
        """
        own = self.__dict__
        kept = own.get("_wavelength")
        if callable(kept):
            found = kept()
            if found is None:
                return None  # What is kept says which ones are in doubt.
            own["_wavelength"] = kept = found
        return kept

    @property
    def kept_wavelength(self) -> Any:
        """The wavelengths as they are kept, which nobody has to find for it."""
        return self.__dict__.get("_wavelength")

    @property
    def wavelengths_in_doubt(self) -> tuple[str, ...]:
        """The parameters of a run of which any may be the wavelength of the light."""
        return getattr(self.kept_wavelength, "in_doubt", ())

    def origin(self, wavelength: Any = ...) -> dict[str, Any]:
        """Return what light that is made of this one has of it, by the names of `Light.of`."""
        kept = self.kept_wavelength if wavelength is ... else wavelength
        return {"measured": self.is_measured, "wavelength": kept}

    def _wavelength_with(self, other: WavelengthOnDemand | None) -> Any:
        """Return what light has that is made of this, and of another one if there is one."""
        mine = self.kept_wavelength
        if other is None or mine is None or mine is other.kept_wavelength:
            return mine
        # Found now, lest sums of many lights keep what finds those of each.
        one, two = self.wavelength, other.wavelength
        if one is None or two is None or is_traced(one) or is_traced(two):
            return None
        if (apart := np.abs(one - two) > _ROUNDING * one).any():
            pair = [displayed(np.broadcast_to(w, apart.shape)[apart][0], "nm") for w in (one, two)]
            raise LightError(
                f"lights of different wavelengths, {pair[0]} and {pair[1]}, have no sum; "
                f"add light.integrate() of each, or, of powers, op.Light(light.stokes, light.frame)"
            )
        return self.wavelength

    def _part_of_wavelength(self, change: Callable[[Any], Any]) -> Any:
        """Return what returns the wavelengths of a part of the batch; None where there are none."""
        kept, batch = self.kept_wavelength, self.shape
        if kept is None or self.wavelengths_in_doubt:
            return kept

        def part() -> Any:
            found = kept() if callable(kept) else kept
            if found is None:
                return None
            xp = namespace(found)
            found = change(xp.broadcast_to(found, batch))
            return namespace(found).asarray(found)

        return part


def wavelengths_for(batch: tuple[int, ...], given: Any) -> Array:
    """Return wavelengths that somebody gives for light.

    Units: given, the result in metres.

    Examples
    --------
    >>> wavelengths_for((2,), ["500 nm", "2.4 eV"]).round(9)
    array([5.00e-07, 5.17e-07])
    """
    found = Wavelength().resolve(given).value
    shape = tuple(found.shape)
    if len(shape) > len(batch) or any(
        own not in (1, whole) for own, whole in zip(shape[::-1], batch[::-1], strict=False)
    ):
        raise ShapeError(
            f"wavelengths of shape {shape} do not fit light of shape {batch}; give one for each "
            f"light, or an array that broadcasts to them, such as wavelengths[:, None]"
        )
    wavelengths: Array = found if is_traced(found) else locked(np.array(found, np.float64))
    return wavelengths
