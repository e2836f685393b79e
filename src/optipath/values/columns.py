"""Columns of numbers in files of separated values, with units in their headings."""

from __future__ import annotations

import csv
import re
from contextlib import suppress
from itertools import pairwise
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import OptipathError, ParameterError, ValueFault
from optipath.faults import did_you_mean, listed, shown, there_are
from optipath.values.files import bytes_of, input_file
from optipath.values.units import (
    UNITS,
    USUAL_UNITS,
    dimension_of,
    displayed,
    parse_quantity,
    unit_of,
    units_of,
)
from optipath.values.wavelength import SPECTRAL, wavelength_of

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence
    from os import PathLike
    from pathlib import Path

    from optipath.values.parameters import Parameter


_NUMBER = re.compile(r"[-+]?\.?\d")

NO_UNIT = "1"
"""What stands for no unit, as the conventions for NetCDF (CF) write it."""

Line: TypeAlias = tuple[int, list[str]]
"""Its number, and its cells."""


class TextColumn(NamedTuple):
    """A column of a file: what its heading says, and its cells with their lines."""

    name: str
    unit: str
    cells: tuple[str, ...]
    lines: tuple[int, ...]
    file: str
    header: int

    @property
    def texts(self) -> tuple[str, ...]:
        """The cells, numbers with the unit of the heading."""
        texts = [f"{cell} {self.unit}" if _is_plain(cell) else cell for cell in self.cells]
        return tuple(texts) if self.unit else self.cells


def _is_plain(cell: str) -> bool:
    return bool(_NUMBER.match(cell)) and not unit_of(cell)


def columns_of(path: str | PathLike[str], known: Collection[str] = ()) -> list[TextColumn]:
    """Return the columns of a file.

    The first line has their names with units, ``delta (deg)``, ``delta [deg]`` or ``delta_deg``
    (``(1)`` is none), or each number has one. Values are separated by commas, semicolons or
    tabulators; ``#`` begins a comment.
    """
    file = input_file(path, ParameterError)
    columns = _columns(file, lines_of(file), known, "delta (deg), wavelength (nm)")
    faults = [
        f"line {line} has an empty cell; write a value"
        for column in columns
        for line, cell in zip(column.lines, column.cells, strict=True)
        if not cell
    ]
    ParameterError.raise_for(faults, str(file))
    return columns


def column_for(parameter: Parameter, path: str) -> list[str]:
    """Return the texts of the column that is a parameter's: of its name, or the only one."""
    name = parameter.name
    columns = {column.name: column for column in columns_of(path, [name])}
    names = [*columns]
    column = columns.get(name, columns[names[0]])
    fault = missing_unit(column, parameter)
    if len(names) > 1 and name not in names:
        fault = f"none of the columns {listed(names)} is '{name}'{did_you_mean(name, names)}"
    elif column.name in parameter.all_words:
        fault = f"'{column.name}' is the first line, which is a name; begin with the line '{name}'"
    if fault:
        raise ParameterError(fault, about=path)
    return [*column.texts]


def missing_unit(column: TextColumn, parameter: Parameter) -> str:
    """Return what is wrong with a column whose numbers need a unit and have none; else nothing."""
    dimension = dimension_of(parameter.unit)
    if not dimension or column.unit or not any(map(_is_plain, column.cells)):
        return ""
    return (
        f"column '{column.name}' has no unit; write its name as "
        f"'{column.name} ({USUAL_UNITS[dimension]})' if that is its unit"
    )


class CsvColumns(NamedTuple):
    """What stands in a file. Shapes wavelengths (n,); columns (n,). Units wavelengths in metres."""

    title: str
    wavelengths: np.ndarray[Any, Any]
    columns: dict[str, np.ndarray[Any, Any]]


