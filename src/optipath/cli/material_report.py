"""What a material is at a wavelength: n, k, reflectance, effective index."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.cli.console import PlainConsole, cell, headed, say_wrapped, title
from optipath.elements.effective_index import effective_index
from optipath.elements.fresnel import fresnel_reflection
from optipath.errors import MaterialError, OptipathError
from optipath.values.cures import of_options
from optipath.values.curves.curve_value import CurveValue
from optipath.values.curves.wavelength_range import WavelengthRange, span_text
from optipath.values.domains.quantities import INCIDENCE
from optipath.values.materials import Material
from optipath.values.plain_json import plain
from optipath.values.units import format_quantity, in_unit, parse_quantity
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.values.curves.page_curve import PageCurve


@dataclass(frozen=True)
class MaterialReport:
    """What is told of a material.

    Shape: wavelengths, n, k, reflectance, effective_n, effective_k (n,). Units: span in metres;
    incidence in radians.
    """

    name: str
    place: str
    source: str
    span: tuple[float, float] | None
    incidence: float
    wavelengths: npt.NDArray[Any]
    n: npt.NDArray[Any]
    k: npt.NDArray[Any]
    reflectance: npt.NDArray[Any]
    effective_n: npt.NDArray[Any]
    effective_k: npt.NDArray[Any]

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON can hold it, with all digits."""
        found = {
            "material": self.name,
            "page": self.place,
            "source": self.source,
            "range": self.span and [plain(end, "nm") for end in self.span],
            "incidence": plain(self.incidence, "deg"),
            "wavelength": plain(self.wavelengths, "nm"),
        }
        for key in ("n", "k", "reflectance", "effective_n", "effective_k"):
            found[key] = plain(getattr(self, key))
        return found | {"units": {"range": "nm", "wavelength": "nm", "incidence": "deg"}}

    def print(self, digits: int) -> None:
        """Print it as a table."""
        console = PlainConsole()
        console.print(title(self.name, span_text(self.span) if self.span else "at any wavelength"))
        angle = format_quantity(self.incidence, "deg")
        behind = [f"{part} at {angle}" for part in ("n'", "k'")]
        table = headed("wavelength", "n", "k", "normal reflectance", *behind, box=None)
        columns = (self.n, self.k, self.reflectance, self.effective_n, self.effective_k)
        for wavelength, *numbers in zip(self.wavelengths, *columns, strict=True):
            texts = [f"{number:.{digits}g}" for number in numbers]
            table.add_row(*map(cell, (f"{in_unit(wavelength, 'nm'):.{digits}g} nm", *texts)))
        console.print(table)
        if self.source:
            say_wrapped(f"{self.place}: {self.source}")


def told_at(
    name: str, page: str, wavelengths: Sequence[str], incidence: str, own: Mapping[str, Any]
) -> MaterialReport:
    """Return what a material is at wavelengths.

    Units: incidence in degrees.
    """
    if not name:
        raise MaterialError("--at needs the name of a material: optipath materials gold --at ...")
    faults: list[str] = []
    where = [_read(text, faults) for text in wavelengths]
    angle = _angle(incidence, faults)
    if faults:
        raise MaterialError(*faults)
    with of_options({"page": "--page", "n": "--n", "k": "--k"}):
        open_one = Material.named(name, page=page, **own)
    curve: PageCurve | None = next(
        (part.curve for part in (open_one.n, open_one.k) if isinstance(part, CurveValue)), None
    )
    _check_range(curve, where)
    there = np.array(where)
    n, k = (_numbers(part, there) for part in (open_one.n, open_one.k))
    index = n + 1j * k
    behind = effective_index(index, angle)
    place, source = ("", "") if curve is None else (curve.place, curve.source)
    return MaterialReport(
        curve.label if curve else name,
        place,
        source,
        curve.span if curve else None,
        angle,
        there,
        n,
        k,
        fresnel_reflection(index, 1.0, 0.0)[0],
        *behind,
    )


def _numbers(part: Any, there: npt.NDArray[Any]) -> npt.NDArray[Any]:
    found = part.at(there) if isinstance(part, CurveValue) else part
    return np.broadcast_to(np.asarray(found, np.float64), there.shape)


def _check_range(curve: PageCurve | None, wavelengths: Sequence[float]) -> None:
    if curve is not None:
        own = f"{curve.beyond}, or " if "--k" in curve.beyond else ""
        known = replace(WavelengthRange.of(curve), beyond=f"{own}choose another page with --page")
        for wavelength in wavelengths:
            known.check("--at", wavelength)


def _read(text: str, faults: list[str]) -> float:
    try:
        return float(Wavelength().resolve(text).value)
    except OptipathError as error:
        faults += [fault.replace("parameter 'wavelength'", "--at") for fault in error.faults]
        return 1.0


def _angle(text: str, faults: list[str]) -> float:
    try:
        return float(INCIDENCE.check("--incidence", parse_quantity(text, "angle", "deg")))
    except OptipathError as error:
        faults += error.faults
        return 0.0
