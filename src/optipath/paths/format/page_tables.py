"""Materials of the database in preset files: ``{ material = "gold" }``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, PresetError
from optipath.paths.format.faults import Faults
from optipath.values.curves.curve_value import CurveValue
from optipath.values.materials import K, Material, N

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from optipath.values.curves.page_curve import PageCurve
    from optipath.values.domains.domain import Domain

NAMED = "material"
"""The key by which such a table is known."""

_TEXTS = ("page", "interpolation", "extrapolate")
_NUMBERS = {"n": N, "k": K}
OF_PAGES = (*_TEXTS, *_NUMBERS)
"""The other keys that it may have; n and k in place of what a page has."""


def material_by_name(
    raw: Mapping[str, Any], wavelength: Any, decode: Callable[[Any, Domain], Any]
) -> dict[str, Any]:
    """Return n and k of a material of the database."""
    faults = Faults()
    numbers: dict[str, Any] = {
        key: faults.attempt(f".{key}", decode, raw[key], of)
        for key, of in _NUMBERS.items()
        if key in raw
    }
    if faults:
        raise PresetError(*faults)
    texts: dict[str, Any] = {key: raw[key] for key in _TEXTS if key in raw}
    found = Material.named(raw[NAMED], wavelength=wavelength, **texts, **numbers)
    return {"n": found.n, "k": found.k}


def page_table(curve: PageCurve) -> dict[str, Any] | None:
    """Return the table of a material by name; None for what is read from a file."""
    if not curve.asked:
        return None
    return {NAMED if key == "name" else key: text for key, text in curve.asked.items()}


def own_part(curve: PageCurve, n: Any, k: Any) -> dict[str, Any]:
    """Return which of n and k a table has to say beside the name of a material."""
    given = {"n": n, "k": k}
    own = {part: given[part] for part in given if part not in curve.parts}
    try:
        usual = Material.named(**curve.asked)
    except OptipathError:
        return own  # Without them, it is no material.
    same = isinstance(usual.n, CurveValue) and usual.n.curve.span == curve.span
    return {} if same and own == {"k": 0.0} == {"k": usual.k} else own


def is_usual_part(curve: PageCurve, part: str) -> bool:
    """Tell whether a name by itself gives a curve, with no other part beside it.

    The index of a page without k reaches further, or is had at all, where a k is given.
    """
    try:
        usual = getattr(Material.named(**curve.asked), part)
    except OptipathError:
        return False
    return isinstance(usual, CurveValue) and usual.curve == curve
