"""Columns of numbers in files of separated values, with units in their headings."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import OptipathError, ParameterError, ValueFault, did_you_mean, listed, shown
from optipath.values.files import bytes_of, input_file
from optipath.values.units import (
    UNITS,
    USUAL_UNITS,
    dimension_of,
    displayed,
    parse_quantity,
    unit_of,
    units_of,
    without_comma,
)
from optipath.values.wavelength import LONGEST_FIRST, wavelength_of

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence
    from os import PathLike
    from pathlib import Path

    from optipath.values.parameters import Parameter


_NUMBER = re.compile(r"[-+]?\.?\d")

NO_UNIT = "1"
"""What stands for no unit, as the conventions for NetCDF (CF) write it."""


class TextColumn(NamedTuple):
    """A column of a file."""

    name: str
    unit: str
    texts: tuple[str, ...]
    lines: tuple[int, ...]
    file: str

    @property
    def lacks_units(self) -> bool:
        """Whether a number of it has no unit."""
        return any(_NUMBER.match(text) and not unit_of(text) for text in self.texts)


def columns_of(path: str | PathLike[str], known: Collection[str] = ()) -> list[TextColumn]:
    """Return the columns of a file.

    The first line has their names with units, ``delta (deg)``, ``delta [deg]`` or ``delta_deg``
    (``(1)`` is none), or each number has one. Values are separated by commas, semicolons or
    tabulators; ``#`` begins a comment.
    """
    file = input_file(path, ParameterError)
    lines = lines_of(file)
    if not lines:
        raise ParameterError("it is empty; write the names of columns, and lines", about=str(file))
    (number, header), *rows = lines
    faults = []
    if any(_NUMBER.match(cell) or not cell for cell in header):
        faults.append(
            f"line {number} has numbers or nothing for names of columns; begin with a line such as "
            f"'delta (deg), wavelength (nm)'"
        )
    elif not rows:
        faults.append(f"line {number} is the only one; write a line for each value behind it")
    faults += [
        f"line {line} has {len(cells)} values, and line {number} has {len(header)} names; "
        f"{_cure_of_count(cells, header)}"
        for line, cells in rows
        if len(cells) != len(header)
    ]
    faults += [f"line {line} has an empty cell; write a value" for line, c in rows if "" in c]
    heads = [(head, "") if head in known else _heading(head) for head in header]
    names = [name for name, _ in heads]
    twice = sorted({name for name in names if names.count(name) > 1})
    faults += [f"line {number} names '{name}' twice; keep one column" for name in twice]
    if faults:
        raise ParameterError(*first_of(faults), about=str(file))
    results = []
    for place, (name, unit) in enumerate(heads):
        texts = [_text(line, cells[place], unit, faults) for line, cells in rows]
        numbers = tuple([line for line, _ in rows])
        results.append(TextColumn(name, unit, tuple(texts), numbers, str(file)))
    if faults:
        raise ParameterError(*first_of(faults), about=str(file))
    return results


def column_for(parameter: Parameter, path: str) -> list[str]:
    """Return the texts of the column that is a parameter's: of its name, or the only one."""
    name = parameter.name
    columns = columns_of(path, [name])
    for column in columns:
        if column.name == name:
            return _with_units(column, parameter, path)
    names = [column.name for column in columns]
    if len(columns) > 1:
        why = f"of the columns {listed(names)}, none is called '{name}'{did_you_mean(name, names)}"
        raise ParameterError(why, about=path)
    if _is_value(parameter, names[0]):
        why = f"'{names[0]}' is the first line, which is a name; begin with the line '{name}'"
        raise ParameterError(why, about=path)
    return _with_units(columns[0], parameter, path)


def missing_unit(column: TextColumn, parameter: Parameter) -> str:
    """Return what is wrong with a column whose numbers need a unit and have none; else nothing."""
    if not (dimension := dimension_of(parameter.unit)) or not column.lacks_units:
        return ""
    return (
        f"column '{column.name}' has no unit; write its name as "
        f"'{column.name} ({USUAL_UNITS[dimension]})' if that is its unit"
    )


def _with_units(column: TextColumn, parameter: Parameter, path: str) -> list[str]:
    """Return the texts of a column, numbers with units where they need them."""
    if fault := missing_unit(column, parameter):
        raise ParameterError(fault, about=path)
    return [*column.texts]


def _is_value(parameter: Parameter, text: str) -> bool:
    try:
        parameter.parse(text)
    except OptipathError:
        return False
    return True


def _heading(head: str) -> tuple[str, str]:
    name, unit = split_heading(head)
    return name, "" if unit == NO_UNIT else unit


def _cure_of_count(cells: list[str], header: list[str]) -> str:
    """Return the cure for a line with too many values, or too few."""
    if len(cells) == 2 * len(header) and all(map(_NUMBER.match, cells)):
        pairs = zip(cells[::2], cells[1::2], strict=True)
        written = ",".join(f"{whole}.{behind}" for whole, behind in pairs)
        return f"write one for each, and points where commas are decimal: '{written}'"
    return "write one for each"


