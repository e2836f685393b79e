"""The worst cases of the methods, searched for: from what is bad already to what is worse."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.kernels.catalogue import REFLECTION
from optipath.kernels.numbers.double_double import DoubleDouble
from optipath.kernels.numbers.primitives import NUMPY
from optipath.kernels.numbers.twice import twice
from optipath.lab.accuracy.error_measures import errors, in_ulp
from optipath.lab.accuracy.interface_errors import FAMILIES, REFERENCES, matrix_numbers
from optipath.lab.accuracy.many_digits import WORKING_DIGITS, exactly, mpmath

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.kernels.carriers.kernel import Kernel, KernelFamily
    from optipath.lab.accuracy.regions import Region, Samples

    Floats = npt.NDArray[np.floating]

COMPONENTS = ("A", "B", "C", "S", "C near 0")
"""What is searched: the four numbers, C but where its zero is double, and C there."""

_CHILDREN, _KEPT = 1000, 100
_STEP = 2.0**-60
"""By how much of it a tangent is moved to find a condition."""


class WorstCase(NamedTuple):
    """The worst case that was found.

    Attributes
    ----------
    error : float
        In ulp*; of "C near 0", in ulp of A. 0 where there is no such case.
    n, k, cos, sin : float
        The boundary and the angle.
    """

    error: float
    n: float
    k: float
    cos: float
    sin: float


def worst(
    method: str,
    region: Region,
    component: str,
    what: str = "reflection",
    dtype: str = "float64",
    *,
    generations: int = 100,
    seed: int = 0,
) -> WorstCase:
    """Return the worst case of a method in a region, as far as a search finds it.

    The numbers of which a region makes its samples are changed by steps of all sizes; the worst
    samples have the next generation. While it climbs, the truth comes from the same formulas in
    more digits; the error of what is found is measured against 50 digits.

    Parameters
    ----------
    method : str
        One of the methods.
    region : Region
        Where is searched.
    component : str
        One of `COMPONENTS`.
    what : {"reflection", "transmission"}, optional
        Which Mueller matrix.
    dtype : str, optional
        The precision.
    generations : int, optional
        How often a thousand samples are tried.
    seed : int, optional
        Another one finds other cases.

    Returns
    -------
    WorstCase

    Examples
    --------
    >>> from optipath.lab.accuracy.regions import REGIONS
    >>> worst("stable", REGIONS[0], "A", generations=5).error < 16.0
    True
    """
    rng = np.random.default_rng(seed)
    family = FAMILIES[what]
    kernel = family.by_method(method)
    # Twice the precision tells nothing of numbers that are computed with twice the precision.
    kind = np.longdouble if method == "compensated" else np.float64
    units: Floats = rng.random((region.dimensions, _CHILDREN))
    kept, known = units[:, :0], np.empty(0)
    for _ in range(generations):
        samples = region.at(units, dtype)
        scores = _scores(component, matrix_numbers(kernel, samples), samples, family, kind)
        known, kept = np.append(known, scores), np.append(kept, units, axis=1)
        best = np.argsort(-known)[:_KEPT]
        known, kept = known[best], kept[:, best]
        units = _children(rng, kept)
    return _measured(kernel, region.at(kept[:, :1], dtype), component, what, dtype)


def _children(rng: np.random.Generator, parents: Floats) -> Floats:
    """Return what comes of some coordinates changed a little, and some that are new."""
    shape = len(parents), _CHILDREN
    steps = rng.normal(size=shape) * 10.0 ** rng.uniform(-17.0, -0.5, _CHILDREN)
    changed = rng.random(shape) < rng.choice([0.35, 0.7, 1.0], _CHILDREN)
    children = parents[:, rng.integers(0, parents.shape[1], _CHILDREN)] + steps * changed
    fresh = rng.random(_CHILDREN) < 0.05
    # What leaves the unit cube is mirrored back.
    inside = np.abs((children + 1.0) % 2.0 - 1.0)
    return np.where(fresh, rng.random(shape), inside)


def _scores(
    component: str, found: Floats, samples: Samples, family: KernelFamily, kind: Any
) -> Floats:
    """Return the errors of computed numbers against the stable formulas in more digits."""
    place = "ABCS".index(component[0])
    with np.errstate(all="ignore"):
        numbers = [part.astype(kind) for part in samples]
        values, moved = (_doubled(family, numbers, step) for step in (0.0, _STEP))
        exact, A = values[place], values[0].high
        condition = np.abs((moved[place] - exact).high / exact.high) / _STEP
        condition = np.where((samples.cos > 0.0) & (samples.sin > 0.0), condition, 0.0)
        off = np.abs((found[:, place] - exact.high) - exact.low)
        has_zeros = component[0] == "C" and family is REFLECTION
        near = is_near_double_zero(A, exact.high, condition) & has_zeros
        unit = A if component == "C near 0" else exact.high
        score = off / _ulp(unit, found.dtype)
        if component != "C near 0":
            score, near = score / (1.0 + condition), ~near
    return np.where(np.isfinite(score) & near & (exact.high != 0.0), score, 0.0).astype(float)


def is_near_double_zero(A: Any, C: Any, condition: Any) -> Any:
    """Tell whether C is small at an angle that hardly moves it.

    Parameters
    ----------
    A, C : mpf or array
        Of the Mueller matrix.
    condition : float or array
        The condition number of C.

    Returns
    -------
    bool or array of bool
    """
    return abs(C) * (1.0 + condition) < 0.5 * A


def _ulp(number: Floats, dtype: Any) -> Floats:
    kind = np.finfo(dtype)
    exponent = np.maximum(np.frexp(number)[1] - 1, kind.minexp)
    return np.asarray(np.ldexp(np.ones((), number.dtype), exponent - kind.nmant))


def _doubled(family: KernelFamily, numbers: list[Floats], step: float) -> list[DoubleDouble]:
    """Return A, B, C, S by the stable formulas in twice the precision, the tangent moved."""
    n, k, c, s = (DoubleDouble(NUMPY, part, 0.0 * part) for part in numbers)
    one = DoubleDouble(NUMPY, np.ones_like(n.high), np.zeros_like(n.high))
    s = s * (one + step)
    length = DoubleDouble.sqrt(c * c + s * s)
    kernel = family.by_method("stable").factory(twice(NUMPY))
    Fs, Fp, B, C, S = (one * number for number in kernel(one, n, k, c / length, s / length))
    return [0.5 * (Fs + Fp), B, C, S]


def _measured(kernel: Kernel, sample: Samples, component: str, what: str, dtype: str) -> WorstCase:
    found, place = matrix_numbers(kernel, sample), "ABCS".index(component[0])
    given = [part[0] for part in sample]
    with mpmath.workdps(WORKING_DIGITS):
        exact = REFERENCES[what](*map(exactly, given))
        value, condition = exact.values[place], exact.conditions[place]
        has_zeros = component[0] == "C" and what == "reflection"
        near = has_zeros and is_near_double_zero(exact.values[0], value, condition)
        if component == "C near 0":
            off = in_ulp(abs(exactly(found[0, place]) - value), exact.values[0], dtype)
        else:
            off = float(errors(found, [exact], dtype).componentwise[0, place])
        if near != (component == "C near 0"):
            off = 0.0
    return WorstCase(off, *map(float, given))
