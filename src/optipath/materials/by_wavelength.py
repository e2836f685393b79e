"""Numbers of a user's own by wavelength: samples of a table, Drude's rotation formula."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.materials.formulas import (
    EVERYWHERE,
    MICROMETRES,
    REAL,
    Coefficient,
    FormulaCurve,
    coefficients,
)
from optipath.materials.tables import Tabulated
from optipath.values.arrays import as_argument, numbers_for
from optipath.values.curve_value import curve_at
from optipath.values.parameters import label_of
from optipath.values.units import dimension_of, parse_quantity, unit_of

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from optipath.materials.tables import Extrapolation, Interpolation


def tabulated(
    wavelengths: Any,
    values: Any,
    unit: str = "",
    *,
    label: str = "the table",
    interpolation: Interpolation = "linear",
    extrapolate: Extrapolation = "",
    wavelength: Any = None,
) -> Any:
    """Return a number that follows from the wavelength by samples.

    It stands wherever a `Parameter` does: a transmittance, a retardance, a birefringence, a
    rotatory power, a Verdet constant, an absorption coefficient.

    Parameters
    ----------
    wavelengths : array_like, shape (n,)
        In vacuum, in metres, or texts with a unit; rising or falling.
    values : array_like, shape (n,)
        The samples.
    unit : str, optional
        That of the samples; by default texts have one each, and numbers are in radians, metres
        and teslas.
    label : str, optional
        What sentences call it.
    interpolation, extrapolate, wavelength
        As `Material.tabulated` takes them.

    Returns
    -------
    CurveValue, or float or ndarray where the wavelength is known

    Examples
    --------
    >>> green = tabulated(["500 nm", "550 nm", "600 nm"], [0.0, 0.8, 0.1], label="green glass")
    >>> round(green.at("525 nm"), 12)
    0.4
    """
    label = label_of("a table", label, "the table")
    samples = as_argument(f"values of {label}", values)
    texts = [entry for entry in samples.ravel().tolist() if isinstance(entry, str)]
    if not dimension_of(unit):
        unit = next(map(unit_of, texts), "")
    parse = partial(parse_quantity, dimension=dimension_of(unit), default_unit=unit)
    numbers = numbers_for(f"values of {label}", values, parse)
    row = np.asarray(numbers)
    if unit and not texts and row.dtype.kind in "iuf":
        numbers = np.reshape([parse(f"{one} {unit}").real for one in row.flat], row.shape)
    how: Any = {"interpolation": interpolation, "extrapolate": extrapolate, "unit": unit}
    return curve_at(Tabulated(label, ("value",), wavelengths, (numbers,), **how), wavelength)[0]


def drude_rotation(
    strengths: Sequence[Any],
    poles: Sequence[Any],
    constant: Any = 0.0,
    unit: str = "rad/m",
    *,
    label: str = "the rotation",
    span: tuple[Any, Any] = EVERYWHERE,
    wavelength: Any = None,
) -> Any:
    """Return a rotation that follows from the wavelength by the formula of Drude.

    It is constant + the sum of A / (w^2 - C): rotatory power (P. Drude, Lehrbuch der Optik (1900),
    part II, ch. VI), and Verdet constants of what has paramagnetic ions, K / (w^2 - w0^2).

    Parameters
    ----------
    strengths : sequence of float or Parameter
        A, in the unit times square micrometres.
    poles : sequence of float or Parameter
        C, in square micrometres: the square of the wavelength of a resonance.
    constant : float or Parameter, optional
        What is added, in the unit.
    unit : str, optional
        Such as ``"deg/mm"``, or ``"rad/(T m)"``.
    label : str, optional
        What sentences call it.
    span, wavelength
        As `Material.sellmeier` takes them.

    Returns
    -------
    CurveValue, or float or ndarray where the wavelength is known

    Examples
    --------
    Quartz, by Lowry and Coode-Adams (`Crystal.named` has it):

    >>> import math
    >>> quartz = drude_rotation([9.5639, -2.3113], [0.0127493, 0.000974], -0.1905, "deg/mm")
    >>> round(math.degrees(quartz.at("589.3 nm")) / 1000, 3)
    21.725
    """
    label = label_of("a rotation", label, "the rotation")
    curve = DrudeRotation(label, strengths, poles, constant, unit, span=span)
    return curve_at(curve, wavelength)[0]


@dataclass(frozen=True, eq=False, repr=False)
class DrudeRotation(FormulaCurve):
    """A constant and the sum of A / (w^2 - C), w in um, times a unit; NaN at a resonance."""

    parts = ("value",)
    rows = ("strengths", "poles")
    strengths: Any
    poles: Any
    constant: Any
    unit: str = field()

    def __post_init__(self) -> None:
        super().__post_init__()
        vars(self).update(_size=parse_quantity(f"1 {self.unit}", dimension_of(self.unit)))

    def arguments(self) -> list[Coefficient]:
        rows = [*coefficients("strengths", self.strengths), *coefficients("poles", self.poles)]
        return [("constant", self.constant, REAL), *rows]

    @property
    def content(self) -> tuple[Hashable, ...]:
        return self.unit, *super().content

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        constant, *rest = arguments
        square = (wavelength * MICROMETRES) ** 2
        total, half = constant + 0.0 * square, len(self.poles)
        for strength, pole in zip(rest[:half], rest[half:], strict=True):
            away = square - pole
            at_resonance = away == 0.0
            term = strength / xp.where(at_resonance, 1.0, away)
            total = total + xp.where(at_resonance, xp.nan, term)
        return (vars(self)["_size"] * total,)
