"""The permittivity of free and bound electrons, by Drude and Lorentz."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence


def drude_lorentz_permittivity(
    energy: Any, background: Any, plasma: Any, free: Any, bound: Sequence[Any]
) -> tuple[Any, Any]:
    """Return the permittivity of electrons that are free, and of some bound to an energy each.

    eps = background - f0 wp^2 / (w^2 + i g0 w) + the sum of f wp^2 / (w0^2 - w^2 - i g w), of a
    field exp(-iwt): F. Wooten, Optical Properties of Solids (1972), chapter 3; in the form of
    A. D. Rakic et al., Appl. Opt. 37, 5271 (1998), eqs. 1 to 3, whose field is exp(+iwt).

    Units: energy in electronvolts.

    Examples
    --------
    >>> gold = [(0.024, 0.415, 0.241), (0.010, 0.830, 0.345)]
    >>> real, imaginary = drude_lorentz_permittivity(1.0, 1.0, 9.03, (0.760, 0.053), gold)
    >>> round(real, 3), round(imaginary, 3)
    (-64.152, 5.213)
    """
    square, strength = energy * energy, plasma * plasma
    f0, g0 = free
    real = background - f0 * strength / (square + g0 * g0)
    imaginary = f0 * strength * g0 / (energy * (square + g0 * g0))
    for f, w0, g in bound:
        away, damped = (w0 - energy) * (w0 + energy), g * energy
        size = f * strength / (away * away + damped * damped)
        real, imaginary = real + size * away, imaginary + size * damped
    return real, imaginary
