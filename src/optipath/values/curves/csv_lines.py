"""The lines of a file of separated values, each with its number."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, TypeAlias

from optipath.errors import ValueFault
from optipath.values.given_files import bytes_of

if TYPE_CHECKING:
    from pathlib import Path

Line: TypeAlias = tuple[int, list[str]]
"""Its number, and what stands in it."""

_MOST_TOLD = 12


def lines_of(file: Path) -> list[Line]:
    """Return the lines with values, each with its number."""
    try:
        text = bytes_of(file).decode("utf-8-sig")
    except FileNotFoundError:
        raise ValueFault("there is no such file; look at its name", about=str(file)) from None
    except (OSError, UnicodeDecodeError) as fault:
        why = "it is no text in UTF-8" if isinstance(fault, ValueError) else fault.strerror
        raise ValueFault(f"it cannot be read: {why}", about=str(file)) from None
    lines = [(number, line.strip()) for number, line in enumerate(text.splitlines(), 1)]
    lines = [(number, line) for number, line in lines if line and not line.startswith("#")]
    if not lines:
        return []
    separator = next((each for each in ";\t" if each in lines[0][1]), ",")
    faults: list[str] = []
    found = [(number, _cells(number, line, separator, faults)) for number, line in lines]
    if faults:
        raise ValueFault(*first_of(faults), about=str(file))
    return found


def _cells(number: int, line: str, separator: str, faults: list[str]) -> list[str]:
    try:
        (cells,) = csv.reader([line], delimiter=separator, strict=True)
    except csv.Error as fault:
        quotes = "quotation marks are not closed, or amid a cell"
        why = quotes if '"' in line else f"it cannot be read ({fault})"
        faults.append(f"line {number}: {why}; write numbers alone, without quotation marks")
        return []
    return [cell.strip() for cell in cells]


def first_of(faults: list[str]) -> list[str]:
    """Return the first of many faults, and how many more there are."""
    more = len(faults) - _MOST_TOLD
    return [*faults[:_MOST_TOLD], *[f"and {more} more"] * (more > 0)]
