"""Columns of numbers by wavelength, read from a file of separated values."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.errors import OptipathError, ValueFault, listed, shown
from optipath.values.curves.csv_header import axis_of, has_numbers, is_header, names_in, places_of
from optipath.values.curves.csv_lines import Line, first_of, lines_of
from optipath.values.curves.doubtful_units import unit_doubted
from optipath.values.domains.wavelengths import LONGEST_FIRST
from optipath.values.given_files import given_file
from optipath.values.spectral_units import wavelength_of
from optipath.values.units import parse_quantity, unit_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from os import PathLike

Array: TypeAlias = "np.ndarray[Any, Any]"


@dataclass(frozen=True)
class CsvColumns:
    """What stands in a file.

    Shapes: wavelengths (n,); columns (n,). Units: wavelengths in metres.
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
    signs: Mapping[str, str] | None = None,
) -> CsvColumns:
    """Return the wavelengths and some columns of a file.

    The first line has the names of the columns, a unit in parentheses: ``wavelength (nm)``, ``wl
    [um]``, ``wavelength_nm``, ``energy (eV)``; or each wavelength has one, ``400 nm``. Values are
    separated by commas, semicolons or tabulators; empty lines and those that begin with ``#`` are
    comments. A second first line begins a second table, of the same wavelengths, as files of
    refractiveindex.info have n and k.
    """
    file = given_file(path)
    _check_texts(names, unit)
    lines = lines_of(file)
    if not lines:
        raise ValueFault("it is empty; write a line for each wavelength", about=str(file))
    blocks = _blocks(lines)
    wanted = [names_in(block[0][1], names) for block in blocks]
    # What is in none is missed in the first.
    others = {name for here in wanted[1:] for name in here}
    wanted[0] = [name for name in names if name in wanted[0] or name not in others]
    try:
        tables = [
            (block[0][0], *_table(block, here, unit, cures or {}, signs or {}))
            for block, here in zip(blocks, wanted, strict=True)
            if here
        ]
        wavelengths, columns = _joined(tables, unit)
    except ValueFault as fault:
        raise ValueFault(*first_of([*fault.faults]), about=str(file)) from None
    return CsvColumns(file.stem, wavelengths, columns)


def _blocks(lines: list[Line]) -> list[list[Line]]:
    """Return the lines of each table of a file, of which each begins with the names of columns."""
    begins = [0, *[at for at, (_, cells) in enumerate(lines) if at and is_header(cells)]]
    return [lines[begin:end] for begin, end in pairwise([*begins, len(lines)])]


def _table(
    lines: list[Line],
    names: Sequence[str],
    unit: str,
    cures: Mapping[str, str],
    signs: Mapping[str, str],
) -> tuple[Array, dict[str, Array]]:
    """Return the wavelengths and the columns of a table."""
    (number, header), *rows = lines
    faults: list[str] = []
    below = [cells for _, cells in rows]
    at, of_axis = axis_of(number, header, unit, faults, names=names, rows=below)
    places = {} if has_numbers(header) else places_of(number, header, names, cures, faults)
    if not faults and not rows:
        faults.append(f"line {number} is the only one; write a line for each wavelength behind it")
    if faults:
        raise ValueFault(*faults)
    found = _Rows({name: [] for name in names}, signs, number)
    for row in rows:
        found.read(row, at, of_axis, places, len(header))
    found.check_order(of_axis)
    if found.faults:
        raise ValueFault(*found.faults)
    return np.array(found.wavelengths), {name: np.array(v) for name, v in found.columns.items()}


def _joined(
    tables: list[tuple[int, Array, dict[str, Array]]], unit: str
) -> tuple[Array, dict[str, Array]]:
    """Return the columns of tables of the same wavelengths."""
    (_, wavelengths, columns), *others = tables
    for number, here, more in others:
        if twice := sorted(columns.keys() & more):
            raise ValueFault(f"line {number} begins a second table of {listed(twice)}; keep one")
        if not np.array_equal(here, wavelengths):
            raise ValueFault(
                f"line {number} begins a second table, whose wavelengths are not those of the "
                f"first; write all columns into lines of common wavelengths, or read each from its "
                f"own table, as {_apart([*columns, *more], unit)}"
            )
        columns |= more
    return wavelengths, columns


def _apart(names: Sequence[str], unit: str) -> str:
    """Return code that reads columns at wavelengths of their own."""
    given = f", unit='{unit}'" if unit else ""
    one = f"op.Spectrum.from_csv(path, column{given}).at(op.Wavelength())"
    return f"op.Material(*[{one} for column in {(*names,)}])"


def _check_texts(names: Sequence[Any], unit: Any) -> None:
    faults = [
        f"a column is asked for by its name, a text, not by {shown(name)}; write one such as "
        f"column='power'"
        for name in names
        if not isinstance(name, str)
    ]
    if not isinstance(unit, str):
        faults.append(f"the unit is {shown(unit)}; give a text, such as unit='nm'")
    if faults:
        raise ValueFault(*faults)


@dataclass
class _Rows:
    """What has been read so far."""

    columns: dict[str, list[float]]
    signs: Mapping[str, str]
    header: int
    numbers: list[int] = field(default_factory=list)
    wavelengths: list[float] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    have_units: bool = False

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
                f"line {line} has {len(cells)} values, and line {self.header} has {count} names; "
                f"write one for each"
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
        own = unit_of(cell)
        self.have_units |= bool(own)
        if own and unit and own != unit:
            self.faults.append(
                f"line {line}: '{cell}' is in another unit than '{unit}' of line {self.header}; "
                f"leave one of them out"
            )
            return np.nan
        try:
            text = cell if own else f"{cell} {unit}"
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
            found = float(cell if _is_plain(cell) else "")
        except ValueError:
            wanted = "is empty" if not cell else f"is {shown(cell)}, which is no number"
            self.faults.append(f"line {line}: {name} {wanted}; write one, such as 1.5")
            return np.nan
        if not np.isfinite(found):
            self.faults.append(f"line {line}: {name} is {cell}; write a number, or leave it out")
        elif found < 0.0:
            beside = f", {self.signs[name]}" if name in self.signs else ""
            self.faults.append(f"line {line}: {name} is {cell}; write none below 0{beside}")
        return found

    def check_order(self, unit: str) -> None:
        """Look whether the wavelengths rise or fall throughout."""
        if self.faults or not self.wavelengths:
            return
        least = min(self.wavelengths)
        if least > LONGEST_FIRST:
            self.faults.append(
                f"the least wavelength is {least:g} metres, which is no wavelength of light; the "
                f"unit {unit} is most likely another one"
            )
        elif not self.have_units and (doubt := unit_doubted(self.wavelengths, unit)):
            self.faults.append(doubt)
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


def _is_plain(cell: str) -> bool:
    """Tell whether Python reads no more into a text than a number: ``1_5`` is not meant as 15."""
    return cell.isascii() and "_" not in cell
