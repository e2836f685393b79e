"""The quantities of light that a sweep has a variable for."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light


class LightQuantity(NamedTuple):
    """A quantity of light."""

    variable: str
    attribute: str
    unit: str
    name: str

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


COMPONENTS = tuple(
    LightQuantity(f"S{place}", str(place), "", name)
    for place, name in enumerate(
        [
            "intensity",
            "horizontal over vertical",
            "diagonal over antidiagonal",
            "right-handed over left-handed circular",
        ]
    )
)
DERIVED = (
    LightQuantity("DoP", "dop", "1", "degree of polarisation"),
    LightQuantity("DoLP", "dolp", "1", "degree of linear polarisation"),
    LightQuantity("AoP", "aop", "rad", "angle of polarisation, from x towards y"),
    LightQuantity("ellipticity", "ellipticity", "1", "minor over major axis, with the sign of S3"),
    LightQuantity("psi", "psi", "rad", "ellipsometric psi of the polarised part"),
    LightQuantity("delta", "delta", "rad", "ellipsometric Delta of the polarised part"),
)
"""What is computed of the light when somebody asks for it."""

QUANTITIES = (*COMPONENTS, *DERIVED)

FAINT = LightQuantity(
    "log10_intensity", "log10_intensity", "1", "decimal logarithm of the intensity, however faint"
)
"""What is there besides where intensities are too small for a float."""
