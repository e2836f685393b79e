"""One text for several values: a range, a list, or a column of a file."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from optipath.errors import OptipathError, ParameterError, UnitError
from optipath.values.commas import without_comma
from optipath.values.counted_ranges import texts_of_range
from optipath.values.ratios import ratio_of
from optipath.values.text_tables import column_for
from optipath.values.units import dimension_of

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter

_FILE = "@"
_THOUSANDS = re.compile(r"0\d\d(?:\D.*)?", re.ASCII)


def several_texts(parameter: Parameter, text: str) -> list[str] | None:
    """Return the texts of several values that one text stands for.

    Examples
    --------
    >>> from optipath.values.parameters import Parameter
    >>> delta = Parameter("delta", unit="deg")
    >>> several_texts(delta, "0:30:4"), several_texts(delta, "10 deg, 0.5 rad")
    (['0', '10.0', '20.0', '30'], ['10 deg', '0.5 rad'])
    >>> several_texts(delta, "30 deg")
    """
    text = text.strip()
    if (file := file_of(text)) is not None:
        try:
            return column_for(parameter, file)
        except OptipathError as fault:
            about = f"{fault.about}: " if fault.about else ""
            raise ParameterError(*[f"{about}{sentence}" for sentence in fault.faults]) from None
    try:
        if _is_range(parameter, text):
            return texts_of_range(text)
        return _listed(text) if "," in text else None
    except UnitError as fault:
        told = [f"parameter '{parameter.name}': {sentence}" for sentence in fault.faults]
        raise ParameterError(*told) from None


def file_of(text: str) -> str | None:
    """Return the file of which a text means a column; None where it means none.

    Examples
    --------
    >>> file_of("@angles.csv"), file_of("30 deg")
    ('angles.csv', None)
    """
    text = text.strip()
    return text.removeprefix(_FILE).strip() if text.startswith(_FILE) else None


def _is_range(parameter: Parameter, text: str) -> bool:
    """Tell whether a text has the colons of a range, and is neither a ratio nor a list of these."""
    listed = "," in text and not without_comma(text.partition(":")[0].strip())
    if ":" not in text or listed:
        return False
    return text.count(":") > 1 or bool(dimension_of(parameter.unit)) or not _is_ratio(text)


def _is_ratio(text: str) -> bool:
    """Tell whether a text with one colon is a ratio to 1; ask where it may lack a count."""
    try:
        ratio = ratio_of(text)
    except UnitError:
        return False
    if any(float(part) == 1.0 for part in text.split(":")):
        return True
    raise UnitError(
        f"'{text}' may be the ratio {ratio:.12g}, or a range that does not say how many values "
        f"there are; write '{ratio:.12g}', or '{text}:11' for eleven"
    )


def _listed(text: str) -> list[str]:
    parts = [part.strip() for part in text.split(",")]
    if meant := without_comma(text):
        numbers = " or ".join(f"'{number}'" for number in meant)
        raise UnitError(
            f"'{text}' may be a number with a comma, or two; write {numbers} for one, and "
            f"'{', '.join(_in_one_unit(parts))}' for two"
        )
    if not all(parts):
        raise UnitError(f"'{text}' has nothing between two commas, or at an end; leave these out")
    if ranges := [part for part in parts if part.count(":") > 1]:
        raise UnitError(f"'{ranges[0]}' is in a list, and a range stands alone; write its values")
    if thousands := [part for part in parts[1:] if _THOUSANDS.fullmatch(part)]:
        raise UnitError(
            f"'{thousands[0]}' of '{text}' may be thousands of the number in front; write that "
            f"without commas, or '{thousands[0].lstrip('0') or '0'}' in a list"
        )
    return parts


def _in_one_unit(parts: list[str]) -> list[str]:
    """Return the two numbers around a comma, where the unit stands behind the second alone."""
    unit = parts[1].lstrip("+-.eE0123456789")
    return [f"{parts[0]} {unit.strip()}".strip(), parts[1]]
