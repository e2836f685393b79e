"""Sellmeier and Cauchy: n of what is transparent, by a few coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import ValueFault
from optipath.kernels.dispersion.sellmeier import cauchy_index, index_of_square, sellmeier_square
from optipath.values.curves.coefficients import (
    MICROMETRES,
    NOT_NEGATIVE,
    REAL,
    several,
)
from optipath.values.curves.formula_curve import EVERYWHERE, FormulaCurve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.values.curves.coefficients import Coefficient


class Sellmeier(FormulaCurve):
    """n^2 = offset + the sum of B w^2 / (w^2 - C), with w in micrometres.

    Units: c in square micrometres; resonances in micrometres.

    Examples
    --------
    >>> from optipath.values.curves.curve_value import curve_values
    >>> float(curve_values(Sellmeier("x", [1.25], [0.0]), 5e-7)[0])
    1.5
    """

    b: tuple[Any, ...]
    c: tuple[Any, ...] | None
    resonances: tuple[Any, ...] | None
    offset: Any
    parts = ("n",)
    unreal = "its formula has n^2 below 0 there, or a resonance"

    def __init__(
        self,
        label: str,
        b: Any,
        c: Any = None,
        *,
        resonances: Any = None,
        offset: Any = 1.0,
        span: Any = EVERYWHERE,
    ) -> None:
        if (c is None) == (resonances is None):
            raise ValueFault(
                f"{label} needs c, in square micrometres, or resonances, in micrometres; give one "
                f"of the two"
            )
        b, c, resonances = [
            None if row is None else several(f"{name} of {label}", row)
            for name, row in (("b", b), ("c", c), ("resonances", resonances))
        ]
        if len(b) != len(poles := c or resonances or ()):
            other = "resonances" if c is None else "c"
            raise ValueFault(
                f"{label} has {len(b)} of b and {len(poles)} of {other}; give one for each"
            )
        super().__init__(label, span, b=b, c=c, resonances=resonances, offset=offset)

    def arguments(self) -> list[Coefficient]:
        name = "resonances" if self.c is None else "c"
        domain = NOT_NEGATIVE if self.c is None else REAL
        poles = self.c or self.resonances or ()
        return [
            ("offset", self.offset, REAL),
            *[(f"b[{place}]", value, REAL) for place, value in enumerate(self.b)],
            *[(f"{name}[{place}]", value, domain) for place, value in enumerate(poles)],
        ]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        square = sellmeier_square(xp, wavelength * MICROMETRES, *self.terms(arguments))
        return (index_of_square(xp, square),)

    def terms(self, arguments: Sequence[Any]) -> tuple[Any, Sequence[Any], Sequence[Any]]:
        """Return the offset, the strengths, and the poles in square micrometres."""
        offset, *rest = arguments
        strengths, poles = rest[: len(self.b)], rest[len(self.b) :]
        return offset, strengths, [p * p for p in poles] if self.c is None else poles


class Cauchy(FormulaCurve):
    """n = A + B / w^2 + C / w^4 + ..., with w in micrometres.

    Units: coefficients in square micrometres.

    Examples
    --------
    >>> from optipath.values.curves.curve_value import curve_values
    >>> float(curve_values(Cauchy("x", [1.5, 0.004]), 5e-7)[0])
    1.516
    """

    coefficients: tuple[Any, ...]
    parts = ("n",)

    def __init__(self, label: str, coefficients: Any, *, span: Any = EVERYWHERE) -> None:
        row = several(f"coefficients of {label}", coefficients)
        super().__init__(label, span, coefficients=row)

    def arguments(self) -> list[Coefficient]:
        names = [f"coefficients[{place}]" for place in range(len(self.coefficients))]
        return [(name, value, REAL) for name, value in zip(names, self.coefficients, strict=True)]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        return (cauchy_index(xp, wavelength * MICROMETRES, arguments),)
