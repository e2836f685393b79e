"""Experiment: what was published of a sample, and how it is measured again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.surfaces.samples.sample import Sample


class Walks(NamedTuple):
    """The photons that measurements have in common.

    Attributes
    ----------
    incidence : str
        The angle of incidence, such as ``"60 deg"``.
    wavelengths : tuple of str
        In vacuum, such as ``"380 nm"``; none where no medium depends on it.
    cells : int or None
        Those of the sample's random fields, where they are others than the sample says.
    """

    incidence: str
    wavelengths: tuple[str, ...]
    cells: int | None


@dataclass(frozen=True)
class Measurement:
    """A number that is published, and how it is measured.

    Attributes
    ----------
    measure : str
        What is measured: a name out of `measured_quantities.MEASURES`.
    text : str
        What the publication says.
    walks : Walks
        The photons.
    published : tuple of float or None
        The least and the largest number that is published; None where there is none.
    within : float
        How far off a number may be, beside two standard errors.
    brighter_than, noise : float
        Of pixels: how bright they must be, and how well known; see `Hemisphere.adm`.
    azimuth : float
        And within how many degrees of the plane of incidence, on the forward side.
    stokes : tuple of float
        The light, where the measure depends on it.
    """

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

        Parameters
        ----------
        value, error : float
            What has been measured, and its standard error.

        Returns
        -------
        bool or None
            None where no number is published.

        Examples
        --------
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
    """What was published of a sample.

    Attributes
    ----------
    name : str
        That of the experiment, or the path of its file.
    description, source : str
        What it is, and where it is published.
    sample : Sample
        What light falls on.
    measurements : tuple of Measurement
        What is measured.
    sensor : int
        How many pixels there are along each side of a hemisphere.
    photons : int
        How many are walked from each direction, unless told otherwise.
    """

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
