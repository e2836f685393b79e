"""Coefficients of formulas: rows of numbers and parameters, and what each may be."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from optipath.errors import ValueFault, shown
from optipath.values.domains.domain import Domain
from optipath.values.parameters import Parameter

Coefficient: TypeAlias = tuple[str, Any, Domain]


class _AboveZero(Domain):
    """Real numbers that are not 0, either."""

    def described(self) -> str:
        return f"a real {self.name} above 0"


REAL = Domain("coefficient")
POSITIVE = _AboveZero("coefficient", minimum=5e-324)
NOT_NEGATIVE = Domain("coefficient", minimum=0.0)

MICROMETRES = 1e6
"""How many there are in a metre: the unit of published coefficients."""


def several(name: str, values: Any) -> tuple[Any, ...]:
    """Return coefficients as a tuple.

    Examples
    --------
    >>> several("b", [1.0, 2])
    (1.0, 2)
    """
    given = values.tolist() if isinstance(values, np.ndarray) else values
    is_one = isinstance(given, (str, Parameter)) or not hasattr(given, "__iter__")
    row = () if is_one else tuple(given)
    if not row:
        raise ValueFault(
            f"{name} must be a row of one coefficient or more, such as [1.0], not {shown(values)}"
        )
    return row


def oscillators_of(label: str, rows: Any, names: tuple[str, ...]) -> tuple[tuple[Any, ...], ...]:
    """Return the coefficients of oscillators, so many of each.

    Examples
    --------
    >>> oscillators_of("gold", [[0.02, 0.4]], ("strength", "energy"))
    ((0.02, 0.4),)
    """
    if not hasattr(rows, "__iter__") or not all(hasattr(row, "__len__") for row in rows):
        rows = [()]
    if any(len(row) != len(names) for row in rows):
        raise ValueFault(
            f"oscillators of {label}: give a row of {len(names)} numbers for each, "
            f"[({', '.join(names)}), ...]"
        )
    return tuple([several("an oscillator", row) for row in rows])


def coefficients_of(
    rows: tuple[tuple[Any, ...], ...], names: tuple[str, ...], domains: tuple[Domain, ...]
) -> list[Coefficient]:
    """Return the coefficients of oscillators one after another, each with its name and domain."""
    return [
        (f"oscillators[{place}] {name}", value, domain)
        for place, row in enumerate(rows)
        for name, value, domain in zip(names, row, domains, strict=True)
    ]
