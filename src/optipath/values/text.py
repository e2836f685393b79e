"""Texts for several values: ranges such as "0:90:91", lists and columns."""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import OptipathError, ParameterError, UnitError
from optipath.faults import shown
from optipath.values.columns import column_for
from optipath.values.parameters import ABSENT, AXES
from optipath.values.units import (
    BASE_UNITS,
    NUMBER,
    dimension_of,
    in_unit,
    ratio_of,
    unit_of,
    units_of,
)
from optipath.values.use import axes_for

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt

    from optipath.values.parameters import Parameter
    from optipath.values.use import Use


_NUMBER = re.compile(rf"[-+]?{NUMBER}", re.ASCII)


class AxisValues(NamedTuple):
    """Values of a parameter: shown (count,) texts, given (count,) in radians."""

    shown: npt.NDArray[Any]
    unit: str
    given: npt.NDArray[Any]

    def reshaped(self, shape: tuple[int, ...]) -> AxisValues:
        """Return the same values in another shape."""
        return AxisValues(self.shown.reshape(shape), self.unit, self.given.reshape(shape))


class IdleValues(AxisValues):
    """The values of an axis on which nothing depends: all is the same along it."""


class _Entry(NamedTuple):
    """One value: what was written, its number in its unit, and that in base units."""

    text: str
    shown: Any
    unit: str
    given: Any


def read_axis_text(
    text: str, parameter: Parameter, unit: str = "", uses: Iterable[Use] = ()
) -> AxisValues | None:
    """Return the values that one text stands for; None for a text that is given alone."""
    texts = several_texts(parameter, text)
    if texts is None:
        return None
    if ":" in text and len(texts) > 1:
        parameter.parse(texts[0], unit)  # What is wrong with the first is wrong with all.
    with ParameterError.wrapping(column_file(text) or ""):
        return read_entries(texts, parameter, unit, uses)


def read_entries(
    entries: Sequence[Any], parameter: Parameter, unit: str = "", uses: Iterable[Use] = ()
) -> AxisValues:
    """Return values of which some are texts. Units: entries in radians."""
    uses = [*uses]
    results: list[_Entry] = []
    faults: list[str] = []
    for entry in entries:
        with OptipathError.collecting(faults):
            results.append(_read(entry, parameter, unit, uses))
    ParameterError.raise_for(faults)
    arguments = [each.given for each in results]
    numbers = np.array(arguments, object if ABSENT in arguments else None)
    if any(isinstance(each.shown, str) for each in results):
        return AxisValues(np.array([each.text for each in results]), "", numbers)
    unit = _common_unit(results, parameter)
    shown = [each.shown if each.unit == unit else in_unit(each.given, unit) for each in results]
    return AxisValues(np.array(shown), unit, numbers)


def _read(entry: Any, parameter: Parameter, unit: str, uses: Sequence[Use]) -> _Entry:
    base = BASE_UNITS.get(dimension_of(parameter.unit), "")
    if not isinstance(entry, str):
        number = parameter.resolve(entry).value[()]
        return _Entry(f"{number!s} {base}".strip(), number, base, number)
    text = entry.strip()
    value = axes_for(parameter.name, text, uses)
    if text in AXES and not isinstance(value, str):
        return _Entry(text, text, "", value)
    value = parameter.parse(text, unit)
    if isinstance(value, str):
        return _Entry(text, text, "", parameter.words.get(value, value))
    if not base:
        return _Entry(text, value, "", value)
    own = unit_of(text)
    written = _NUMBER.match(text)
    shown = float(written[0]) if written else value
    return _Entry(text if own else f"{text} {unit}", shown, own or unit, value)


def _common_unit(entries: Sequence[_Entry], parameter: Parameter) -> str:
    """Return the unit of the first; that of the parameter for photon energies among lengths."""
    first = entries[0].unit
    if first in units_of(dimension_of(parameter.unit)):
        return first
    return first if all(each.unit == first for each in entries) else parameter.unit


_FILE = "@"
_COMMA = re.compile(r"([-+]?\d+),(\d+)((?![eE][-+\d])[^\d,.][^,]*)?", re.ASCII)


