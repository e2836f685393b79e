"""Colors of lines and marks, distinguishable by color-blind eyes, and color scales of maps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.colors import FuncNorm, Normalize

if TYPE_CHECKING:
    from matplotlib.colorbar import Colorbar

    from optipath.values.precision import Numbers


INK = "#222222"
"""Of texts, axes and what is drawn in one colour alone."""

FAINT = "#8a8a8a"
"""Of lines that help: grids, directions, limits."""

LINES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
"""Of lines beside one another, in this order (Okabe and Ito, Color Universal Design, 2008)."""

DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 2, 1.5, 2)), (0, (9, 3)), (0, (1, 1)))
"""Of the same lines, which tells them apart without colours."""

HATCHED: dict[str, Any] = {"facecolor": "white", "edgecolor": FAINT, "hatch": "////", "lw": 0.0}
"""Of places where there is no number."""

_TONE = 0.4
"""The power of the light by which it is shown, so that dim light is seen beside bright light."""


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
        return cls("inferno", _toned(0.0, largest), (0.0, *_rounded(largest, 4)))

    @classmethod
    def signed_light(cls, largest: float) -> ColourScale:
        """Return that of light with a sign: by a power of its size, white at 0."""
        ticks = _rounded(largest, 3)
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
    def cyclic(cls, end: float = 90.0) -> ColourScale:
        """Return that of angles in degrees, of which -end and end are one."""
        return cls("twilight", Normalize(-end, end), (-end, -end / 2, 0.0, end / 2, end))

    def bar(self, image: Any, axes: Any, label: str, **options: Any) -> Colorbar:
        """Draw the colour bar of an image."""
        bar: Colorbar = image.figure.colorbar(image, ax=axes, label=label, **options)
        if self.ticks:
            bar.set_ticks(list(self.ticks), labels=[f"{tick:g}" for tick in self.ticks])
            bar.ax.minorticks_off()
        return bar


def _toned(least: float, largest: float) -> Normalize:
    def tone(light: Numbers, power: float = _TONE) -> Numbers:
        return np.sign(light) * np.abs(light) ** power

    return FuncNorm((tone, lambda shown: tone(shown, 1.0 / _TONE)), least, largest)


def _rounded(largest: float, count: int) -> tuple[float, ...]:
    """Return numbers of one digit that are about as far from one another in tone.

    >>> _rounded(0.9, 4)
    (0.03, 0.2, 0.4, 0.9)
    """
    apart = largest * np.linspace(1.0 / count, 1.0, count) ** (1.0 / _TONE)
    return tuple(each for each in (float(f"{one:.1g}") for one in apart) if each <= largest)
