"""How far the methods are from the reference for one interface, region by region."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.kernels.carriers.structures import BLOCK
from optipath.kernels.catalogue import REFLECTION, TRANSMISSION
from optipath.kernels.numbers.primitives import NUMPY
from optipath.lab.accuracy import reference
from optipath.lab.accuracy.error_measures import Errors, errors
from optipath.lab.accuracy.many_digits import WORKING_DIGITS, exactly, mpmath

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.kernels.carriers.kernel import Kernel
    from optipath.lab.accuracy.regions import Region, Samples

SAMPLES = 200
FAMILIES = {"reflection": REFLECTION, "transmission": TRANSMISSION}
REFERENCES = {"reflection": reference.reflection, "transmission": reference.transmission}


def interface_errors(
    method: str,
    region: Region,
    dtype: str = "float64",
    count: int = SAMPLES,
    what: str = "reflection",
    *,
    against_first: bool = False,
) -> Errors:
    """Return the errors of (A, B, C, S) by a method in a region.

    Examples
    --------
    >>> from optipath.lab.accuracy.regions import REGIONS
    >>> off = interface_errors("stable", REGIONS[0], count=20)
    >>> bool(np.all(off.componentwise <= 10))
    True
    """
    kernel = FAMILIES[what].by_method(method)
    found = matrix_numbers(kernel, region.samples(count, dtype))
    exact = _references(region, dtype, count, what)
    return errors(found, exact, dtype, against_first=against_first)


def matrix_numbers(kernel: Kernel, samples: Samples) -> npt.NDArray[Any]:
    """Return (A, B, C, S) as a kernel computes them.

    Shape: returns (samples, 4).
    """
    outside = np.ones((), samples.n.dtype)
    with np.errstate(all="ignore"):
        numbers = kernel.made_for(NUMPY)(outside, *samples)
        (A, B, _, _), _, (_, _, C, S), _ = BLOCK.rows(NUMPY, numbers)
    return np.stack(np.broadcast_arrays(A, B, C, S), axis=-1)


@lru_cache(maxsize=256)
def _references(region: Region, dtype: str, count: int, what: str) -> tuple[reference.Exact, ...]:
    samples = zip(*region.samples(count, dtype), strict=True)
    with mpmath.workdps(WORKING_DIGITS):
        return tuple(REFERENCES[what](*map(exactly, sample)) for sample in samples)
