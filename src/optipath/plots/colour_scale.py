"""ColourScale: which colours numbers have in a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.colors import FuncNorm, Normalize

if TYPE_CHECKING:
    import numpy.typing as npt

Numbers = npt.NDArray[np.float64] if TYPE_CHECKING else np.ndarray

TONE = 0.4
"""The power of the light by which it is shown, so that dim light is seen beside bright light."""


class ColourScale(NamedTuple):
    """Which colours numbers have.

    Colours are in the order of their lightness, or go apart from white, or round in a circle, and
    those who are colour-blind tell them apart.

    Attributes
    ----------
    colours : str
        The colour map of Matplotlib.
    norm : Normalize
        From numbers to places on it.
    """

    colours: str
    norm: Normalize

    @classmethod
    def light(cls, largest: float) -> ColourScale:
        """Return that of light from 0 on: by a power of it, as the tones of a picture are."""
        return cls("inferno", FuncNorm((_tone, _light_of), 0.0, largest))

    @classmethod
    def signed_light(cls, largest: float) -> ColourScale:
        """Return that of light with a sign: by a power of its size, white at 0."""
        return cls("RdBu_r", FuncNorm((_tone, _light_of), -largest, largest))

    @classmethod
    def signed(cls, largest: float) -> ColourScale:
        """Return that of numbers with a sign, white at 0."""
        return cls("RdBu_r", Normalize(-largest, largest))

    @classmethod
    def share(cls, largest: float = 1.0) -> ColourScale:
        """Return that of shares from 0 on."""
        return cls("viridis", Normalize(0.0, largest))

    @classmethod
    def axis(cls) -> ColourScale:
        """Return that of the angles of axes in degrees, of which -90 and 90 are one."""
        return cls("twilight", Normalize(-90.0, 90.0))


def _tone(light: Numbers) -> Numbers:
    return np.sign(light) * np.abs(light) ** TONE


def _light_of(tone: Numbers) -> Numbers:
    return np.sign(tone) * np.abs(tone) ** (1.0 / TONE)
