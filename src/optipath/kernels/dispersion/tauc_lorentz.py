"""The permittivity of amorphous semiconductors and insulators, by Jellison and Modine."""

from __future__ import annotations

import math
from typing import Any


def tauc_lorentz_permittivity(
    xp: Any, energy: Any, amplitude: Any, resonance: Any, broadening: Any, gap: Any
) -> tuple[Any, Any]:
    """Return what an oscillator above a gap adds to the permittivity.

    G. E. Jellison and F. A. Modine, Appl. Phys. Lett. 69, 371 (1996), with the erratum, 2137. The
    logarithms of the real part are taken together, so that what becomes infinite at the gap, and
    cancels there, does not stand in it.

    Units: energy in electronvolts.

    Examples
    --------
    >>> import numpy as np
    >>> silicon = tauc_lorentz_permittivity(np, 3.5, 122.0, 3.45, 2.54, 1.2)
    >>> [round(float(part), 3) for part in silicon]
    [5.113, 20.414]
    """
    e, a, e0, c, eg = energy, amplitude, resonance, broadening, gap
    ee, e0e0, cc, egeg = e * e, e0 * e0, c * c, eg * eg
    alpha = xp.sqrt(4.0 * e0e0 - cc)
    beyond = ee - e0e0
    zeta = beyond * beyond + cc * ee
    above = e - eg
    inside = xp.where(above > 0.0, above, 0.0)
    imaginary = a * e0 * c * inside * inside / (zeta * e)

    by_log = (egeg - e0e0) * ee + egeg * cc - e0e0 * (e0e0 + 3.0 * egeg)
    by_angle = beyond * (e0e0 + egeg) + egeg * cc
    sum_of = e0e0 + egeg
    first = c * by_log / (2.0 * alpha * e0) * xp.log((sum_of + alpha * eg) / (sum_of - alpha * eg))
    angles = math.pi - xp.arctan((2.0 * eg + alpha) / c) + xp.arctan((alpha - 2.0 * eg) / c)
    second = by_angle / e0 * angles
    gamma = e0e0 - 0.5 * cc
    turn = math.pi + 2.0 * xp.arctan(2.0 * (gamma - egeg) / (alpha * c))
    third = 2.0 * e0 * eg / alpha * (ee - gamma) * turn
    gap_square = (e0e0 - egeg) * (e0e0 - egeg) + egeg * cc
    total = e + eg
    # Of |E - Eg| / (E + Eg): next to the gap as it stands, far from it of what it is less than 1.
    distance = xp.where(above < 0.0, -above, above)
    is_near, at_gap = distance < 0.5 * total, distance == 0.0
    near = xp.log(xp.where(is_near & ~at_gap, distance, total) / total)
    far = xp.log1p(xp.where(is_near, 0.0, -2.0 * xp.where(e < eg, e, eg) / total))
    ratio = near + far
    logs = above * above / e * ratio + eg * xp.log(gap_square / (total * total * total * total))
    real = a / (math.pi * zeta) * (first - second + third - e0 * c * logs)
    return real, imaginary
