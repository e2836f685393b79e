"""Materials that are not known before the path runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import listed
from optipath.values.curves.computed_values import parameters_among
from optipath.values.curves.curve_value import CurveValue
from optipath.values.materials import Material

if TYPE_CHECKING:
    from collections.abc import Sequence


def waits_for(given: Any) -> Sequence[str]:
    """Return the names of the parameters that a material depends on; none for anything else.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> waits_for(Material(1.5, Parameter("k"))), waits_for(Material(1.5))
    (['k'], [])
    """
    if not isinstance(given, Material):
        return []
    found = parameters_among([given.n, given.k])
    return [*dict.fromkeys(p.name for p in found if not isinstance(p, CurveValue))]


def given_too_late(name: str, given: Any) -> str:
    """Return what is said of a material that is given while a path runs; mostly nothing.

    Parameters
    ----------
    name : str
        The parameter that it is given for.
    given : Any
        What is given.

    Returns
    -------
    str
    """
    if not (names := waits_for(given)):
        return ""
    return (
        f"parameter '{name}' is a Material that depends on {listed(names)}, and is put in place "
        f"before a path runs; write path.bind({name}=...), or load_preset(..., {name}=...)"
    )
