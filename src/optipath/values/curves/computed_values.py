"""What values of curves come to together, and which parameters stand among and behind them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.values.curves.curve_value import CurveValue
from optipath.values.parameters import Parameter
from optipath.values.resolved import THERE, Resolved

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


def computed_values(
    values: Iterable[CurveValue], given: Mapping[str, Resolved]
) -> dict[str, Resolved]:
    """Return the numbers of those values of which all is given; each curve is evaluated once."""
    found: dict[str, Resolved] = {}
    parts: dict[Any, tuple[Any, ...]] = {}
    for value in values:
        if value.follows(given):
            same = id(value.curve), *map(id, value.given_by)
            if same not in parts:
                parts[same] = value.parts(given)
            found[value.name] = Resolved(parts[same][value.place], THERE)
    return found


def parameters_among(values: Iterable[Any]) -> list[Parameter]:
    """Return the parameters among some values, and behind each those that it follows from."""
    found: list[Parameter] = []
    for value in values:
        if isinstance(value, Parameter):
            found.append(value)
        if isinstance(value, CurveValue):
            found += value.arguments
    return found
