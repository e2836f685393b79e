"""Narrow spectra that would be lost between the samples of others by which they are multiplied."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from optipath.values.displayed import displayed
from optipath.values.spectra.spectral_values import one_wavelength

if TYPE_CHECKING:
    from optipath.values.spectra.gaussian_line import GaussianLine
    from optipath.values.spectra.sampled import Sampled

_REACH = 2.0
"""Up to how many widths from its peak a diode counts: its density there is 1.5e-5 of the peak."""
_AMPLE = 3.0
_FINEST = 0.25
"""How many widths samples may stand apart, so that straight lines keep the power."""


def lost_between(line: GaussianLine, sampled: Sampled) -> str:
    """Return why the product of a diode and samples does not have the power of the diode.

    Parameters
    ----------
    line : GaussianLine
        What is narrow.
    sampled : Sampled
        At whose wavelengths the product would be known.

    Returns
    -------
    str
        A sentence with its cure; nothing where samples around the peak stand a quarter of its
        width apart, or closer.
    """
    places = sampled.wavelengths
    below, above = places[:-1], places[1:]
    least, most = (line.peak + side * _REACH * line.width for side in (-1.0, 1.0))
    wide = (above - below > _FINEST * line.width) & (above > least) & (below < most)
    if not wide.any():
        return ""
    widest = int(np.argmax(np.where(wide, above - below, 0.0)))
    outside = "" if sampled.outside is None else ", outside=0.0"
    low, high, step = (f"'{text}'" for text in _finer(line, sampled))
    gap = [displayed(float(side[widest]), "nm") for side in (below, above)]
    return (
        f"{line.label}, of a width of {displayed(line.width, 'nm')}, is lost between the samples "
        f"of {sampled.label}, such as {gap[0]} and {gap[1]}; give that one samples a quarter of "
        f"the width apart, or closer, spectrum.resample(np.union1d(spectrum.wavelengths, "
        f"op.wavelengths({low}, {high}, {step})){outside})"
    )


def _finer(line: GaussianLine, sampled: Sampled) -> tuple[str, str, str]:
    """Return two ends and a step of samples around a diode, within what is known, as texts."""
    finest = 1e9 * line.width * _FINEST / 2.0
    power = 10.0 ** math.floor(math.log10(finest))
    step = max(times * power for times in (1.0, 2.0, 5.0) if times * power <= finest)
    first, last = (sampled.wavelengths[0], sampled.wavelengths[-1])
    least, most = (1e9 * (line.peak + side * _AMPLE * line.width) / step for side in (-1.0, 1.0))
    low = max(math.floor(least), math.ceil(1e9 * first / step))
    high = min(math.ceil(most), math.floor(1e9 * last / step))
    low += one_wavelength("low", _text(low, step)) < first
    high -= one_wavelength("high", _text(high, step)) > last
    return _text(low, step), _text(high, step), _text(1, step)


def _text(count: int, step: float) -> str:
    return f"{count * step:.12g} nm"
