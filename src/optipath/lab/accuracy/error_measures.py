"""Errors against references: componentwise in ulp, and normwise, each over its condition."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.lab.accuracy.many_digits import WORKING_DIGITS, exactly, mpmath

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy.typing as npt

LIMIT = 1000.0
"""A method fails where it is off by more than this: three digits lost that the problem has."""


class Errors(NamedTuple):
    """The errors of four numbers, one row a sample; A, B, C, S or S0, S1, S2, S3.

    Shapes: componentwise (samples, 4); normwise (samples,). Units: componentwise, normwise in ulp.
    """

    componentwise: npt.NDArray[np.float64]
    normwise: npt.NDArray[np.float64]


def errors(
    found: npt.NDArray[Any], exact: Iterable[Any], dtype: str, *, against_first: bool = False
) -> Errors:
    """Return the errors of computed numbers.

    Shape: found (samples, 4). Units: against_first in ulp.

    Examples
    --------
    >>> off = errors(np.array([[1.0 + 2e-16, 0, 0, 0]]), [((1, 0, 0, 0), (0, 0, 0, 0))], "float64")
    >>> off.componentwise[0], off.normwise
    (array([1., 0., 0., 0.]), array([1.]))
    """
    componentwise, normwise = np.zeros(found.shape), np.zeros(len(found))
    with mpmath.workdps(WORKING_DIGITS):
        for row, (numbers, (values, conditions)) in enumerate(zip(found, exact, strict=True)):
            off = [_distance(x, value) for x, value in zip(numbers, values, strict=True)]
            size = abs(values[0])
            instead = size if against_first else 0
            componentwise[row] = [
                in_ulp(d, value or instead, dtype) / (1.0 + condition)
                for d, value, condition in zip(off, values, conditions, strict=True)
            ]
            shares = [abs(v) * c for v, c in zip(values, conditions, strict=True)]
            most = float(max(shares) / size) if size else 0.0
            normwise[row] = in_ulp(max(off), size, dtype) / (1.0 + most)
    return Errors(componentwise, normwise)


def _distance(number: Any, value: Any) -> Any:
    return abs(exactly(number) - value) if np.isfinite(number) else mpmath.inf


def in_ulp(distance: Any, value: Any, dtype: str) -> float:
    """Return a distance in units in the last place of a value."""
    if not distance:
        return 0.0
    kind = np.finfo(dtype)
    binade = int(mpmath.frexp(value)[1]) - 1 if value else kind.minexp
    return float(distance / mpmath.ldexp(1, max(binade, kind.minexp) - kind.nmant))
