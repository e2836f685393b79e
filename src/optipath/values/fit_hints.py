"""What a fit needs where it has stepped to a number that is not allowed."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError
from optipath.values.arrays.array_likes import as_given
from optipath.values.roundings import doubles

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from optipath.values.domains.domain import Domain


IN_A_FIT = " (in a fit, give the optimiser bounds=)"


def with_bounds_hint(
    faults: Iterable[str], value: Any, limits: tuple[float, float], domains: Sequence[Domain]
) -> list[str]:
    """Return sentences on a value; where it is one number beyond its limits, with `bounds=`.

    Examples
    --------
    >>> with_bounds_hint(["k is -0.1; give 0 or more"], -0.1, (0.0, 9.0), [])
    ['k is -0.1; give 0 or more (in a fit, give the optimiser bounds=)']
    """
    if not _is_one_beyond(value, limits, domains):
        return [*faults]
    return [f"{fault}{IN_A_FIT}" for fault in faults]


def _is_one_beyond(value: Any, limits: tuple[float, float], domains: Sequence[Domain]) -> bool:
    try:
        array = as_given("", value)
    except OptipathError:
        return False
    if array.size != 1 or array.dtype.kind not in "iufc" or not np.all(np.isfinite(array)):
        return False
    if array.dtype.kind == "c":
        return any(domain.complex_parts and not np.all(domain.allows(array)) for domain in domains)
    # So large an angle is in degrees.
    if any(domain.dimension == "angle" for domain in domains) and np.all(np.abs(array) > 2.0 * pi):
        return False
    array = doubles(array, limits)
    return not np.all((limits[0] <= array) & (array <= limits[1]))
