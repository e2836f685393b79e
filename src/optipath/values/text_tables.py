"""Tables of texts: columns of a file of separated values, each with a name and a unit."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from optipath.errors import OptipathError, ParameterError, did_you_mean, listed
from optipath.values.commas import without_comma
from optipath.values.curves.csv_header import split_heading
from optipath.values.curves.csv_lines import first_of, lines_of
from optipath.values.given_files import given_file
from optipath.values.units import USUAL_UNITS, dimension_of, unit_of

if TYPE_CHECKING:
    from collections.abc import Collection
    from os import PathLike

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

    The first line has their names, a unit in parentheses or behind a line: ``delta (deg)``,
    ``delta [deg]``, ``delta_deg``; or each number has one. The unit ``(1)`` is none.
    Values are separated by commas, semicolons or tabulators; empty lines and those that begin with
    ``#`` are comments.
    """
    file = given_file(path, ParameterError)
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
    found = []
    for place, (name, unit) in enumerate(heads):
        texts = [_text(line, cells[place], unit, faults) for line, cells in rows]
        numbers = tuple([line for line, _ in rows])
        found.append(TextColumn(name, unit, tuple(texts), numbers, str(file)))
    if faults:
        raise ParameterError(*first_of(faults), about=str(file))
    return found


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
