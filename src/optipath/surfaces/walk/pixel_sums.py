"""The lights of photons, turned into the frames of their directions and added to pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numba as nb

from optipath.kernels.carriers.carried import stokes_of
from optipath.kernels.carriers.structures import ROTATION
from optipath.surfaces.walk.compiled_kernels import compiled_kernel
from optipath.surfaces.walk.walk_layout import CARRIED, END_LIGHTS, ENDS

if TYPE_CHECKING:
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


def _turned(xp: Primitives) -> KernelFunction:
    """Make ``(carried, cos 2a, sin 2a) -> Stokes vector``."""
    turn = ROTATION.made_for(xp)

    def turned(*numbers: Any) -> tuple[Any, ...]:
        return tuple(stokes_of(xp, turn(numbers[4:], numbers[:4], 4)))

    return turned


_stokes = compiled_kernel("turned_stokes", _turned, 6)


@nb.njit(error_model="numpy")
def pixel_sums(
    places: Any,
    turns: Any,
    ends: Any,
    photons: int,
    lights: int,
    states: int,
    has_matrix: int,
    has_scalar: int,
    sums: Any,
) -> int:
    """Add what each photon carries to the numbers of its pixel, one photon after the other.

    Shapes: turns (photons, 2); ends (photons, ENDS + CARRIED lights states); sums (pixels, lights,
    numbers).
    """
    numbers = 16 * has_matrix + has_scalar
    for photon in range(photons):
        if places[photon] < 0:
            continue
        at = (ENDS + CARRIED * lights * states) * photon + END_LIGHTS
        to = numbers * lights * places[photon]
        cos2, sin2 = turns[2 * photon], turns[2 * photon + 1]
        for _ in range(lights):
            if has_scalar != 0:
                sums[to + numbers - 1] += ends[at + 4]
            if has_matrix != 0:
                first = _stokes(ends[at], ends[at + 1], ends[at + 2], ends[at + 3], cos2, sin2)
                for row in range(4):
                    sums[to + 4 * row] += first[row]
                for state in range(1, 4):
                    of = at + CARRIED * state
                    light = _stokes(ends[of], ends[of + 1], ends[of + 2], ends[of + 3], cos2, sin2)
                    for row in range(4):
                        sums[to + 4 * row + state] += light[row] - first[row]
            at += CARRIED * states
            to += numbers
    return photons
