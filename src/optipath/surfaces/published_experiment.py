"""Experiment: what was published of a sample, and how it is measured again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.surfaces.sample import Sample


class Walks(NamedTuple):
    """The photons that measurements have in common."""

    incidence: str
    wavelengths: tuple[str, ...]
    cells: int | None


@dataclass(frozen=True)
class Measurement:
    """A number that is published, and how it is measured."""

    measure: str
    text: str
    walks: Walks
    published: tuple[float, float] | None = None
    within: float = 0.0
    brighter_than: float = 0.2
    noise: float = 0.2
    azimuth: float = 180.0
    stokes: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)

    def agrees(self, value: float, error: float) -> bool | None:
        """Tell whether a value is the published one, as far as it is known.

        >>> one = Measurement("adm", "7 to 8 %", Walks("60 deg", (), None), (0.07, 0.08))
        >>> one.agrees(0.083, 0.002), one.agrees(0.09, 0.002)
        (True, False)
        """
        if self.published is None:
            return None
        least, largest = self.published
        off = self.within + 2.0 * error
        return bool(least - off <= value <= largest + off)


@dataclass(frozen=True)
class Experiment:
    """What was published of a sample."""

    name: str
    description: str
    source: str
    sample: Sample
    measurements: tuple[Measurement, ...]
    sensor: int = 128
    photons: int = 1_000_000

    def by_walks(self) -> Iterator[tuple[Walks, list[Measurement]]]:
        """Yield photons, and all that is measured with them, in the order of the file."""
        for walks in dict.fromkeys(one.walks for one in self.measurements):
            yield walks, [one for one in self.measurements if one.walks == walks]