def _text(line: int, cell: str, unit: str, faults: list[str]) -> str:
    """Return what stands in a cell, a number with its unit."""
    if _NUMBER.match(cell) and "," in cell:
        cure = " or ".join(f"'{number}'" for number in without_comma(cell))
        faults.append(f"line {line}: '{cell}' has a comma; write {cure or 'a point alone'}")
        return cell
    own = unit_of(cell)
    if own and unit and own != unit:
        faults.append(f"line {line}: '{cell}' is not in {unit}, as the first line says; keep one")
    return f"{cell} {unit}" if unit and not own and _NUMBER.match(cell) else cell


Array: TypeAlias = "np.ndarray[Any, Any]"


@dataclass(frozen=True)
class CsvColumns:
    """What stands in a file. Shapes wavelengths (n,); columns (n,). Units wavelengths in metres."""

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

    As `columns_of`, with a wavelength or an energy first: ``wavelength (nm)``, ``wl [um]``,
    ``wavelength_nm``, ``energy (eV)``, or ``400 nm`` in each line. A second first line begins a
    second table of the same wavelengths, as files of refractiveindex.info have n and k.
    """
    file = input_file(path)
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
    result = _Rows({name: [] for name in names}, signs, number)
    for row in rows:
        result.read(row, at, of_axis, places, len(header))
    result.check_order(of_axis)
    if result.faults:
        raise ValueFault(*result.faults)
    return np.array(result.wavelengths), {name: np.array(v) for name, v in result.columns.items()}


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
    argument = f", unit='{unit}'" if unit else ""
    one = f"op.Spectrum.from_csv(path, column{argument}).at(op.Wavelength())"
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
            result = wavelength_of(text)
            result = parse_quantity(text, "length") if result is None else result  # type: ignore[assignment]
        except OptipathError as fault:
            self.faults += [each.under(f"line {line}") for each in fault.faults]
            return np.nan
        if not 0.0 < result < np.inf:  # type: ignore[operator]
            self.faults.append(f"line {line}: the wavelength is {cell}; give numbers above 0")
        return result  # type: ignore[return-value]

    def _number(self, line: int, name: str, cell: str) -> float:
        try:
            result = float(cell if _is_plain(cell) else "")
        except ValueError:
            wanted = "is empty" if not cell else f"is {shown(cell)}, which is no number"
            self.faults.append(f"line {line}: {name} {wanted}; write one, such as 1.5")
            return np.nan
        if not np.isfinite(result):
            self.faults.append(f"line {line}: {name} is {cell}; write a number, or leave it out")
        elif result < 0.0:
            other = f", {self.signs[name]}" if name in self.signs else ""
            self.faults.append(f"line {line}: {name} is {cell}; write none below 0{other}")
        return result

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
_CALLED = {dimension: name for name, dimension in reversed(_AXES.items())}

_SPELT = {"\u00b5m": "um", "\u03bcm": "um", "microns": "um", "micron": "um", "ev": "eV"}
_SPELT |= dict.fromkeys(("\u00c5", "\u212b", "A", "angstroms", "Angstrom"), "angstrom")
_SPECTRAL = ("eV", "meV", "keV", "1/cm", "cm^-1", "cm-1", "1/um", "1/mm", "1/m")
_FREQUENCIES = ("THz", "GHz", "PHz", "Hz")
_HEAD = re.compile(r"(.*?)\s*(?:\(([^()]*)\)|\[([^][]*)\])?")


def split_heading(head: str) -> tuple[str, str]:
    """Return what a column is called, and its unit; ``""`` for none.

    >>> split_heading("delta (deg)"), split_heading("wavelength_nm"), split_heading("n1")
    (('delta', 'deg'), ('wavelength', 'nm'), ('n1', ''))
    """
    match = _HEAD.fullmatch(head.strip())
    name, unit = (match[1], match[2] or match[3] or "") if match else (head, "")
    before, line, behind = name.rpartition("_")
    if not unit and line and (behind in UNITS or behind in _SPECTRAL or behind in _SPELT):
        name, unit = before, behind
    return name.strip(), _SPELT.get(unit.strip(), unit.strip())


def _name_and_unit(head: str) -> tuple[str, str]:
    """Return what a column is called, in small letters, and its unit."""
    name, unit = split_heading(head)
    return name.lower(), unit


def axis_of(
    number: int,
    header: list[str],
    unit: str,
    faults: list[str],
    *,
    names: Sequence[str] = (),
    rows: Sequence[Sequence[str]] = (),
) -> tuple[int, str]:
    """Return which column has the wavelengths, and in which unit."""
    heads = [_name_and_unit(head) for head in header]
    results = [place for place, (name, _) in enumerate(heads) if name in _AXES]
    if not results:
        if has_numbers(header):
            what = f"line {number} has numbers, and no names of columns"
        else:
            what = f"line {number} names no column of wavelengths, but {listed(header)}"
        faults.append(
            f"{what}; begin with a line such as '{', '.join(['wavelength (nm)', *names])}'"
        )
        return 0, ""
    if len(results) > 1:
        both = listed([f"'{header[place]}'" for place in results])
        faults.append(f"line {number} has {both}; keep one of them")
        return 0, ""
    name, own = heads[results[0]]
    dimension = _AXES[name]
    units = {
        "length": units_of("length"),
        "photon energy": [*_SPECTRAL[:3]],
        "wave number": [*_SPECTRAL[3:]],
        "frequency": [*_FREQUENCIES],
    }
    known = units[dimension]
    if own and unit and own != _SPELT.get(unit, unit):
        faults.append(f"line {number} has the unit {own}, and unit='{unit}' is given; leave it out")
    own = own or _SPELT.get(unit, unit)
    cells = [row[results[0]] for row in rows if len(row) > results[0]]
    if not own and cells and unit_of(cells[0]):
        return results[0], ""
    other = next((_CALLED[one] for one, those in units.items() if own in those), name)
    if not own:
        likely = "um" if dimension == "length" and _in_micrometres(cells) else known[0]
        faults.append(
            f"line {number}: '{name}' has no unit; write '{name} ({likely})', or give "
            f"unit='{likely}'"
        )
    elif own not in known and other != name:
        faults.append(
            f"line {number}: '{own}' is no unit of '{name}', but of '{other}'; write "
            f"'{other} ({own})'"
        )
    elif own not in known:
        faults.append(
            f"line {number}: the unit '{own}' of '{name}' is unknown{did_you_mean(own, known)}"
        )
    return results[0], own


def _in_micrometres(cells: Sequence[str]) -> bool:
    """Tell whether all numbers are such as wavelengths of light have in micrometres."""
    try:
        return bool(cells) and all(0.1 <= float(cell) <= 30.0 for cell in cells)
    except ValueError:
        return False


def is_header(cells: Sequence[str]) -> bool:
    """Tell whether a line names a column of wavelengths.

    >>> is_header(["wl", "k"]), is_header(["0.5", "1.2"])
    (True, False)
    """
    return any(_name_and_unit(cell)[0] in _AXES for cell in cells)


def names_in(header: Sequence[str], names: Sequence[str]) -> list[str]:
    """Return those of some names that a first line has.

    >>> names_in(["wl (um)", "N"], ["n", "k"])
    ['n']
    """
    heads = [_name_and_unit(head)[0] for head in header]
    return [name for name in names if name.lower() in heads]


def places_of(
    number: int,
    header: list[str],
    names: Sequence[str],
    cures: Mapping[str, str],
    faults: list[str],
) -> dict[str, int]:
    """Return which columns have the numbers that are asked for."""
    heads = [_name_and_unit(head)[0] for head in header]
    results = {}
    for name in names:
        places = [place for place, head in enumerate(heads) if head == name.lower()]
        if len(places) == 1:
            results[name] = places[0]
        elif places:
            faults.append(f"line {number} has {len(places)} columns '{name}'; keep one")
        else:
            others = [head for head in heads if head not in _AXES]
            cure = f"; or {cures[name]}" if name in cures else ""
            meant = did_you_mean(name, others) if others else ""
            faults.append(f"line {number} names no column '{name}'{meant}{cure}")
    return results


def has_numbers(header: list[str]) -> bool:
    """Tell whether a first line has numbers alone, and no names.

    >>> has_numbers(["500", "1.5"]), has_numbers(["wavelength (nm)", "n"])
    (True, False)
    """
    try:
        return bool([float(cell) for cell in header])
    except ValueError:
        return False


Line: TypeAlias = tuple[int, list[str]]
"""Its number, and what stands in it."""

_MOST_REPORTED = 12


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
    results = [(number, _cells(number, line, separator, faults)) for number, line in lines]
    if faults:
        raise ValueFault(*first_of(faults), about=str(file))
    return results


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
    more = len(faults) - _MOST_REPORTED
    return [*faults[:_MOST_REPORTED], *[f"and {more} more"] * (more > 0)]


_DOUBTS = {"um": (100e-6, np.inf, "nm"), "nm": (0.0, 10e-9, "um")}
"""Between which metres wavelengths of a table in a unit are doubted, and what is meant: 100 to 1000
is light in nm, 0.1 to 10 in um; tables in eV, THz and 1/cm may well be X-rays or far infrared."""


def unit_doubted(metres: Sequence[float], unit: str) -> str:
    """Return why the unit of a table of wavelengths is most likely another one, if it is.

    >>> print(unit_doubted([400e-6, 500e-6], "um"))  # doctest: +NORMALIZE_WHITESPACE
    the wavelengths are 400 um .. 500 um, which are most likely nm; give the unit nm, or, where
    they are meant, each with its unit, such as '400 um'
    >>> unit_doubted([0.4e-6, 0.5e-6], "um")
    ''
    """
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
