"""Columns of numbers by wavelength, read from a file of separated values."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ValueFault, shown
from optipath.values.curves.csv_blocks import joined_blocks
from optipath.values.curves.csv_header import axis_of, has_numbers, places_of, quantity_text
from optipath.values.domains.wavelengths import LONGEST
from optipath.values.spectral_units import wavelength_of
from optipath.values.units import parse_quantity

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from os import PathLike

_MOST_TOLD = 12


@dataclass(frozen=True)
class CsvColumns:
    """What stands in a file.

    Attributes
    ----------
    title : str
        The name of the file, without its ending.
    wavelengths : ndarray, shape (n,)
        In vacuum and in metres, as they stand in the file: rising or falling.
    columns : dict of str to ndarray, shape (n,)
        Those that were asked for.
    """

    title: str
    wavelengths: np.ndarray[Any, Any]
    columns: dict[str, np.ndarray[Any, Any]] = field(default_factory=dict)


def read_columns(
    path: str | PathLike[str],
    names: Sequence[str],
    *,
    unit: str = "",
    cures: Mapping[str, str] | None = None,
    not_negative: Mapping[str, str] | None = None,
) -> CsvColumns:
    """Return the wavelengths and some columns of a file.

    The first line has the names of the columns, a unit in parentheses: ``wavelength (nm)``, ``wl
    [um]``, ``wavelength_nm``, ``energy (eV)``. Values are separated by commas, semicolons or
    tabulators; empty lines and those that begin with ``#`` are comments.

    Parameters
    ----------
    path : str or PathLike
        The file, in UTF-8.
    names : sequence of str
        The columns besides, capitals or not.
    unit : str, optional
        Of the wavelengths, where the first line has none.
    cures : mapping of str to str, optional
        What else to do where a column is missing, as a sentence goes on behind "or".
    not_negative : mapping of str to str, optional
        The columns that have no numbers below 0, and what is added to the sentence on one.

    Returns
    -------
    CsvColumns

    Raises
    ------
    ValueFault
        With all that is wrong, and the lines.
    """
    file = Path(path)
    lines = _lines(file)
    if not lines:
        raise ValueFault("it is empty; write a line for each wavelength", about=str(file))
    try:
        (number, header), *rows = joined_blocks(lines)
    except ValueFault as fault:
        raise ValueFault(*fault.faults, about=str(file)) from None
    faults: list[str] = []
    at, of_axis = axis_of(number, header, unit, faults)
    places = {} if has_numbers(header) else places_of(number, header, names, cures or {}, faults)
    if not faults and not rows:
        faults.append(f"line {number} is the only one; write a line for each wavelength behind it")
    if faults:
        raise ValueFault(*faults, about=str(file))
    found = _Rows([], [], {name: [] for name in names}, [], not_negative or {})
    for row in rows:
        found.read(row, at, of_axis, places, len(header))
    found.check_order(of_axis)
    if found.faults:
        told, more = found.faults[:_MOST_TOLD], len(found.faults) - _MOST_TOLD
        raise ValueFault(*told, *[f"and {more} more"] * (more > 0), about=str(file))
    columns = {name: np.array(values) for name, values in found.columns.items()}
    return CsvColumns(file.stem, np.array(found.wavelengths), columns)


@dataclass
class _Rows:
    """What has been read so far."""

    numbers: list[int]
    wavelengths: list[float]
    columns: dict[str, list[float]]
    faults: list[str]
    not_negative: Mapping[str, str]

    def read(
        self,
        row: tuple[int, list[str]],
        at: int,
        unit: str,
        places: Mapping[str, int],
        count: int,
    ) -> None:
        """Read a line."""
        line, cells = row
        if len(cells) != count:
            self.faults.append(
                f"line {line} has {len(cells)} values, and the first line {count} names; write "
                f"one for each"
            )
            return
        before = len(self.faults)
        wavelength = self._wavelength(line, cells[at], unit)
        values = {name: self._number(line, name, cells[place]) for name, place in places.items()}
        if len(self.faults) > before:
            return
        self.numbers.append(line)
        self.wavelengths.append(wavelength)
        for name, value in values.items():
            self.columns[name].append(value)

    def _wavelength(self, line: int, cell: str, unit: str) -> float:
        try:
            text = quantity_text(cell, unit)
            found = wavelength_of(text)
            found = parse_quantity(text, "length") if found is None else found  # type: ignore[assignment]
        except OptipathError as fault:
            self.faults += [f"line {line}: {sentence}" for sentence in fault.faults]
            return np.nan
        if not 0.0 < found < np.inf:  # type: ignore[operator]
            self.faults.append(f"line {line}: the wavelength is {cell}; give numbers above 0")
        return found  # type: ignore[return-value]

    def _number(self, line: int, name: str, cell: str) -> float:
        try:
            found = float(cell)
        except ValueError:
            wanted = "is empty" if not cell else f"is {shown(cell)}, which is no number"
            self.faults.append(f"line {line}: {name} {wanted}; write one, such as 1.5")
            return np.nan
        if not np.isfinite(found):
            self.faults.append(
                f"line {line}: {name} is {cell}; write a number, or leave the line out"
            )
        if found < 0.0 and name in self.not_negative:
            self.faults.append(
                f"line {line}: {name} is {cell}; give none below 0{self.not_negative[name]}"
            )
        return found

    def check_order(self, unit: str) -> None:
        """Look whether the wavelengths of sound lines rise or fall throughout."""
        if not self.wavelengths:
            return
        least = min(self.wavelengths)
        if least > LONGEST:
            line = self.numbers[self.wavelengths.index(least)]
            self.faults.append(
                f"line {line}: the wavelength is {least:g} metres, which is no wavelength of "
                f"light; the unit {unit} is most likely another one"
            )
        lines = dict(zip(self.wavelengths, self.numbers, strict=True))
        if len(lines) < len(self.wavelengths):
            first: dict[float, int] = {}
            for wavelength, number in zip(self.wavelengths, self.numbers, strict=True):
                if (same := first.setdefault(wavelength, number)) != number:
                    self.faults.append(
                        f"line {number} has the wavelength of line {same}; write each once"
                    )
            return
        steps = np.sign(np.diff(self.wavelengths))
        if np.any(turns := steps != steps[:1]):
            place = int(np.argmax(turns))
            self.faults.append(
                f"line {self.numbers[place + 1]}: the wavelengths of the lines before "
                f"{'rise' if steps[0] > 0 else 'fall'}, and from line {self.numbers[place]} to "
                f"this one they do not; sort the lines by wavelength"
            )


def _lines(file: Path) -> list[tuple[int, list[str]]]:
    """Return the lines with values, each with its number."""
    try:
        text = file.read_text("utf-8-sig")
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
    return [
        (number, [cell.strip() for cell in next(csv.reader([line], delimiter=separator))])
        for number, line in lines
    ]
