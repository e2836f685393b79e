"""ColourScale: which colours numbers have in a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.colors import FuncNorm, Normalize

if TYPE_CHECKING:
    from matplotlib.colorbar import Colorbar

    from optipath.values.precision import Numbers


_TONE = 0.4
"""The power of the light by which it is shown, so that dim light is seen beside bright light."""

_APART = 0.07
"""How far ticks are apart at least, of the length of a colour bar."""


class ColourScale(NamedTuple):
    """Which colours numbers have, and which of them a colour bar names.

    Colors are ordered by lightness, diverge from white, or are cyclic; color-blind safe.
    """

    colours: str
    norm: Normalize
    ticks: tuple[float, ...] = ()

    @classmethod
    def light(cls, largest: float) -> ColourScale:
        """Return that of light from 0 on: by a power of it, as the tones of a picture are."""
        return cls("inferno", _toned(0.0, largest), (0.0, *_rounded(largest, 1.0)))

    @classmethod
    def signed_light(cls, largest: float) -> ColourScale:
        """Return that of light with a sign: by a power of its size, white at 0."""
        ticks = _rounded(largest, 0.5)
        opposite = (-tick for tick in reversed(ticks))
        return cls("RdBu_r", _toned(-largest, largest), (*opposite, 0.0, *ticks))

    @classmethod
    def signed(cls, largest: float) -> ColourScale:
        """Return that of numbers with a sign, white at 0."""
        return cls("RdBu_r", Normalize(-largest, largest))

    @classmethod
    def share(cls, largest: float = 1.0) -> ColourScale:
        """Return that of shares, from 0 on."""
        return cls("viridis", Normalize(0.0, largest))

    @classmethod
    def ordered(cls, least: float, largest: float) -> ColourScale:
        """Return that of numbers in an order; of one number, with some room about it."""
        room = 0.5 * max(abs(least), 1.0) if least == largest else 0.0
        return cls("viridis", Normalize(least - room, largest + room))

    @classmethod
    def axis(cls) -> ColourScale:
        """Return that of the angles of axes in degrees, of which -90 and 90 are one."""
        return cls("twilight", Normalize(-90.0, 90.0), (-90.0, -45.0, 0.0, 45.0, 90.0))

    @classmethod
    def phase(cls) -> ColourScale:
        """Return that of phases in degrees, of which -180 and 180 are one."""
        return cls("twilight", Normalize(-180.0, 180.0), (-180.0, -90.0, 0.0, 90.0, 180.0))

    def bar(self, image: Any, axes: Any, label: str, **options: Any) -> Colorbar:
        """Draw the colour bar of an image."""
        bar: Colorbar = image.figure.colorbar(image, ax=axes, label=label, **options)
        if self.ticks:
            bar.set_ticks(list(self.ticks), labels=[f"{tick:g}" for tick in self.ticks])
            bar.ax.minorticks_off()
        return bar


def _toned(least: float, largest: float) -> Normalize:
    def tone(light: Numbers) -> Numbers:
        return np.sign(light) * np.abs(light) ** _TONE

    def light_of(tone: Numbers) -> Numbers:
        return np.sign(tone) * np.abs(tone) ** (1.0 / _TONE)

    return FuncNorm((tone, light_of), least, largest)


def _rounded(largest: float, length: float) -> tuple[float, ...]:
    """Return numbers such as 0.2, 0.5 and 1 that are apart on a bar of toned light.

    >>> _rounded(0.9, 1.0)
    (0.005, 0.02, 0.05, 0.1, 0.2, 0.5)
    """
    top = int(np.floor(np.log10(largest)))
    results: list[float] = []
    reached = np.inf
    for number in (float(f"{digit}e{top - power}") for power in range(5) for digit in (5, 2, 1)):
        place = (number / largest) ** _TONE
        if place <= 1.0 and min(place, reached - place) * length >= _APART:
            results.append(number)
            reached = place
    return tuple(reversed(results))
