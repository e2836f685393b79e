"""Wavelengths in equal steps, such as 380 to 700 nm by 40."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.displayed import displayed
from optipath.values.domains.domain import Domain
from optipath.values.spectra.spectral_values import one_number, one_wavelength

_STEP = Domain("step of wavelengths", "length", minimum=1e-18)
_MOST = 10_000_000
_ROUNDING = 1e-9


def wavelengths(low: Any, high: Any, step: Any) -> np.ndarray[Any, Any]:
    """Return wavelengths in equal steps, both ends included.

    Each is the very number that its text stands for, ``"420 nm"``.

    Parameters
    ----------
    low, high : float or str
        The ends, in metres or as texts such as ``"380 nm"``.
    step : float or str
        In metres or as a text; the range is a whole number of steps.

    Returns
    -------
    ndarray, shape (n,)
        In metres, rising.

    Raises
    ------
    ValueFault
        If these are no lengths, or the steps do not fit.

    Examples
    --------
    >>> (wavelengths("380 nm", "700 nm", "40 nm") * 1e9).round().astype(int)
    array([380, 420, 460, 500, 540, 580, 620, 660, 700])
    """
    start, stop = one_wavelength("low", low), one_wavelength("high", high)
    along = one_number("step", step, _STEP)
    given = f"{displayed(start, 'nm')} .. {displayed(stop, 'nm')}"
    if not start < stop:
        raise ValueFault(
            f"wavelengths {given} do not rise; give the lower end first, and turn what comes of "
            f"it, [::-1]"
        )
    steps = (stop - start) / along
    count = round(steps)
    if count > _MOST:
        raise ValueFault(f"wavelengths {given} are {count:.3g} steps; give a larger step")
    if count < 1 or abs(steps - count) > _ROUNDING * max(1, count):
        nearest = displayed(start + max(1, int(steps)) * along, "nm")
        raise ValueFault(
            f"wavelengths {given} are {steps:.6g} steps of {displayed(along, 'nm')}; give a whole "
            f"number of steps, as up to {nearest}"
        )
    first, each = Decimal(repr(start)), Decimal(repr(along))
    found = [float(first + place * each) for place in range(count)]
    return np.array([*found, stop])
