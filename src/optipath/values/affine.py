"""Affine: a multiple of what is not known yet, plus a number."""

from __future__ import annotations

import math
from contextlib import suppress
from numbers import Real
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from optipath.errors import ParameterError, UnitError, ValueFault, shown
from optipath.values.arrays.read_only import changed
from optipath.values.multiples import affine
from optipath.values.roundings import ENDLESS
from optipath.values.units import (
    USUAL_UNITS,
    dimension_of,
    format_quantity,
    parse_quantity,
    with_article,
)

if TYPE_CHECKING:
    from collections.abc import Hashable


_PURE = "pure number"


class Affine:
    """A named value that is given later, and ``scale * value + offset`` in its place."""

    name: str
    unit: str
    default: Any
    scale: float
    offset: float
    offset_dimension: str

    @property
    def is_signed(self) -> bool:
        """Whether it stands for the value itself or its negative."""
        return self.offset == 0.0 and self.scale in (1.0, -1.0)

    @property
    def is_negative(self) -> bool:
        """Whether it stands for the negative of the value."""
        return self.offset == 0.0 and self.scale == -1.0

    @property
    def quantity(self) -> Hashable:
        """What is told apart where it stands: by the name, or a multiple with an offset."""
        return self.name if self.is_signed else (self.name, self.scale, self.offset)

    @property
    def formula(self) -> str:
        """What it stands for, as people write it: ``d``, ``-d`` or ``2 * d + 10 deg``."""
        return self.formula_of(self.name)

    def formula_of(self, name: str) -> str:
        """Return what it stands for, the value being called by a name."""
        if self.scale in (1.0, -1.0):
            multiple = f"{'-' * (self.scale < 0.0)}{name}"
        else:
            multiple = f"{format_quantity(self.scale, '')} * {name}"
        if not self.offset:
            return multiple
        sign = "-" if self.offset < 0.0 else "+"
        return f"{multiple} {sign} {format_quantity(abs(self.offset), self.unit)}"

    @property
    def spoken(self) -> str:
        """What formulas in sentences call the value."""
        return self.name

    @property
    def called(self) -> str:
        """What sentences call the value."""
        return f"parameter '{self.name}'"

    @property
    def plain_numbers(self) -> Any:
        """What it is known to be, of which degrees are told from radians; None for nothing."""
        return self.default

    def alone(self) -> Self:
        """Return the value itself."""
        is_alone = self.scale == 1.0 and not self.offset and not self.offset_dimension
        return self if is_alone else self.shaped(1.0, 0.0)

    def like(self, other: Affine) -> Self:
        """Return what stands for this value as another does for its own."""
        return self.shaped(other.scale, other.offset, other.offset_dimension)

    def shaped(self, scale: float, offset: float, offset_dimension: str = "") -> Self:
        """Return what stands for a multiple of the value plus an offset.

        Parameters
        ----------
        scale, offset : float
            In radians and metres.
        offset_dimension : str, optional
            What the offset was given as.

        Returns
        -------
        Affine
            Of the same class and value.
        """
        return changed(self, scale=scale, offset=offset, offset_dimension=offset_dimension)

    def placed(self, numbers: Any, limits: tuple[float, float] = ENDLESS) -> Any:
        """Return what stands in its place, as `affine` does.

        Parameters
        ----------
        numbers : float or ndarray
            What the value is.
        limits : tuple of float, optional
            What it must be within.

        Returns
        -------
        float or ndarray
        """
        return affine(self.scale, self.offset, numbers, limits)

    def span_of(self, low: float, high: float) -> tuple[float, float]:
        """Return the limits of what stands in its place.

        Parameters
        ----------
        low, high : float
            Those of the value.

        Returns
        -------
        tuple of float
        """
        ends = self.placed(low), self.placed(high)
        return min(ends), max(ends)

    def span_for(self, low: float, high: float) -> tuple[float, float]:
        """Return the limits of the value.

        Parameters
        ----------
        low, high : float
            Those of what stands in its place.

        Returns
        -------
        tuple of float
        """
        ends = (low - self.offset) / self.scale, (high - self.offset) / self.scale
        return min(ends), max(ends)

    def checked_shape(self) -> tuple[float, float, str]:
        """Return scale and offset as numbers, and the dimension that a text of it names.

        Raises
        ------
        ParameterError
            If they are not finite real numbers, the scale being other than 0.
        UnitError
            If the unit of the offset is unknown, or of another dimension than the value.
        """
        dimension, given = self.offset_dimension, self.offset
        if type(given) is type(self.scale) is float and (self.scale, given) == (1.0, 0.0):
            return self.scale, given, dimension
        if isinstance(given, str):
            given, dimension = self.parsed(given)
        scale, offset = real_number(self.scale), real_number(given)
        if scale is None or scale == 0.0 or offset is None:
            raise ParameterError(
                f"parameter '{self.name}' can stand as scale * {self.name} + offset with finite "
                f"real numbers and a scale other than 0, not with scale {shown(self.scale)} and "
                f"offset {shown(self.offset)}"
            )
        return scale, offset, dimension

    def check_place(self, owner: str, domain: Any) -> None:
        """Check that a multiple with an offset can stand where it does.

        Parameters
        ----------
        owner : str
            The place, as sentences name it.
        domain : Domain
            What the values there may be.

        Raises
        ------
        ValueFault
            If several numbers belong together there, or the offset has another dimension.
        """
        dimension = self.offset_dimension
        if domain.tail and not self.is_signed:
            raise ValueFault(
                f"{owner} is {self.formula}, but takes several numbers that belong together; "
                f"compute them in NumPy and give them as the parameter '{self.name}'"
            )
        if dimension and dimension != (domain.dimension or _PURE):
            raise ValueFault(
                f"the offset of parameter '{self.name}' is {with_article(dimension)}, but {owner} "
                f"takes {domain.described()}; change its unit or where it is used"
            )

    def parsed(self, text: str) -> tuple[Any, str]:
        """Return the number that a text with a unit is as an offset, and its dimension."""
        own = dimension_of(self.unit) or self.offset_dimension
        for dimension in [own.removeprefix(_PURE)] if own else USUAL_UNITS:
            with suppress(UnitError):
                return parse_quantity(text, dimension), dimension or _PURE
        # For what it says of the unit.
        return parse_quantity(text, own.removeprefix(_PURE) if own else "angle"), own


def real_number(number: Any) -> float | None:
    """Return a finite real number as a float; None for what is none.

    Examples
    --------
    >>> real_number(2), real_number("2"), real_number(math.inf)
    (2.0, None, None)
    """
    if isinstance(number, np.ndarray) and not number.ndim and number.dtype.kind in "iuf":
        number = number[()]
    if not isinstance(number, Real) or isinstance(number, (bool, np.bool_, np.timedelta64)):
        return None
    try:
        found = float(number)
    except (OverflowError, ValueError):
        return None
    return found if math.isfinite(found) else None
