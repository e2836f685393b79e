"""The check of numbers that follow from the wavelength, in the words of who gives that."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ValueFault
from optipath.values.arrays.jax_values import is_traced
from optipath.values.curves.coefficient_cures import coefficient_faults, other_numbers
from optipath.values.domains.wavelengths import WAVELENGTH
from optipath.values.parameters import Parameter
from optipath.values.units import format_quantity

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.values.domains.domain import Domain
    from optipath.values.resolved import Resolved


def check_computed(
    value: Any,
    owner: str,
    domain: Domain,
    numbers: Any,
    given: Mapping[str, Resolved] | None = None,
) -> None:
    """Check what a curve comes to where it stands."""
    placed = value.placed(numbers)
    try:
        domain.check(owner, placed)
    except ValueFault as fault:
        if is_traced(placed) or domain.tail:
            raise
        bad = ~np.asarray(domain.allows(np.asarray(placed)))
        if not np.any(bad):
            raise
        found = float(np.asarray(placed)[bad].ravel()[0])
        known = {**_defaults(value, given or {}), **(given or {})}
        if faults := coefficient_faults(value, known):
            raise ValueFault(*faults) from fault
        at = _wavelength_text(value, bad, known)
        place, cure = other_numbers(value, bad, known)
        what = f"{value.formula_of(value.spoken)}{at}"
        is_what = f"is {found:.6g}" if np.isfinite(found) else "has no value"
        wanted = f", and {owner} takes {domain.described()}" if owner else ""
        if takes_0_alone(domain):
            raise ValueFault(f"{what} {is_what}{wanted}") from fault
        reason = value.curve.unreal_of(value.place)
        why = f" ({reason})" if reason else ""
        raise ValueFault(f"{what} {is_what}{place}{why}{wanted}; {cure}") from fault


def takes_0_alone(domain: Domain) -> bool:
    """Tell whether a domain says itself what to do about any other number."""
    return domain.interval == (0.0, 0.0)


def _defaults(value: Any, given: Mapping[str, Resolved]) -> dict[str, Resolved]:
    return {
        p.name: p.resolve(p.default)
        for p in value.arguments
        if p.name not in given and p.default is not None
    }


def _wavelength_text(value: Any, bad: Any, known: Mapping[str, Resolved]) -> str:
    """Return the first wavelength at which a value is not allowed, as a sentence goes on."""
    wavelength = value.given_by[0]
    if isinstance(wavelength, Parameter) and wavelength.name not in known:
        return ""
    number = value.argument(0, known)
    if is_traced(number):
        return ""
    first = np.broadcast_to(number, bad.shape)[bad].ravel()[0]
    return f" at {format_quantity(float(f'{first:.10g}'), WAVELENGTH.unit)}"
