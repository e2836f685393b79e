"""A stretch of a homogeneous medium: what it does per metre, and how many metres there are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.kernels.filters import retarder
from optipath.kernels.rotation import turn_back

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.kernels.primitives import Primitives


def absorption_along(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(absorption, length) -> (t,)``: Beer-Lambert, t = exp(-absorption length)."""
    exp = xp.exp
    return lambda absorption, length: (exp(-absorption * length),)


def rotation_along(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(rotation, length) -> (cos 2a, -sin 2a)``, the light turned by a."""
    turned_back = turn_back(xp)
    return lambda rotation, length: turned_back(rotation * length)


def retardance_along(xp: Primitives) -> Callable[..., tuple[Any, ...]]:
    """Make ``(retardance, length) -> (Fs, Fp, B, C, S)``, the fast axis along x."""
    retard = retarder(xp)
    return lambda retardance, length: retard(retardance * length)
