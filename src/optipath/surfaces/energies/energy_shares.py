"""EnergyShares: how much of the light leaves a sample, where to, and after how many events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from optipath.surfaces.walk.walk_layout import DOWN, SIDEWAYS, STUCK, UP

Numbers: TypeAlias = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class EnergyShares:
    """Shares of the light that falls on a sample; with ``_se`` behind, the standard error of each.

    All have the shape of the wavelengths, () where there is one.

    Shape: reflected, transmitted, reflected_se, transmitted_se (events, ...).
    """

    R_s: Numbers
    R_s_se: Numbers
    R_m: Numbers
    R_m_se: Numbers
    R: Numbers
    R_se: Numbers
    T_s: Numbers
    T_s_se: Numbers
    T_m: Numbers
    T_m_se: Numbers
    T: Numbers
    T_se: Numbers
    lost: Numbers
    lost_se: Numbers
    absorbed: Numbers
    absorbed_se: Numbers
    reflected: Numbers
    reflected_se: Numbers
    transmitted: Numbers
    transmitted_se: Numbers


_ONCE, _MORE, _ALL = slice(0, 1), slice(1, None), slice(None)
_PARTS: dict[str, tuple[list[int], slice]] = {
    "R_s": ([UP], _ONCE),
    "R_m": ([UP], _MORE),
    "R": ([UP], _ALL),
    "T_s": ([DOWN], _ONCE),
    "T_m": ([DOWN], _MORE),
    "T": ([DOWN], _ALL),
    "lost": ([SIDEWAYS, STUCK], _ALL),
    "absorbed": ([UP, DOWN, SIDEWAYS, STUCK], _ALL),
}


def energy_shares(photons: Numbers, total: Numbers, squares: Numbers, whole: float) -> EnergyShares:
    """Return the shares of light out of sums over photons.

    Shapes: photons (surfaces,); total, squares (surfaces, ends, events, ...).
    """
    found: dict[str, Numbers] = {}
    for name, (ends, events) in _PARTS.items():
        part = [each[:, ends, events].sum(axis=(1, 2)) for each in (total, squares)]
        found[name], found[f"{name}_se"] = mean_and_error(photons, *part)
    found["absorbed"] = whole - found["absorbed"]
    for name, end in (("reflected", UP), ("transmitted", DOWN)):
        found[name], found[f"{name}_se"] = mean_and_error(photons, total[:, end], squares[:, end])
    return EnergyShares(**found)


def mean_and_error(photons: Numbers, total: Numbers, squares: Numbers) -> tuple[Numbers, Numbers]:
    """Return the mean over photons, and its standard error.

    Where photons fall on several surfaces, their means differ by more than chance: the error is
    then that of the mean over surfaces (the larger mean square of a one-way analysis of variance;
    Scheffe, The Analysis of Variance, Wiley 1959, ch. 7).

    Shapes: photons (surfaces,); total, squares (surfaces, ...); returns mean, error (...).

    Examples
    --------
    One of two photons is reflected, on either surface:

    >>> one = np.array([1.0, 1.0])
    >>> mean, error = mean_and_error(2.0 * one, one, one)
    >>> print(mean, error.round(3))
    0.5 0.354
    """
    lit = photons > 0.0
    photons, total, squares = photons[lit], total[lit], squares[lit]
    count, surfaces = photons.sum(), len(photons)
    each = photons.reshape(-1, *[1] * (total.ndim - 1))
    mean, means = total.sum(axis=0) / count, total / each
    # Of one photon, or one surface, nobody knows how it differs from others.
    within = (squares - total * means).sum(axis=0) / (count - surfaces or np.nan)
    between = (each * (means - mean) ** 2).sum(axis=0) / (surfaces - 1 or np.nan)
    return mean, np.sqrt(np.fmax(within, between).clip(min=0.0) / count)