def read_columns(
    path: str | PathLike[str],
    names: Sequence[str],
    *,
    unit: str = "",
    cures: Mapping[str, str] = MappingProxyType({}),
) -> CsvColumns:
    """Return the wavelengths and some columns of a file.

    As `columns_of`, with a wavelength or an energy first: ``wavelength (nm)``, ``wl [um]``,
    ``wavelength_nm``, ``energy (eV)``, or ``400 nm`` in each line. A second first line begins a
    second table of the same wavelengths, as files of refractiveindex.info have n and k.
    """
    file = input_file(path)
    if wrong := [shown(one) for one in (*names, unit) if not isinstance(one, str)]:
        raise ValueFault(f"columns and units are given as texts, not as {listed(wrong)}")
    lines = lines_of(file)
    axes = [any(split_heading(cell)[0].lower() in _AXES for cell in cells) for _, cells in lines]
    begins = [0, *[at for at, names_axis in enumerate(axes) if at and names_axis]]
    tables = [
        _columns(file, lines[begin:end], (), ", ".join(["wavelength (nm)", *names]))
        for begin, end in pairwise([*begins, len(lines)])
    ]
    others = [column.name for column in tables[0] if column.name.lower() not in _AXES]
    faults = [
        f"line {tables[0][0].header} names no column '{name}'"
        f"{did_you_mean(name, others) if others else ''}{cures.get(name, '')}"
        for name in names
        if not any(_among(table, name) for table in tables)
    ]
    grids: list[np.ndarray[Any, Any]] = []
    results: dict[str, np.ndarray[Any, Any]] = {}
    for table in tables:
        here = [name for name in names if _among(table, name)]
        if not here and (table is not tables[0] or not faults):
            continue
        second = f"line {table[0].header} begins a second table"
        if twice := sorted(results.keys() & here):
            faults.append(f"{second} of {listed(twice)}; keep one")
        with OptipathError.collecting(faults):
            grids.append(_wavelengths(table, unit))
            results |= {name: _numbers(table, name) for name in here}
            if not np.array_equal(grids[0], grids[-1]):
                cure = "write all columns into lines of common wavelengths"
                faults.append(f"{second}, of other wavelengths; {cure}")
    ValueFault.raise_for(faults, str(file))
    return CsvColumns(file.stem, grids[0], results)


_AXES = {
    "wavelength": "length",
    "wl": "length",
    "lambda": "length",
    "\u03bb": "length",
    "energy": "photon energy",
    "photon energy": "photon energy",
    "wavenumber": "wave number",
    "wave number": "wave number",
    "frequency": "frequency",
}
"""What the first column may be called, and what it is."""

_SPELT = {"\u00b5m": "um", "\u03bcm": "um", "microns": "um", "micron": "um", "ev": "eV"}
_SPELT |= dict.fromkeys(("\u00c5", "\u212b", "A", "angstroms", "Angstrom"), "angstrom")
_BEHIND = {*UNITS, *_SPELT, *SPECTRAL["photon energy"], *SPECTRAL["wave number"]}
"""Units that a name may end with."""

_HEAD = re.compile(r"(.*?)\s*(?:\(([^()]*)\)|\[([^][]*)\])?")


def split_heading(head: str) -> tuple[str, str]:
    """Return what a column is called, and its unit; ``""`` for none."""
    match = _HEAD.fullmatch(head.strip())
    name, unit = (match[1], match[2] or match[3] or "") if match else (head, "")
    before, line, behind = name.rpartition("_")
    if not unit and line and behind in _BEHIND:
        name, unit = before, behind
    unit = _SPELT.get(unit.strip(), unit.strip())
    return name.strip(), "" if unit == NO_UNIT else unit


def _among(columns: Sequence[TextColumn], name: str) -> list[TextColumn]:
    return [column for column in columns if column.name.lower() == name.lower()]


def _columns(
    file: Path, lines: list[Line], known: Collection[str], example: str
) -> list[TextColumn]:
    """Return the columns of a table, of which the first line has the names."""
    if not lines:
        raise ValueFault("it is empty; write the names of columns, and lines", about=str(file))
    (number, header), *rows = lines
    heads = [(head, "") if head in known else split_heading(head) for head in header]
    names = [name for name, _ in heads]
    faults = []
    if not rows or any(_NUMBER.match(cell) or not cell for cell in header):
        faults.append(
            f"line {number} has no names of columns, or is the only one; begin with a line such as "
            f"'{example}', and write one for each value behind it"
        )
    faults += [
        f"line {line} has {len(cells)} values, and line {number} has {len(header)} names; "
        f"write one for each"
        for line, cells in rows
        if len(cells) != len(header)
    ]
    if not faults:
        twice = sorted({name for name in names if names.count(name) > 1})
        faults += [f"line {number} names '{name}' twice; keep one column" for name in twice]
        faults += [
            f"line {line}: '{cell}' is not in {unit}, as line {number} says; keep one"
            for line, cells in rows
            for (_, unit), cell in zip(heads, cells, strict=True)
            if unit and (own := unit_of(cell)) and own != unit
        ]
    ValueFault.raise_for(faults, str(file))
    numbers = tuple([line for line, _ in rows])
    cells_of = zip(*[cells for _, cells in rows], strict=True)
    return [
        TextColumn(name, unit, cells, numbers, str(file), number)
        for (name, unit), cells in zip(heads, cells_of, strict=True)
    ]


