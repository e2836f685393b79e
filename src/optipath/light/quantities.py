"""Quantities of light, each described once: for sweeps, uncertainties, pictures, and print.

A new one is a property of `Light` and a record here.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from optipath.light.polarization_state import length
from optipath.values.units import in_unit

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.values.parameters import Parameter


class Shares(NamedTuple):
    """A Stokes vector over S0, and lengths of its parts, NaN where these are noise."""

    s1: Any
    s2: Any
    s3: Any
    p: Any
    """Of (s1, s2, s3)."""
    q: Any
    """Of (s1, s2)."""
    t: Any
    """Of (s2, s3)."""
    none: Any
    """Zeros of their shape."""


@dataclass(frozen=True)
class LightQuantity:
    """A quantity of light. Units: limits in `shown_unit`, period in radians."""

    variable: str
    """What it is called in Datasets and pictures."""
    attribute: str
    """Of `Light`; the place of a component of the Stokes vector."""
    unit: str
    name: str
    """What it is, in words."""
    gradient: Callable[[Shares], tuple[Any, Any, Any, Any]] | None = None
    """Its slopes along the components of the Stokes vector, times S0; `DERIVED` needs them."""
    limits: tuple[float, float] | None = None
    period: float | None = None
    """Of an angle whose ends are one."""
    reads: Literal["stokes", "linear", "intensity"] = "stokes"
    """How much a detector must read."""
    longer: str = ""
    """What `optipath run` calls it, if not as `variable`."""

    @property
    def printed(self) -> str:
        """What `optipath run` calls it."""
        return self.longer or self.variable

    @property
    def shown_unit(self) -> str:
        """The unit in which files, the command line and the page have it: degrees, and no 1."""
        return {"rad": "deg", "1": ""}.get(self.unit, self.unit)

    def of(self, light: Light) -> npt.NDArray[np.float64]:
        """Return the numbers that it has for some light, of the shape of the batch."""
        if self.attribute.isdigit():
            return np.asarray(light.stokes)[..., int(self.attribute)]
        return getattr(light, self.attribute)  # type: ignore[no-any-return]

    def shown_of(self, light: Light) -> npt.NDArray[np.float64]:
        """Return the same numbers in the `shown_unit`."""
        numbers = self.of(light)
        return np.degrees(numbers) if self.unit == "rad" else numbers


def _of_dop(u: Shares) -> tuple[Any, Any, Any, Any]:
    return -length(u.s1, u.s2, u.s3), u.s1 / u.p, u.s2 / u.p, u.s3 / u.p


def _of_dolp(u: Shares) -> tuple[Any, Any, Any, Any]:
    return -length(u.s1, u.s2), u.s1 / u.q, u.s2 / u.q, u.none


def _of_aop(u: Shares) -> tuple[Any, Any, Any, Any]:
    return u.none, -0.5 * u.s2 / u.q**2, 0.5 * u.s1 / u.q**2, u.none


def _of_ellipticity(u: Shares) -> tuple[Any, Any, Any, Any]:
    wide = 0.5 * (1.0 + (u.s3 / (u.p + u.q)) ** 2) / u.p**2
    along = -wide * u.s3 * u.s1 / u.q, -wide * u.s3 * u.s2 / u.q
    return u.none, *along, wide * length(u.s1, u.s2)


def _of_psi(u: Shares) -> tuple[Any, Any, Any, Any]:
    along = [0.5 * (u.s1 * each) / (u.t * u.p**2) for each in (u.s2, u.s3)]
    return u.none, -0.5 * length(u.s2, u.s3) / u.p**2, *along


def _of_delta(u: Shares) -> tuple[Any, Any, Any, Any]:
    return u.none, u.none, u.s3 / u.t**2, -u.s2 / u.t**2


COMPONENTS = (
    LightQuantity("S0", "0", "", "intensity", reads="intensity"),
    LightQuantity("S1", "1", "", "horizontal over vertical", reads="linear"),
    LightQuantity("S2", "2", "", "diagonal over antidiagonal", reads="linear"),
    LightQuantity("S3", "3", "", "right-handed over left-handed circular"),
)
_SHARE, _SIGNED = (0.0, 1.0), (-1.0, 1.0)
_QUARTER, _AXIS, _PHASE = (0.0, 90.0), (-90.0, 90.0), (-180.0, 180.0)
_TURN = 2.0 * np.pi
_OF_AXIS = "angle of polarisation, from x towards y"
_OF_ELLIPSE = "minor over major axis, with the sign of S3"
_OF_PSI = "ellipsometric psi of the polarised part"
_OF_DELTA = "ellipsometric Delta of the polarised part"

DERIVED = (
    LightQuantity("DoP", "dop", "1", "degree of polarisation", _of_dop, _SHARE),
    LightQuantity(
        "DoLP", "dolp", "1", "degree of linear polarisation", _of_dolp, _SHARE, reads="linear"
    ),
    LightQuantity("AoP", "aop", "rad", _OF_AXIS, _of_aop, _AXIS, np.pi, "linear"),
    LightQuantity("ellipticity", "ellipticity", "1", _OF_ELLIPSE, _of_ellipticity, _SIGNED),
    LightQuantity("psi", "psi", "rad", _OF_PSI, _of_psi, _QUARTER, longer="Psi (ellipsometry)"),
    LightQuantity(
        "delta", "delta", "rad", _OF_DELTA, _of_delta, _PHASE, _TURN, longer="Delta (ellipsometry)"
    ),
)
"""What is computed of the light when somebody asks for it."""

_ELLIPTICITY_ANGLE = LightQuantity(
    "ellipticity angle", "ellipticity_angle", "rad", "arctangent of the ellipticity"
)
QUANTITIES = (*COMPONENTS, *DERIVED)
PRINTED = (*DERIVED[:4], _ELLIPTICITY_ANGLE, *DERIVED[4:])


class Numbers(NamedTuple):
    """How numbers are written."""

    digits: int

    def text(self, number: float, noise: float = 0.0) -> str:
        """Return a number as it is printed."""
        if math.isnan(number):
            return "not read"
        return f"{0.0 if abs(number) < noise else number + 0.0:.{self.digits}g}"

    def state(self, number: float) -> str:
        """Return a number of the polarisation; NaN where light has none."""
        return "-" if math.isnan(number) else self.text(number)

    def value_of(self, parameter: Parameter) -> str:
        """Return the value of a parameter, in its unit."""
        value = parameter.default
        if not isinstance(value, float):
            return parameter.text(value)
        return f"{in_unit(value, parameter.unit):.{self.digits}g} {parameter.unit}".strip()

    def stokes(self, light: Any, index: tuple[int, ...] = ()) -> list[str]:
        """Return the four components of a light."""
        noise = float(light.noise[index])
        return [self.text(component, noise) for component in light.stokes[index].tolist()]
