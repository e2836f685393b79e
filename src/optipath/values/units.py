"""Units: quantities as texts such as "30 deg", read and written exactly.

Base units are radians, metres and teslas, also of what is given per length and field.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import NamedTuple

from optipath.errors import UnitError
from optipath.faults import did_you_mean, shown

# Written so that no text matches in two ways, and long ones take no longer than they are.
NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d{1,9})?"
"""The pattern of a number without a sign."""


class Unit(NamedTuple):
    """A unit: so many base units, times ten to a power."""

    dimension: str
    power: int = 0
    size: float = 1.0


_ANGLES = {
    "deg": Unit("angle", size=math.pi / 180.0),
    "rad": Unit("angle"),
    "mrad": Unit("angle", -3),
    "arcmin": Unit("angle", size=math.pi / 10800.0),
    "arcsec": Unit("angle", size=math.pi / 648000.0),
}
_LENGTHS = {"nm": -9, "um": -6, "mm": -3, "cm": -2, "dm": -1, "m": 0, "angstrom": -10}
_PER_LENGTH = ("um", "mm", "cm", "dm", "m")

UNITS: dict[str, Unit] = {
    **_ANGLES,
    **{length: Unit("length", power) for length, power in _LENGTHS.items()},
    **{f"1/{length}": Unit("inverse length", -_LENGTHS[length]) for length in _PER_LENGTH},
    **{
        f"{angle}/{length}": Unit("angle per length", -_LENGTHS[length], _ANGLES[angle].size)
        for angle in ("deg", "rad")
        for length in _PER_LENGTH
    },
    "T": Unit("magnetic field"),
    "mT": Unit("magnetic field", -3),
    "G": Unit("magnetic field", -4),
    "kG": Unit("magnetic field", -1),
    "rad/(T m)": Unit("Verdet constant"),
    "deg/(T cm)": Unit("Verdet constant", 2, _ANGLES["deg"].size),
    "arcmin/(G cm)": Unit("Verdet constant", 6, _ANGLES["arcmin"].size),
}

USUAL_UNITS = {
    "angle": "deg",
    "length": "nm",
    "inverse length": "1/cm",
    "angle per length": "deg/mm",
    "magnetic field": "T",
    "Verdet constant": "rad/(T m)",
    "": "",
}
"""The unit in which a dimension is written where nobody says another."""

BASE_UNITS = {
    "angle": "rad",
    "length": "m",
    "inverse length": "1/m",
    "angle per length": "rad/m",
    "magnetic field": "T",
    "Verdet constant": "rad/(T m)",
}

_QUANTITY = re.compile(rf"([-+]?{NUMBER})\s*(.*)", re.ASCII)
_COMPLEX = re.compile(rf"(?:[-+]?{NUMBER}(?=[-+]))?[-+]?{NUMBER}j", re.ASCII)
_LIKE_A_UNIT = re.compile(r"(?:1/)?[^\W\d_][^:,;]*|[°%'\"]")
_SIGN_BETWEEN = re.compile(r"(?<!\s)\s*([-+])\s*")
_LONGEST = 2000
"""How many characters a quantity may have; no float needs more than 1100, all zeros written."""

_DIGITS = (15, 16, 17)
"""How many digits a number is written with: the fewest that give it back."""

_NOTHING = Unit("")


def dimension_of(unit: str) -> str:
    """Return the dimension of a unit, such as ``"angle"``; ``""`` for no unit."""
    if isinstance(unit, str) and (not unit or unit in UNITS):
        return UNITS[unit].dimension if unit else ""
    word = unit if isinstance(unit, str) else shown(unit)
    raise UnitError(f"unit '{word}' is unknown{did_you_mean(word, UNITS)}")


def units_of(dimension: str) -> list[str]:
    """Return the units of a dimension, such as ``"angle"``."""
    return [name for name, known in UNITS.items() if known.dimension == dimension]


def unit_of(text: str) -> str:
    """Return the unit that a text has, known or not; ``""`` for none."""
    match = _QUANTITY.fullmatch(text.strip()[:_LONGEST])
    return match[2] if match and _LIKE_A_UNIT.fullmatch(match[2]) else ""


def parse_quantity(text: str, dimension: str, default_unit: str = "") -> float | complex:
    """Return the number that a text such as ``"30 deg"`` stands for.

    >>> parse_quantity("180 deg", "angle")
    3.141592653589793
    >>> parse_quantity("20 um", "length"), parse_quantity("(0.3 - 0.4j)", "")
    (2e-05, (0.3-0.4j))
    """
    text = text.strip()
    if len(text) > _LONGEST:
        raise UnitError(f"{shown(text)} has {len(text)} characters; no number needs as many")
    if not dimension and (number := _pure(text)) is not None:
        return number
    match = _QUANTITY.fullmatch(text)
    if match is None or (match[2] and not _LIKE_A_UNIT.fullmatch(match[2])):
        example = f"'30 {USUAL_UNITS[dimension]}'" if dimension else "'1.5' or '0.3+0.4j'"
        raise UnitError(f"'{text}' is not a quantity; write a number such as {example}")
    unit = match[2] or default_unit
    known = UNITS.get(unit) if unit else _NOTHING
    if known is None or known.dimension != dimension:
        raise UnitError(_mismatch(text, unit, dimension))
    return _in_base_units(match[1], known)


def in_unit(value: float, unit: str) -> float:
    """Return a number in base units in another unit, without the noise of conversion.

    >>> in_unit(0.8377580409572782, "deg")
    48.0
    >>> in_unit(2e-05, "mm")
    0.02
    """
    return float(_written(float(value), UNITS[unit])[0]) if unit else float(value)


def format_quantity(value: complex, unit: str) -> str:
    """Write a number in base units so that reading it gives the very same number back.

    >>> format_quantity(0.8377580409572782, "deg"), format_quantity(1.33, "")
    ('48 deg', '1.33')
    >>> format_quantity(0.3 - 0.4j, "")
    '0.3-0.4j'
    """
    if isinstance(value, complex):
        return str(value).strip("()")
    if unit == "":
        return _plainly(value)
    value, of_unit = float(value), UNITS[unit]
    if not math.isfinite(value):
        return f"{value!r} {unit}"
    number, is_exact = _written(value, of_unit)
    return f"{number} {unit}" if is_exact else f"{value!r} {BASE_UNITS[of_unit.dimension]}"


def with_article(dimension: str) -> str:
    """Return the name of a dimension for a sentence."""
    return f"{'an' if dimension[:1] in 'aeiou' else 'a'} {dimension}"


def _in_base_units(number: str, unit: Unit) -> float:
    if not math.isfinite(float(number)):
        return float(number)
    mantissa, _, exponent = number.lower().partition("e")
    return float(f"{mantissa}e{int(exponent or 0) + unit.power}") * unit.size


def _written(value: float, unit: Unit) -> tuple[str, bool]:
    """Return the number that a value is in a unit, and whether reading it gives the value back."""
    first = ""
    for digits in _DIGITS if unit.size != 1.0 else [0]:
        number = f"{value / unit.size:.{digits}g}" if digits else repr(value)
        moved = Decimal(number).scaleb(-unit.power)
        for text in (_plainly(moved), str(moved)):
            if _in_base_units(text, unit) == value:
                return text, True
            first = first or text
    return first, False


def _plainly(number: Decimal | float) -> str:
    return repr(float(number)).removesuffix(".0")


def _pure(text: str) -> float | complex | None:
    """Return the ratio or the complex number that a text stands for; None where it is neither."""
    if (ratio := ratio_of(text)) is not None:
        return ratio
    number = text[1:-1].strip() if text.startswith("(") and text.endswith(")") else text
    number = _SIGN_BETWEEN.sub(r"\1", number)
    return complex(number) if _COMPLEX.fullmatch(number) else None


def _mismatch(text: str, unit: str, dimension: str) -> str:
    """Return the sentence for a unit that is missing, unknown, or of another dimension."""
    if not dimension:
        return f"'{text}' has the unit '{unit}', but a pure number is asked for"
    units = units_of(dimension)
    if not unit:
        request = with_article(dimension)
        return f"'{text}' has no unit, but {request} is asked for; add one of {', '.join(units)}"
    if unit not in UNITS:
        return f"unit '{unit}' of '{text}' is unknown{did_you_mean(unit, units)}"
    return f"'{text}' is no {dimension}; use one of {', '.join(units)}"


def displayed(value: float, unit: str) -> str:
    """Write a number in base units with another unit, to 15 digits."""
    return f"{in_unit(value, unit):.15g} {unit}".strip()


def format_range(low: float, high: float, unit: str) -> str:
    """Write the limits of a range in base units, or nothing where there are none.

    >>> format_range(0.0, 0.5, "mm"), format_range(0.0, math.inf, "")
    ('0 mm .. 500 mm', '0 or more')
    """
    least, most = (_limit(end, low, high, unit) for end in (low, high))
    if math.isinf(low):
        return "" if math.isinf(high) else f"{most} or less"
    return f"{least} or more" if math.isinf(high) else f"{least} .. {most}"


def _limit(end: float, low: float, high: float, unit: str) -> str:
    """Write an end of a range so that it is in the range when it is read."""
    if math.isfinite(end):
        short = displayed(end, unit)
        number = parse_quantity(short, dimension_of(unit))
        if isinstance(number, float) and low <= number <= high:
            return short
    return format_quantity(end, unit)


INFINITE = "inf"
"""What is written for a ratio without end."""

_RATIO = re.compile(rf"({NUMBER})\s*:\s*({NUMBER})", re.ASCII)


def ratio_of(text: str) -> float | None:
    """Return the number that a ratio is, or None for a text that is none.

    >>> ratio_of("1000:1"), ratio_of("inf"), ratio_of("20")
    (1000.0, inf, None)
    """
    if text == INFINITE:
        return math.inf
    if ":" not in text:
        return None
    match = _RATIO.fullmatch(text)
    wanted, other = map(float, match.groups()) if match else (0.0, 0.0)
    ratio = wanted / other if other else 0.0
    if 0.0 < ratio < math.inf:
        return ratio
    raise UnitError(f"'{text}' is no ratio of two positive numbers; write one such as '1000:1'")