def several_texts(parameter: Parameter, text: str) -> list[str] | None:
    """Return the texts of several values that one text stands for.

    >>> from optipath.values.parameters import Parameter
    >>> delta = Parameter("delta", unit="deg")
    >>> several_texts(delta, "0:30:4"), several_texts(delta, "10 deg, 0.5 rad")
    (['0', '10.0', '20.0', '30'], ['10 deg', '0.5 rad'])
    >>> several_texts(delta, "30 deg")
    """
    text = text.strip()
    if (file := column_file(text)) is not None:
        with ParameterError.wrapping():
            return column_for(parameter, file)
    with ParameterError.wrapping(parameter.called):
        if "," not in text:
            return texts_of_range(text) if ":" in text and not _is_ratio(parameter, text) else None
        parts = _listed(text)
        for part in parts:
            if ":" in part:
                _is_ratio(parameter, part)
        return parts


def _listed(text: str) -> list[str]:
    """Return the parts between commas; ask where one may be a decimal point."""
    if (match := _COMMA.fullmatch(text)) is not None:
        one, other, unit = match.groups("")
        raise UnitError(
            f"'{text}' may be a number with a comma, or two; write '{one}.{other}{unit}' for one, "
            f"and '{one}{unit}, {other}{unit}' for two"
        )
    return [part.strip() for part in text.split(",")]


def column_file(text: str) -> str | None:
    """Return the file of which a text means a column; None where it means none."""
    text = text.strip()
    return text.removeprefix(_FILE).strip() if text.startswith(_FILE) else None


def _is_ratio(parameter: Parameter, text: str) -> bool:
    """Tell whether a text with colons is a ratio to 1; ask where it may lack a count."""
    if text.count(":") > 1 or dimension_of(parameter.unit):
        return False
    ratio = ratio_of(text)
    if any(float(part) == 1.0 for part in text.split(":")):
        return True
    raise UnitError(
        f"'{text}' may be the ratio {ratio:.12g}, or a range that does not say how many values "
        f"there are; write '{ratio:.12g}', or '{text}:11' for eleven"
    )


MOST_WRITTEN = 1_000_000
"""How many values a text may stand for; more are given as an array."""

_FORM = "write start:stop:count, such as '400 nm:700 nm:61'"
_END = re.compile(rf"([-+]?{NUMBER})\s*((?:1/)?[^\W\d_].*|[°'\"])?")
_COUNT = re.compile(r"\+?\d{1,18}", re.ASCII)
_LONGEST, _LEAST, _LARGEST = 100, -330, 309
"""How many characters an end may have, and which powers of ten floats have."""


def texts_of_range(text: str) -> list[str]:
    """Return the values of a range, each as somebody would write it.

    Evenly spaced in the unit of the ends, and rounded once.

    >>> texts_of_range("0:1:5")
    ['0', '0.25', '0.5', '0.75', '1']
    >>> texts_of_range("700 nm:400 nm:4")
    ['700 nm', '600.0 nm', '500.0 nm', '400 nm']
    """
    parts = [part.strip() for part in text.split(":")]
    if len(parts) != 3:
        raise UnitError(f"{shown(text)} is no range; {_FORM}")
    first, last, counted = parts
    (start, unit), (stop, other) = _end(text, first), _end(text, last)
    if unit != other:
        raise UnitError(f"the ends of '{text}' differ in their units; write both in one unit")
    count = int(counted) if _COUNT.fullmatch(counted) else 0
    if count < 1 or (count == 1 and start != stop):
        raise UnitError(f"'{counted}' of '{text}' is no count of values; {_FORM}")
    if count > MOST_WRITTEN:
        raise UnitError(
            f"'{text}' counts {count} values, and a text stands for {MOST_WRITTEN} at most; give "
            f"fewer, or an array in Python"
        )
    if count == 1:
        return [first]
    steps = count - 1
    denominator = start.denominator * stop.denominator * steps
    begin = start.numerator * stop.denominator * steps
    rise = stop.numerator * start.denominator - start.numerator * stop.denominator
    behind = f" {unit}" if unit else ""
    # The quotient of two integers is the float next to it.
    inner = [f"{(begin + rise * at) / denominator}{behind}" for at in range(1, steps)]
    return [first, *inner, last]


def _end(text: str, end: str) -> tuple[Fraction, str]:
    """Return the number and the unit of an end of a range."""
    match = _END.fullmatch(end) if len(end) <= _LONGEST else None
    # Fractions of what is beyond floats would be endless.
    if match and (not (number := Decimal(match[1])) or _LEAST < number.adjusted() < _LARGEST):
        return Fraction(match[1]) if number else Fraction(0), match[2] or ""
    raise UnitError(f"{shown(end)} of {shown(text)} is no number with a unit; {_FORM}")
