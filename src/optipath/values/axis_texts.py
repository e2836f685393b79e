"""Values of one parameter, as they are written and as they are run: ``"400 nm:700 nm:61"``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import OptipathError, ParameterError
from optipath.values.axis_names import AXES
from optipath.values.curves.csv_lines import first_of
from optipath.values.domains.axis import axes_for
from optipath.values.parameters import ABSENT
from optipath.values.ratios import NUMBER
from optipath.values.several_texts import file_of, several_texts
from optipath.values.units import BASE_UNITS, UNITS, dimension_of, in_unit, unit_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt

    from optipath.values.parameters import Parameter
    from optipath.values.use import Use

_NUMBER = re.compile(rf"[-+]?{NUMBER}", re.ASCII)


class AxisValues(NamedTuple):
    """The values of one parameter.

    Shapes: shown (count,); given (count,). Units: given in radians.
    """

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
    """Return the values that one text stands for; None for a text that is given alone.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> delta = Parameter("delta", unit="deg")
    >>> read_axis_text("0:180:3", delta, "deg").shown.tolist()
    [0.0, 90.0, 180.0]
    >>> print(read_axis_text("45 deg", delta))
    None
    """
    texts = several_texts(parameter, text)
    if texts is None:
        return None
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 3 and [parts[0], parts[1]] == [texts[0], texts[-1]]:
        _check_ends(parts, parameter, unit)
    try:
        return read_entries(texts, parameter, unit, uses)
    except OptipathError as fault:
        if (file := file_of(text)) is None:
            raise
        raise ParameterError(*[f"{file}: {sentence}" for sentence in fault.faults]) from None


def _check_ends(parts: Sequence[str], parameter: Parameter, unit: str) -> None:
    """Raise at the beginning of a range, where all is wrong with it that is wrong with a value."""
    if dimension_of(parameter.unit) and not unit and not unit_of(parts[0]):
        first, last, count = parts
        raise ParameterError(
            f"parameter '{parameter.name}': '{':'.join(parts)}' has no unit; write "
            f"'{first} {parameter.unit}:{last} {parameter.unit}:{count}' if it is in "
            f"{parameter.unit}"
        )
    parameter.parse(parts[0], unit)


def read_entries(
    entries: Sequence[Any], parameter: Parameter, unit: str = "", uses: Iterable[Use] = ()
) -> AxisValues:
    """Return values of which some are texts.

    Units: entries in radians.
    """
    uses = [*uses]
    found: list[_Entry] = []
    faults: list[str] = []
    for entry in entries:
        try:
            found.append(_read(entry, parameter, unit, uses))
        except OptipathError as fault:
            faults += fault.faults
    if faults:
        raise ParameterError(*first_of([*dict.fromkeys(faults)]))
    given = [each.given for each in found]
    numbers = np.array(given, object if ABSENT in given else None)
    if any(isinstance(each.shown, str) for each in found):
        return AxisValues(np.array([each.text for each in found]), "", numbers)
    unit = _common_unit(found, parameter)
    shown = [each.shown if each.unit == unit else in_unit(each.given, unit) for each in found]
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
    if all(each.unit == first for each in entries):
        return first
    known = UNITS.get(first)
    of_dimension = known is not None and known.dimension == dimension_of(parameter.unit)
    return first if of_dimension else parameter.unit
