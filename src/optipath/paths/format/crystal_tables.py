"""Tables of crystals whose data are published: ``birefringence = { crystal = "quartz" }``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import PresetError
from optipath.values.crystals import CRYSTALS, Crystal
from optipath.values.domains.indices import IndexDomain, OutsideDomain

if TYPE_CHECKING:
    from optipath.values.curves.curve import Curve
    from optipath.values.domains.domain import Domain

CRYSTAL = "crystal"
"""The key by which such a table is known."""

_QUANTITIES = {"": "birefringence", "angle per length": "rotatory_power"}
"""What a crystal gives for a dimension."""


def number_of_crystal(raw: str, domain: Domain, wavelength: Any) -> Any:
    """Return what a crystal gives where one number stands.

    Examples
    --------
    >>> from optipath.values.domains.domain import Domain
    >>> round(number_of_crystal("quartz", Domain("birefringence"), 5.893e-7), 5)
    0.0091
    """
    crystal = Crystal.named(raw, wavelength)
    of_index = isinstance(domain, (IndexDomain, OutsideDomain))
    asked = "" if of_index else _QUANTITIES.get(domain.dimension, "")
    found = getattr(crystal, asked, None)
    if found is None:
        raise PresetError(
            f"{crystal.label} gives no {domain.name}; it stands for a birefringence, and quartz "
            f"for a rotatory power"
        )
    return found


def crystal_of(curve: Curve) -> str:
    """Return the name of the crystal that a curve is of; ``""`` for any other.

    Examples
    --------
    >>> crystal_of(Crystal.named("calcite").birefringence.curve)
    'calcite'
    """
    for name in CRYSTALS:
        crystal = Crystal.named(name)
        for quantity in _QUANTITIES.values():
            if getattr(getattr(crystal, quantity), "curve", None) == curve:
                return name
    return ""
