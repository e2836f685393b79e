"""The accuracy of every method in every region, as tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.errors import OptipathError
from optipath.kernels.catalogue import METHODS
from optipath.lab.accuracy.error_measures import LIMIT
from optipath.lab.accuracy.interface_errors import interface_errors
from optipath.lab.accuracy.regions import REGIONS
from optipath.lab.accuracy.worst_cases import ANYWHERE, COMPONENTS, worst

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from optipath.lab.accuracy.regions import Region

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
    return [
        _reflection("float64", "componentwise", samples),
        _reflection("float64", "normwise", samples),
        _reflection("float32", "componentwise", samples),
        _transmission(samples),
    ]


def searched_tables(generations: int) -> list[TextTable]:
    """Return the worst cases that searches find, where the method promises any digits."""
    wanted = (("stable", "float64"), ("stable", "float32"), ("compensated", "float64"))
    return [_worst_cases(method, dtype, generations) for method, dtype in wanted]


def put_tables(text: str, found: Sequence[TextTable], marks: tuple[str, str] = SAMPLED) -> str:
    """Return a Markdown text with the tables between the two lines that mark their place.

    Examples
    --------
    >>> table = TextTable("All", ("region", "error"), (("here", "1.0"),))
    >>> print(put_tables(f"{BEGIN}{END}", [table]).splitlines()[2])
    All
    """
    begin, end = marks
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        raise OptipathError(f"the tables have no place; put '{begin}' and '{end}' into the file")
    before, rest = text.split(begin)
    behind = rest.split(end)[1]
    return f"{before}{begin}\n\n{''.join(map(_markdown, found))}{end}{behind}"


def shown(error: float) -> str:
    """Write an error in ulp*: bold where the method fails, "lost" where no digit is right.

    Examples
    --------
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
            off = interface_errors(method, region, dtype, samples)
            yield shown(_largest(getattr(off, kind)))

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
