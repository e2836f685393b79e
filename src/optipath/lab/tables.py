"""Accuracy tables: every method in every region, and searched worst cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import OptipathError
from optipath.kernels.catalog import METHODS, REFLECTION
from optipath.lab.errors import (
    FAMILIES,
    LIMIT,
    REFERENCES,
    errors,
    in_ulp,
    interface_errors,
    matrix_numbers,
)
from optipath.lab.many_digits import WORKING_DIGITS, exactly, mpmath
from optipath.lab.regions import REGIONS, Region, Samples

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    import numpy.typing as npt

    from optipath.kernels.kernel import KernelFamily
    from optipath.lab.regions import Dice

    Floats = npt.NDArray[np.floating]


BEGIN, END = "<!-- tables: optipath accuracy -->", "<!-- end of tables -->"
SAMPLED = BEGIN, END
SEARCHED = "<!-- worst cases: optipath accuracy --search -->", "<!-- end of worst cases -->"
"""The lines between which tables stand in a document."""


class TextTable(NamedTuple):
    """A table of words."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def tables(samples: int) -> list[TextTable]:
    """Return the tables of reflection in float64 and float32, and of transmission."""
    wanted = ("float64", "componentwise"), ("float64", "normwise"), ("float32", "componentwise")
    return [*(_reflection(*each, samples) for each in wanted), _transmission(samples)]


def searched_tables(generations: int) -> list[TextTable]:
    """Return the worst cases that searches find, where the method promises any digits."""
    wanted = (("stable", "float64"), ("stable", "float32"), ("compensated", "float64"))
    return [_worst_cases(method, dtype, generations) for method, dtype in wanted]


def put_tables(text: str, results: Sequence[TextTable], marks: tuple[str, str] = SAMPLED) -> str:
    """Return a Markdown text with the tables between the two lines that mark their place.

    >>> table = TextTable("All", ("region", "error"), (("here", "1.0"),))
    >>> print(put_tables(f"{BEGIN}{END}", [table]).splitlines()[2])
    All
    """
    begin, end = marks
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        raise OptipathError(f"the tables have no place; put '{begin}' and '{end}' into the file")
    before, rest = text.split(begin)
    behind = rest.split(end)[1]
    return f"{before}{begin}\n\n{''.join(map(_markdown, results))}{end}{behind}"


def shown(error: float) -> str:
    """Write an error in ulp*: bold where the method fails, "lost" where no digit is right.

    >>> shown(0.0), shown(3.14), shown(1.2e7), shown(np.inf)
    ('0', '3.1', '**1e7**', '**lost**')
    """
    if error == 0.0:
        return "0"
    if error <= LIMIT:
        return f"{error:.1f}" if error < 100 else f"{error:.0f}"
    if not error < 1e15:
        return "**lost**"
    return f"**1e{int(np.log10(error))}**"


def _reflection(dtype: str, kind: str, samples: int) -> TextTable:
    def row(region: Region) -> Iterator[str]:
        for method in METHODS:
            yield shown(_largest(getattr(interface_errors(method, region, dtype, samples), kind)))

    words = {"componentwise": "worst of A, B, C, S, each in its ulp*", "normwise": "in ulp of A"}
    return _of_regions(f"Reflection, {dtype}, {kind}: {words[kind]}", METHODS, row)


def _transmission(samples: int) -> TextTable:
    methods = ("stable", "compensated")

    def row(region: Region) -> Iterator[str]:
        lossless = region.samples(samples).k == 0.0
        for method in methods:
            off = interface_errors(method, region, "float64", samples, "transmission")
            yield from (shown(_largest(off.componentwise[:, i])) for i in (0, 1))
            yield shown(_largest(off.componentwise[lossless, 2])) if lossless.any() else ""

    columns = [f"{method} {name}" for method in methods for name in "ABC"]
    title = "Transmission, float64: worst in ulp*; C where nothing absorbs"
    return _of_regions(title, columns, row)


def _worst_cases(method: str, dtype: str, generations: int) -> TextTable:
    sides = [("reflection", name) for name in COMPONENTS]
    sides += [("transmission", name) for name in "ABC"]

    def row(region: Region) -> Iterator[str]:
        for what, name in sides:
            yield shown(worst(method, region, name, what, dtype, generations=generations).error)

    columns = [f"{what[0].upper()} {name}" for what, name in sides]
    title = f"Worst cases found of {method}, {dtype}: reflection (R), transmission (T)"
    return _of_regions(title, columns, row, (*REGIONS, ANYWHERE))


def _of_regions(
    title: str,
    columns: Iterable[str],
    row: Callable[[Region], Iterable[str]],
    regions: tuple[Region, ...] = REGIONS,
) -> TextTable:
    rows = tuple((region.name, *row(region)) for region in regions)
    return TextTable(title, ("region", *columns), rows)