def _wavelengths(table: Sequence[TextColumn], unit: str) -> np.ndarray[Any, Any]:
    """Return the wavelengths of a table in metres."""
    axes = [column for column in table if column.name.lower() in _AXES]
    line = f"line {table[0].header}"
    if len(axes) != 1:
        names = listed([f"'{column.name}'" for column in axes or table])
        cure = "give one column of wavelengths, such as 'wavelength (nm)'"
        raise ValueFault(f"{line} has {names}; {cure}")
    (axis,) = axes
    unit = _SPELT.get(unit, unit)
    dimension = _AXES[axis.name.lower()]
    known = [*SPECTRAL.get(dimension, units_of(dimension))]
    own = axis.unit or unit
    have_units = [bool(unit_of(cell)) for cell in axis.cells]
    if unit and own != unit:
        raise ValueFault(f"{line} has the unit {own}, and unit='{unit}' is given; leave it out")
    if own and own not in known:
        raise ValueFault(f"{line}: '{own}' is no unit of '{axis.name}'{there_are(known)}")
    if not own and not all(have_units):
        cure = f"write '{axis.name} ({known[0]})', or give unit='{known[0]}'"
        raise ValueFault(f"{line}: '{axis.name}' has no unit; {cure}")
    results = _each(axis._replace(unit=own).texts, axis.lines, _wavelength)
    if doubt := unit_doubted(results, "" if any(have_units) else own):
        raise ValueFault(doubt)
    return np.array(results)


def _each(texts: Sequence[str], lines: Sequence[int], read: Callable[[str], float]) -> list[float]:
    """Return the number of each text, or what is wrong with those of which lines."""
    results: list[float] = []
    faults: list[str] = []
    for line, text in zip(lines, texts, strict=True):
        with OptipathError.collecting(faults, about=f"line {line}"):
            results.append(read(text))
    ValueFault.raise_for(faults)
    return results


def _wavelength(text: str) -> float:
    result = wavelength_of(text)
    number: Any = parse_quantity(text, "length") if result is None else result
    if not 0.0 < number < np.inf:
        raise ValueFault(f"the wavelength is {text}; give numbers above 0")
    return float(number)


def _numbers(table: Sequence[TextColumn], name: str) -> np.ndarray[Any, Any]:
    """Return the numbers of a column."""
    column, *others = _among(table, name)
    if others:
        raise ValueFault(f"line {column.header} names '{name}' twice; keep one column")

    def number(cell: str) -> float:
        # Python reads 1_5 as 15.
        with suppress(ValueError):
            result = float(cell if cell.isascii() and "_" not in cell else "")
            if np.isfinite(result):
                return result
        raise ValueFault(f"{name} is {shown(cell)}, which is no number; write one, such as 1.5")

    return np.array(_each(column.cells, column.lines, number))


_DOUBTS = {"um": (100e-6, np.inf, "nm"), "nm": (0.0, 10e-9, "um")}
"""Between which metres wavelengths of a table in a unit are doubted, and what is meant: 100 to 1000
is light in nm, 0.1 to 10 in um; tables in eV, THz and 1/cm may well be X-rays or far infrared."""


def unit_doubted(metres: Sequence[float], unit: str) -> str:
    """Return why the unit of a table of wavelengths is most likely another one, if it is."""
    if not len(metres) or unit not in _DOUBTS:
        return ""
    low, high, meant = _DOUBTS[unit]
    least, most = float(min(metres)), float(max(metres))
    if not low <= least <= most <= high:
        return ""
    first = displayed(least, unit)
    return (
        f"the wavelengths are {first} .. {displayed(most, unit)}, which are most likely {meant}; "
        f"give the unit {meant}, or, where they are meant, each with its unit, such as '{first}'"
    )


def lines_of(file: Path) -> list[Line]:
    """Return the lines with values, each with its number."""
    try:
        text = bytes_of(file).decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as fault:
        why = "it is no text in UTF-8" if isinstance(fault, ValueError) else fault.strerror
        raise ValueFault(f"it cannot be read: {why}", about=str(file)) from None
    lines = [(number, line.strip()) for number, line in enumerate(text.splitlines(), 1)]
    lines = [(number, line) for number, line in lines if line and not line.startswith("#")]
    separator = next((each for each in ";\t" if lines and each in lines[0][1]), ",")
    faults: list[str] = []
    results: list[Line] = []
    for number, line in lines:
        try:
            (cells,) = csv.reader([line], delimiter=separator, strict=True)
        except csv.Error as fault:
            faults.append(f"line {number} cannot be read: {fault}")
        else:
            results.append((number, [cell.strip() for cell in cells]))
    ValueFault.raise_for(faults, str(file))
    return results
