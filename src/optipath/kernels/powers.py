"""How much is reflected along s and along p, and nothing else: no phase, and one denominator.

What an intensity asks of an interface. The denominators of a whole path are multiplied, and
divided by once, at its end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.boundary import (
    Boundary,
    absorbing_boundary,
    denser_boundary,
    lossless_boundary,
)
from optipath.kernels.stable import front, slant

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


def reflected_powers(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, k, cos, sin) -> (Fs d, Fp d, d)``, with d = |p + g|^4 |z + p g|^2.

    With Fs = |D|^2 / |p + g|^4 and Fp / Fs = |z - p g|^2 / |z + p g|^2, as in
    `stable_reflection`; sums of products that are not negative, but for z - p a.
    """
    boundary = absorbing_boundary(xp)
    return lambda n1, n, k, c, s: _powers(boundary(n1, n, k, c, s))


def lossless_powers(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, cos, sin) -> (Fs d, Fp d, d)``: the same, cheaper, for k = 0."""
    boundary = lossless_boundary(xp)
    return lambda n1, n, c, s: _powers(boundary(n1, n, c, s))


def denser_powers(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(n1, n, cos, sin) -> (Fs d, Fp d, d)``: cheaper again, for n >= n1."""
    boundary = denser_boundary(xp)
    return lambda n1, n, c, s: _powers(boundary(n1, n, c, s))


def _powers(at: Boundary) -> tuple[Any, ...]:
    P, along = front(at), slant(at)
    parted = at.D * at.D + at.v * at.v
    return parted * along.q, parted * along.less, P * P * along.q
