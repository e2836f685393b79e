"""Quantities as they are displayed: without the last digits, which are the noise of a unit."""

from __future__ import annotations

import math

from optipath.values.units import dimension_of, format_quantity, in_unit, parse_quantity


def displayed(value: float, unit: str) -> str:
    """Write a number with a unit, to 15 digits.

    Units: value in radians.

    Examples
    --------
    >>> displayed(math.radians(3.0), "arcmin"), format_quantity(math.radians(3.0), "arcmin")
    ('180 arcmin', '180.00000000000003 arcmin')
    """
    return f"{in_unit(value, unit):.15g} {unit}".strip()


def format_range(low: float, high: float, unit: str) -> str:
    """Write the limits of a range, or nothing where there are none.

    Units: low, high in radians.

    Examples
    --------
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