def _largest(numbers: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    return float(np.max(np.where(np.isnan(numbers), np.inf, numbers)))


def _markdown(table: TextTable) -> str:
    rows = [table.header, ("---",) + ("---:",) * (len(table.header) - 1), *table.rows]
    lines = "\n".join("| " + " | ".join(row) + " |" for row in rows)
    return f"{table.title}\n\n{lines}\n\n"


COMPONENTS = ("A", "B", "C", "S", "C near 0")
"""What is searched: the four numbers, C but where its zero is double, and C there."""

_CHILDREN, _SURVIVORS, _LIFE = 1000, 100, 200
_STEPS = 2.0**13
"""By how many roundings a tangent is moved to find a condition: next to an angle, too."""


def _anywhere(dice: Dice) -> tuple[Floats, ...]:
    away = dice.decades(1e-6, 10.0)
    n = np.where(dice.sign() > 0, 1.0 + away, 1.0 / (1.0 + away))
    k = np.where(dice.sign() > 0, dice.decades(1e-9, 10.0), away * dice.decades(1e-3, 1e2))
    angle = dice.decades(1e-4, np.pi / 4)
    one, other = np.cos(angle), np.sin(angle)
    steep = dice.sign() > 0
    return n, k, np.where(steep, one, other), np.where(steep, other, one)


ANYWHERE = Region("anywhere", _anywhere)
"""Where regions meet: searched, and in no table of samples."""


class WorstCase(NamedTuple):
    """The worst case that was found, and its error in ulp."""

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

    Numbers behind samples are mutated by steps of all sizes, and the worst samples survive. The
    climb compares with stable formulas in a wider float (`numpy.longdouble` for float64; without
    one nothing is found); the result is measured against 50 digits.

    >>> from optipath.lab.regions import REGIONS
    >>> worst("stable", REGIONS[0], "A", generations=5).error < 16.0
    True
    """
    rng = np.random.default_rng(seed)
    family = FAMILIES[what]
    kernel = family.by_method(method)
    kind = np.float64 if dtype == "float32" else np.longdouble
    units: Floats = rng.random((region.dimensions, _CHILDREN))
    stored, known, best = units[:, :0], np.empty(0), (-1.0, units[:, :1])
    for generation in range(1, generations + 1):
        samples = region.at(units, dtype)
        scores = _scores(component, matrix_numbers(kernel, samples), samples, family, kind)
        known, stored = np.append(known, scores), np.append(stored, units, axis=1)
        order = np.argsort(-known)[:_SURVIVORS]
        known, stored = known[order], stored[:, order]
        best = max(best, (float(known[0]), stored[:, :1]), key=lambda pair: pair[0])
        units = _children(rng, stored)
        if generation % _LIFE == 0:  # A climb that has come to its top begins elsewhere.
            units, known, stored = rng.random(units.shape), known[:0], stored[:, :0]
    sample = region.at(best[1], dtype)
    error = _measured(matrix_numbers(kernel, sample), sample, component, what, dtype)
    return WorstCase(error, *[float(part[0]) for part in sample])


def _children(rng: np.random.Generator, parents: Floats) -> Floats:
    """Return what comes of some coordinates changed a little, and some that are new."""
    shape = len(parents), _CHILDREN
    steps = rng.normal(size=shape) * 10.0 ** rng.uniform(-17.0, -0.5, _CHILDREN)
    changed = rng.random(shape) < rng.choice([0.35, 0.7, 1.0], _CHILDREN)
    # The square prefers the worst, which come first.
    chosen = (parents.shape[1] * rng.random(_CHILDREN) ** 2).astype(int)
    children = parents[:, chosen] + steps * changed
    fresh = rng.random(_CHILDREN) < 0.05
    # What leaves the unit cube is mirrored back.
    inside = np.abs((children + 1.0) % 2.0 - 1.0)
    return np.where(fresh, rng.random(shape), inside)


def _scores(
    component: str, result: Floats, samples: Samples, family: KernelFamily, kind: Any
) -> Floats:
    """Return the errors of computed numbers against the stable formulas in a wider float."""
    place, step = "ABCS".index(component[0]), _STEPS * np.finfo(kind).eps
    with np.errstate(all="ignore"):
        (A, exact), (_, moved) = (_wide(family, samples, kind, by, place) for by in (0.0, step))
        condition = np.abs((moved - exact) / exact) / step
        condition = np.where((samples.cos > 0.0) & (samples.sin > 0.0), condition, 0.0)
        has_zeros = component[0] == "C" and family is REFLECTION
        near = is_near_double_zero(A, exact, condition) & has_zeros
        score = np.abs(result[:, place] - exact)
        score /= _ulp(A if component == "C near 0" else exact, result.dtype)
        if component != "C near 0":
            score, near = score / (1.0 + condition), ~near
    return np.where(np.isfinite(score) & near & (exact != 0.0), score, 0.0).astype(float)


def _wide(
    family: KernelFamily, samples: Samples, kind: Any, by: float, place: int
) -> tuple[Floats, Floats]:
    """Return A and one of the four numbers in a wider float, the tangent moved."""
    n, k, c, s = (part.astype(kind) for part in samples)
    s = s * (kind(1.0) + by)
    length = np.hypot(c, s)
    numbers = matrix_numbers(family.by_method("stable"), Samples(n, k, c / length, s / length))
    return numbers[:, 0], numbers[:, place]


def is_near_double_zero(A: Any, C: Any, condition: Any) -> Any:
    """Tell whether C is small at an angle that hardly moves it."""
    return abs(C) * (1.0 + condition) < 0.5 * A


def _ulp(number: Floats, dtype: Any) -> Floats:
    kind = np.finfo(dtype)
    exponent = np.maximum(np.frexp(number)[1] - 1, kind.minexp)
    return np.asarray(np.ldexp(np.ones((), number.dtype), exponent - kind.nmant))


def _measured(result: Floats, sample: Samples, component: str, what: str, dtype: str) -> float:
    """Return the error against 50 digits; 0 where C is near 0 and another is asked for."""
    place, of_zeros = "ABCS".index(component[0]), component == "C near 0"
    with mpmath.workdps(WORKING_DIGITS):
        exact = REFERENCES[what](*[exactly(part[0]) for part in sample])
        value, condition = exact.values[place], exact.conditions[place]
        has_zeros = component[0] == "C" and what == "reflection"
        near = has_zeros and is_near_double_zero(exact.values[0], value, condition)
        if near != of_zeros:
            return 0.0
        if of_zeros:
            return in_ulp(abs(exactly(result[0, place]) - value), exact.values[0], dtype)
        return float(errors(result, [exact], dtype).componentwise[0, place])
