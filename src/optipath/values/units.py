"""Units: quantities as texts such as "30 deg", read and written exactly.

Base units are radians, metres and teslas, also of what is given per length and field.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import TYPE_CHECKING, NamedTuple

from optipath.errors import UnitError, did_you_mean, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

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
    """Return the dimension of a unit, such as ``"angle"``; ``""`` for no unit.

    >>> dimension_of("deg"), dimension_of("1/cm"), dimension_of("")
    ('angle', 'inverse length', '')
    """
    if isinstance(unit, str) and unit == "":
        return ""
    if not isinstance(unit, str) or unit not in UNITS:
        word = unit if isinstance(unit, str) else shown(unit)
        raise UnitError(f"unit '{word}' is unknown{unit_meant(word, UNITS)}")
    return UNITS[unit].dimension


def units_of(dimension: str) -> list[str]:
    """Return the units of a dimension, such as ``"angle"``."""
    return [name for name, known in UNITS.items() if known.dimension == dimension]


def unit_of(text: str) -> str:
    """Return the unit that a text has, known or not; ``""`` for none, and for what is no quantity.

    >>> unit_of("30 deg"), unit_of("0.5"), unit_of("horizontal")
    ('deg', '', '')
    """
    match = _QUANTITY.fullmatch(_per_length(text) or text.strip()[:_LONGEST])
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
        if meant := comma_cure(text):
            raise UnitError(f"'{text}' is not a quantity; {meant}")
        if meant := _respelt(text, dimension):
            raise UnitError(f"'{text}' is not a quantity; did you mean '{meant}'?")
        example = f"'30 {USUAL_UNITS[dimension]}'" if dimension else "'1.5' or '0.3+0.4j'"
        raise UnitError(f"'{text}' is not a quantity; write a number such as {example}")
    unit = match[2] or default_unit
    known = UNITS.get(unit) if unit else _NOTHING
    if known is None or known.dimension != dimension:
        raise UnitError(_mismatch(text, match[1], unit, dimension))
    return _in_base_units(match[1], known)


def in_unit(value: float, unit: str) -> float:
    """Return a number in base units in another unit, without the noise of conversion.

    >>> in_unit(0.8377580409572782, "deg")
    48.0
    >>> in_unit(2e-05, "mm")
    0.02
    """
    return float(_candidates(float(value), UNITS[unit])[0]) if unit else float(value)


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
        return repr(float(value)).removesuffix(".0")
    value, of_unit = float(value), UNITS[unit]
    if not math.isfinite(value):
        return f"{value!r} {unit}"
    for number in _candidates(value, of_unit):
        if _in_base_units(number, of_unit) == value:
            return f"{number} {unit}"
    return f"{value!r} {BASE_UNITS[of_unit.dimension]}"


def with_article(dimension: str) -> str:
    """Return the name of a dimension for a sentence.

    >>> with_article("length"), with_article("angle per length")
    ('a length', 'an angle per length')
    """
    return f"{'an' if dimension[:1] in 'aeiou' else 'a'} {dimension}"


def _in_base_units(number: str, unit: Unit) -> float:
    if not math.isfinite(float(number)):
        return float(number)
    mantissa, _, exponent = number.lower().partition("e")
    return float(f"{mantissa}e{int(exponent or 0) + unit.power}") * unit.size


def _candidates(value: float, unit: Unit) -> list[str]:
    """Return numbers that a value may be in a unit, those that give it back first."""
    if unit.size == 1.0:
        numbers = [repr(value)]
    else:
        numbers = [f"{value / unit.size:.{digits}g}" for digits in _DIGITS]
    moved = [Decimal(number).scaleb(-unit.power) for number in numbers]
    results = [text for number in moved for text in (_plainly(number), str(number))]
    return sorted(results, key=lambda number: _in_base_units(number, unit) != value)


def _plainly(number: Decimal) -> str:
    return repr(float(number)).removesuffix(".0")


def _pure(text: str) -> float | complex | None:
    """Return the ratio or the complex number that a text stands for; None where it is neither."""
    return _complex(text) if (ratio := ratio_of(text)) is None else ratio


def _complex(text: str) -> complex | None:
    """Return the complex number that a text stands for; None where it is none."""
    number = text[1:-1].strip() if text.startswith("(") and text.endswith(")") else text
    number = _SIGN_BETWEEN.sub(r"\1", number)
    return complex(number) if _COMPLEX.fullmatch(number) else None


def _respelt(text: str, dimension: str) -> str:
    """Return a text with j for i, or with a unit for a quotient, if that was meant."""
    if dimension == "inverse length":
        return _per_length(text)
    root = f"{text[:-1]}j"
    return root if text.endswith("i") and not dimension and _complex(root) is not None else ""


def _per_length(text: str) -> str:
    """Return the quantity that a quotient such as ``"0.1/mm"`` is; nothing for all else."""
    number, _, length = (part.strip() for part in text[:_LONGEST].partition("/"))
    match, unit = _QUANTITY.fullmatch(number), f"1/{length}"
    return f"{number} {unit}" if unit in UNITS and match and not match[2] else ""


def _mismatch(text: str, number: str, unit: str, dimension: str) -> str:
    """Return the sentence for a unit that is missing, unknown, or of another dimension."""
    if not dimension:
        cure = without_unit(number, unit)
        return f"'{text}' has the unit '{unit}', but a pure number is asked for; {cure}"
    units = units_of(dimension)
    if not unit:
        request = with_article(dimension)
        return f"'{text}' has no unit, but {request} is asked for; add one of {', '.join(units)}"
    if unit not in UNITS:
        return f"unit '{unit}' of '{text}' is unknown{unit_meant(unit, units)}"
    return f"'{text}' is no {dimension}; use one of {', '.join(units)}"


def displayed(value: float, unit: str) -> str:
    """Write a number in base units with another unit, to 15 digits.

    >>> displayed(math.radians(3.0), "arcmin"), format_quantity(math.radians(3.0), "arcmin")
    ('180 arcmin', '180.00000000000003 arcmin')
    """
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


_ALL = 17


def digits_until(holds: Callable[[int], bool], least: int = 10) -> int:
    """Return with how few significant digits something holds; 17, which tell all doubles apart.

    >>> digits_until(lambda digits: f"{1 + 1e-11:.{digits}g}" != "1")
    12
    """
    return next((digits for digits in range(least, _ALL) if holds(digits)), _ALL)


INFINITE = "inf"
"""What is written for a ratio without end."""

_RATIO = re.compile(rf"({NUMBER})\s*:\s*({NUMBER})", re.ASCII)
_LARGEST = 300.0
"""The largest power of ten that decibels are written down as."""


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


def without_unit(number: str, unit: str) -> str:
    """Return the cure for a unit where a pure number is asked for; decibels are a ratio.

    >>> without_unit("30", "dB")
    'write 1000, which is 10 ** (30 / 10), for a ratio of intensities (0.001 for a loss of as much)'
    >>> without_unit("30", "mm")
    'leave it out'
    """
    if not is_of_decibels(unit) or not abs(power := float(number) / 10.0) < _LARGEST:
        return "leave it out"
    loss = f" ({10.0**-power:.10g} for a loss of as much)" if power > 0.0 else ""
    ratio = f"write {10.0**power:.10g}, which is 10 ** ({number} / 10), for a ratio of intensities"
    return ratio + loss


def is_of_decibels(unit: str) -> bool:
    """Tell whether what stands behind a number says decibels, which are no unit here."""
    return unit.lower() == "db"


_LENGTH_NAMES = {"nano": "nm", "micro": "um", "milli": "mm", "centi": "cm", "deci": "dm", "": "m"}
_ANGLE_NAMES = {
    "radian": "rad",
    "milliradian": "mrad",
    "arcminute": "arcmin",
    "arcsecond": "arcsec",
}

_SINGULAR = {
    **{
        f"{prefix}{metre}": u for prefix, u in _LENGTH_NAMES.items() for metre in ("meter", "metre")
    },
    **_ANGLE_NAMES,
    "degree": "deg",
    "micron": "um",
    "ångström": "angstrom",
    "angstroem": "angstrom",
    "angstrom": "angstrom",
    "tesla": "T",
    "millitesla": "mT",
    "gauss": "G",
    "kilogauss": "kG",
    "arc minute": "arcmin",
    "arc second": "arcsec",
}
_SIGNS = {"°": "deg", "º": "deg", "'": "arcmin", '"': "arcsec", "µm": "um", "μm": "um", "µ": "um"}
_SIGNS |= dict.fromkeys(("å", "\u212b"), "angstrom")
_NAMES = {**_SINGULAR, **{f"{name}s": unit for name, unit in _SINGULAR.items()}, **_SIGNS}
_NAMES |= {"degs": "deg", "rads": "rad", "mic": "um", "mu": "um"}

_GONS = dict.fromkeys(("gon", "gons", "gradian", "gradians"), "a gon is 0.9 deg")
_GONS |= dict.fromkeys(
    ("grad", "grads"), "a grad is 0.9 deg where it is a gon, and 1 deg in German"
)


def usual_name(word: str) -> str:
    """Return a unit as it is called here; the word itself where it has no other name.

    >>> usual_name("degrees/Millimeter"), usual_name("cm^-1"), usual_name("°"), usual_name("nm")
    ('deg/mm', '1/cm', 'deg', 'nm')
    """
    for power in ("^-1", "**-1", "-1", "⁻¹"):
        if word.endswith(power):
            word = f"1/{word.removesuffix(power)}"
    if word.startswith("per "):
        word = f"1/{word.removeprefix('per ')}"
    parts = word.replace(" per ", "/").split("/")
    return "/".join(_NAMES.get(part.strip().lower(), part.strip()) for part in parts)


def unit_meant(word: str, units: Collection[str]) -> str:
    """Return the cure for an unknown unit, ready to be put behind the fault.

    >>> unit_meant("degrees", ["deg", "rad"]), unit_meant("pints", ["deg", "rad"])
    ("; did you mean 'deg'?", '; there are: deg, rad')
    >>> unit_meant("grad", ["deg", "rad"])
    '; a grad is 0.9 deg where it is a gon, and 1 deg in German; write it in deg'
    """
    name = usual_name(word)
    if name in units:
        return f"; did you mean '{name}'?"
    if name.lower() in _GONS and "deg" in units:
        return f"; {_GONS[name.lower()]}; write it in deg"
    return did_you_mean(word, units)


_COMMA = re.compile(r"[-+]?\d+,\d+(?:[^\d,][^,]*)?", re.ASCII)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}(?:\D.*)?", re.ASCII)


def without_comma(text: str) -> list[str]:
    """Return the numbers that one with a comma may be meant for; none where it has no comma.

    >>> without_comma("30,5 deg"), without_comma("1,000"), without_comma("1.5")
    (['30.5 deg'], ['1.000', '1000'], [])
    """
    if _COMMA.fullmatch(text) is None:
        return []
    ways = (".", "") if _THOUSANDS.fullmatch(text) else (".",)
    return [text.replace(",", way) for way in ways]


def comma_cure(text: str) -> str:
    """Return the cure for a number with a comma, a part of a sentence; nothing for others.

    >>> comma_cure("30,5 deg")
    "did you mean '30.5 deg'? (a text is one value; several are an array, in Python)"
    >>> comma_cure("1,000")
    "its comma may be a decimal point or part thousands; write '1.000' or '1000'"
    """
    result = without_comma(text)
    if len(result) > 1:
        written = " or ".join(f"'{number}'" for number in result)
        return f"its comma may be a decimal point or part thousands; write {written}"
    several = "(a text is one value; several are an array, in Python)"
    return f"did you mean '{result[0]}'? {several}" if result else ""
