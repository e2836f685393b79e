"""Quantities of light in pictures: degrees, limits and labels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.errors import OptipathError, shown, unknown
from optipath.light.quantities import QUANTITIES, LightQuantity
from optipath.plots.colors import ColourScale

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.values.precision import Numbers


_READS = ("intensity", "linear", "stokes")
"""What a detector reads, from the least."""


class DrawnQuantity(NamedTuple):
    """A quantity of light as it is drawn."""

    light: LightQuantity

    @property
    def name(self) -> str:
        """What it is called, such as ``"DoLP"``."""
        return self.light.variable

    @property
    def unit(self) -> str:
        """The unit in which it is drawn; quantities of one share an axis."""
        return {"rad": "°"}.get(self.light.unit, self.light.unit)

    @property
    def label(self) -> str:
        """Its name, what it is, and its unit."""
        what = self.light.name.partition(",")[0]
        return f"{self.name}: {what}{' (°)' if self.unit == '°' else ''}"

    @property
    def short(self) -> str:
        """Its name and its unit."""
        return f"{self.name} (°)" if self.unit == "°" else self.name

    @property
    def period(self) -> float | None:
        """After how many degrees an angle is the same again."""
        return None if self.light.period is None else np.degrees(self.light.period)

    def is_read(self, reads: str) -> bool:
        """Return whether a detector reads enough, ``"stokes"``, ``"linear"`` or ``"intensity"``."""
        return _READS.index(self.light.reads) <= _READS.index(reads)

    def of(self, numbers: npt.ArrayLike) -> Numbers:
        """Return numbers of the light, in radians where they are angles, as they are drawn."""
        plain = np.asarray(numbers, np.float64)
        return np.degrees(plain) if self.unit == "°" else plain

    def colours(self, numbers: Numbers) -> ColourScale:
        """Return the colours of some numbers: in order, apart from 0, or round in a circle."""
        if self.period:
            return ColourScale.cyclic(self.period / 2.0)
        finite = numbers[np.isfinite(numbers)]
        low, high = self.light.limits or (-1.0 if self.name in {"S1", "S2", "S3"} else 0.0, None)
        largest = high or float(np.max(np.abs(finite), initial=0.0)) or 1.0
        return ColourScale.signed(largest) if low < 0.0 else ColourScale.share(largest)


def drawn_quantities(names: Any) -> list[DrawnQuantity]:
    """Return the quantities of some names, which may be written in small letters."""
    argument = [names] if isinstance(names, str) else names
    if not isinstance(argument, (list, tuple)) or not argument:
        raise OptipathError(
            f"quantities are {shown(names)}; give a name such as 'S0', or several: ('S0', 'DoLP')"
        )
    known = {each.variable: each for each in QUANTITIES}
    small = {name.lower(): name for name in known}
    read = [small.get(name.lower(), name) if isinstance(name, str) else name for name in argument]
    faults = [sentence for name in read for sentence in unknown("quantity", name, known)]
    if not faults and len({*read}) < len(read):
        faults = [f"quantities are {shown([*argument])}; give each of them once"]
    if faults:
        raise OptipathError(*faults)
    return [DrawnQuantity(known[name]) for name in read]


def drawn_quantity(name: Any) -> DrawnQuantity:
    """Return the quantity of one name."""
    if not isinstance(name, str):
        raise OptipathError(f"quantity is {shown(name)}; give one name, such as 'S0'")
    return drawn_quantities(name)[0]
