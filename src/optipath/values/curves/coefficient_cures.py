"""What coefficients that are parameters have to do with what a curve comes to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.values.arrays.jax_values import is_traced
from optipath.values.arrays.shapes import place_text
from optipath.values.fit_hints import IN_A_FIT
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.resolved import Resolved


def coefficient_faults(value: Any, known: Mapping[str, Resolved]) -> list[str]:
    """Say which coefficients of a curve do not fit to each other, whatever the wavelength."""
    faults = value.curve.misfits(value.given_by[1:], known)
    return [f"{fault}{_hint(value, known)}" for fault in faults]


def other_numbers(value: Any, bad: Any, known: Mapping[str, Resolved]) -> tuple[str, str]:
    """Return where a curve comes to what is not allowed, and what else to give."""
    told = []
    for place, one in enumerate(value.given_by[1:], 1):
        if isinstance(one, Parameter) and not is_traced(number := value.argument(place, known)):
            first = np.broadcast_to(number, bad.shape)[bad].ravel()[0]
            told.append(f"{one.formula} is {first:.6g}")
    if not told:
        return "", "give another wavelength"
    at = place_text(bad.shape, int(np.argmax(bad)))
    where = f" ({at.strip()}, of {bad.size} paths)" if bad.size > 1 else ""
    cure = f"give other coefficients ({', '.join(told)}), or another wavelength"
    return where, f"{cure}{_hint(value, known)}"


def _hint(value: Any, known: Mapping[str, Resolved]) -> str:
    """Return the hint for a fit, where each coefficient is one number, and one is given."""
    open_ones = [
        value.argument(place, known)
        for place, one in enumerate(value.given_by[1:], 1)
        if isinstance(one, Parameter) and not one.bound
    ]
    return IN_A_FIT * (bool(open_ones) and all(np.size(number) == 1 for number in open_ones))
