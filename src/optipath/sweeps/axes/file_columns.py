"""Axes that stand in a file: a column for each parameter, whose cells are told by their lines."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from optipath.errors import OptipathError, ParameterError
from optipath.values.axis_texts import read_entries
from optipath.values.curves.csv_lines import first_of
from optipath.values.text_tables import missing_unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.axis_texts import AxisValues
    from optipath.values.inputs import Inputs
    from optipath.values.text_tables import TextColumn

_ENDLESS = re.compile(r"[-+]?(nan|inf|infinity)\b.*", re.IGNORECASE)


def read_column(inputs: Inputs, column: TextColumn) -> AxisValues:
    """Return the values of a column."""
    name = column.name
    if lacking := missing_unit(column, inputs.open[name]):
        raise ParameterError(f"{column.file}: {lacking}")
    try:
        return _read(inputs, name, column.texts)
    except OptipathError as fault:
        told = [
            f"line {line}: {sentence}"
            for line, text in zip(column.lines, column.texts, strict=True)
            for sentence in _faults(inputs, name, text)
        ] or [*fault.faults]
    raise ParameterError(*[f"{column.file}: {sentence}" for sentence in first_of(told)])


def _read(inputs: Inputs, name: str, texts: Sequence[str]) -> AxisValues:
    found = read_entries(texts, inputs.open[name], "", inputs.uses)
    inputs.numbers_for(name, found.given)  # Which looks at its range.
    return found


def _faults(inputs: Inputs, name: str, text: str) -> tuple[str, ...]:
    """Return what is wrong with a cell."""
    if _ENDLESS.fullmatch(text):
        return (f"parameter '{name}' is '{text}', which is not finite; write a number",)
    try:
        found = read_entries([text], inputs.open[name], "", inputs.uses)
        inputs.numbers_for(name, found.given[0])
    except OptipathError as fault:
        return fault.faults
    return ()
