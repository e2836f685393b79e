"""How far a method is from the reference, region by region."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.accuracy import reference
from optipath.accuracy.many_digits import mpmath
from optipath.accuracy.regions import REGIONS, Region
from optipath.kernels import BLOCK, NUMPY, REFLECTION, TRANSMISSION

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True)
class Errors:
    """The errors of (A, B, C, S), one row a sample.

    Attributes
    ----------
    componentwise : ndarray, shape (samples, 4)
        In ulp of each component, divided by 1 + its condition number in tan(theta).
    normwise : ndarray, shape (samples,)
        The largest error in units of eps A.
    """

    componentwise: Any
    normwise: Any


def interface_errors(
    method: str, region: Region, dtype: str = "float64", count: int = 200, what: str = "reflection"
) -> Errors:
    """Return the errors of a method in a region."""
    family = {"reflection": REFLECTION, "transmission": TRANSMISSION}[what]
    found = matrix_numbers(family.by_method(method), region, dtype, count)
    exact = _references(region, dtype, count, what)
    return errors(found, exact, dtype)


def matrix_numbers(kernel: Any, region: Region, dtype: str, count: int) -> npt.NDArray[Any]:
    """Return (A, B, C, S), shape (samples, 4), as a kernel computes them."""
    n, k, c, s = region.samples(count, dtype)
    with np.errstate(all="ignore"):
        one = np.ones((), dtype)
        (A, B, _, _), _, (_, _, C, S), _ = BLOCK.rows(
            NUMPY, kernel.made_for(NUMPY)(one, n, k, c, s)
        )
    return np.stack(np.broadcast_arrays(A, B, C, S), axis=-1)


@lru_cache(maxsize=256)
def _references(region: Region, dtype: str, count: int, what: str) -> tuple[reference.Exact, ...]:
    function = {"reflection": reference.reflection, "transmission": reference.transmission}[what]
    samples = zip(*region.samples(count, dtype), strict=True)
    return tuple(function(*map(exactly, sample)) for sample in samples)


def exactly(number: Any) -> Any:
    """Return a float of any precision as a number of many digits."""
    mantissa, exponent = np.frexp(number)
    high = float(mantissa)
    rest = float(mantissa - type(mantissa)(high))
    return mpmath.ldexp(mpmath.mpf(high) + mpmath.mpf(rest), int(exponent))


def errors(found: npt.NDArray[Any], exact: Any, dtype: str) -> Errors:
    """Return the errors of numbers against references."""
    eps = float(np.finfo(dtype).eps)
    componentwise, normwise = np.zeros(found.shape), np.zeros(len(found))
    for row, (numbers, (values, conditions)) in enumerate(zip(found, exact, strict=True)):
        off = [_distance(x, value) for x, value in zip(numbers, values, strict=True)]
        componentwise[row] = [
            _in_ulp(d, value, dtype) / (1.0 + condition)
            for d, value, condition in zip(off, values, conditions, strict=True)
        ]
        normwise[row] = float(max(off) / abs(values[0])) / eps if values[0] else float(max(off) > 0)
    return Errors(componentwise, normwise)


def _distance(number: Any, value: Any) -> Any:
    return abs(exactly(number) - value) if np.isfinite(number) else mpmath.inf


def _in_ulp(distance: Any, value: Any, dtype: str) -> float:
    if not distance:
        return 0.0
    about = np.dtype(dtype).type(mpmath.nstr(abs(value), 25))
    return float(distance / exactly(np.spacing(about)))
