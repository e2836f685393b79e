"""Quantities with units, as they stand in files and on the command line.

Inside the library an angle is in radians and a length in metres, and so is what is given per
length.
"""

from __future__ import annotations

import math
import re

from optipath.errors import UnitError, did_you_mean

_ANGLES = {
    "deg": math.pi / 180.0,
    "rad": 1.0,
    "mrad": 1e-3,
    "arcmin": math.pi / 10800.0,
    "arcsec": math.pi / 648000.0,
}
_LENGTHS = {"nm": 1e-9, "um": 1e-6, "mm": 1e-3, "cm": 1e-2, "dm": 1e-1, "m": 1.0}
_PER_METRE = {"um": 1e6, "mm": 1e3, "cm": 1e2, "dm": 10.0, "m": 1.0}
"""How many of a length a metre has; reciprocals of the sizes above would be rounded."""

UNITS: dict[str, tuple[str, float]] = {
    **{unit: ("angle", size) for unit, size in _ANGLES.items()},
    **{unit: ("length", size) for unit, size in _LENGTHS.items()},
    **{f"1/{length}": ("inverse length", count) for length, count in _PER_METRE.items()},
    **{
        f"{angle}/{length}": ("angle per length", _ANGLES[angle] * count)
        for angle in ("deg", "rad")
        for length, count in _PER_METRE.items()
    },
}

USUAL_UNITS = {
    "angle": "deg",
    "length": "nm",
    "inverse length": "1/cm",
    "angle per length": "deg/mm",
    "": "",
}
"""The unit in which a dimension is written where nobody says another."""

_BASE_UNITS = {"angle": "rad", "length": "m", "inverse length": "1/m", "angle per length": "rad/m"}

_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*", re.ASCII)


def dimension_of(unit: str) -> str:
    """Return the dimension of a unit, such as ``"angle"``; ``""`` for no unit.

    Raises
    ------
    UnitError
        If the unit is unknown.

    Examples
    --------
    >>> dimension_of("deg"), dimension_of("1/cm"), dimension_of("")
    ('angle', 'inverse length', '')
    """
    if unit == "":
        return ""
    if not isinstance(unit, str) or unit not in UNITS:
        raise UnitError(f"unit '{unit}' is unknown{did_you_mean(unit, UNITS)}")
    return UNITS[unit][0]


def parse_quantity(text: str, dimension: str, default_unit: str = "") -> float:
    """Return the number that a text such as ``"30 deg"`` stands for.

    Parameters
    ----------
    text : str
        A number and its unit.
    dimension : str
        The dimension asked for: ``"angle"``, ``"length"``, ``"inverse length"``, ``"angle per
        length"``, or ``""``.
    default_unit : str, optional
        The unit of a bare number; without one, a bare number is accepted only
        where there is no dimension.

    Returns
    -------
    float
        Radians, metres, what of them there is per metre, or a pure number.

    Raises
    ------
    UnitError
        If the text is no number, or its unit is missing, unknown or of another dimension.

    Examples
    --------
    >>> parse_quantity("180 deg", "angle")
    3.141592653589793
    """
    match = _QUANTITY.fullmatch(text)
    if match is None:
        example = f"30 {USUAL_UNITS[dimension]}".strip()
        raise UnitError(f"'{text}' is not a quantity; write a number such as '{example}'")
    number, unit = float(match[1]), match[2] or default_unit
    found = dimension_of(unit)
    if found != dimension:
        raise UnitError(_mismatch(text, unit, dimension))
    return number * UNITS[unit][1] if unit else number


def in_unit(value: float, unit: str) -> float:
    """Return a number in base units in another unit, without the noise of conversion.

    Examples
    --------
    >>> in_unit(0.8377580409572782, "deg")
    48.0
    """
    if unit == "":
        return float(value)
    size = UNITS[unit][1]
    value = float(value)
    rounded = float(f"{value / size:.13g}")
    return rounded if rounded * size == value else value / size


def format_quantity(value: float, unit: str) -> str:
    """Write a number with a unit so that reading it gives the very same number back.

    Examples
    --------
    >>> format_quantity(0.8377580409572782, "deg"), format_quantity(1.33, "")
    ('48 deg', '1.33')
    """
    if unit == "":
        return repr(float(value)).removesuffix(".0")
    dimension, size = UNITS[unit]
    number = in_unit(value, unit)
    if number * size == value:
        return f"{repr(number).removesuffix('.0')} {unit}"
    return f"{float(value)!r} {_BASE_UNITS[dimension]}"


def with_article(dimension: str) -> str:
    """Return the name of a dimension for a sentence.

    Examples
    --------
    >>> with_article("length"), with_article("angle per length")
    ('a length', 'an angle per length')
    """
    return f"{'an' if dimension[:1] in 'aeiou' else 'a'} {dimension}"


def _mismatch(text: str, unit: str, dimension: str) -> str:
    units = ", ".join(name for name, (found, _) in UNITS.items() if found == dimension)
    if not dimension:
        return f"'{text}' has the unit '{unit}', but a pure number is asked for; leave it out"
    if not unit:
        asked = with_article(dimension)
        return f"'{text}' has no unit, but {asked} is asked for; add one of {units}"
    return f"'{text}' is no {dimension}; use one of {units}"
