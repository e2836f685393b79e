"""What a medium does along the way: what commutes stays apart, what does not is done at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.circular_axes import along_circular_axes
from optipath.elements.coupling import turned
from optipath.elements.known_sizes import largest, vanishes
from optipath.kernels.catalogue import (
    ABSORPTION_ALONG,
    ABSORPTION_BESIDE_DICHROISM,
    DEPOLARIZATION_ALONG,
    DEPOLARIZING_DICHROISM_ALONG,
    DEXTROROTATION_ALONG,
    DICHROISM_ALONG,
    DICHROISM_AND_RETARDANCE_ALONG,
    RETARDANCE_ALONG,
    ROTATION_ALONG,
    THIRD_BESIDE_DICHROISM,
    THIRD_OF_ABSORPTION,
)
from optipath.values.arrays.read_only import same
from optipath.values.operation import Operation

if TYPE_CHECKING:
    from optipath.kernels.carriers.kernel import Kernel

_FAR = 50.0
"""From what absorption times length on it is done in three steps, each within any precision."""


def operations_along(medium: Any) -> tuple[Operation, ...]:
    """Return what a `Medium` does along the way, but for what is known to be 0.

    Where dichroism is, the absorption is that of the state that is absorbed least, and what
    stands beside it takes nothing from that one: no exponential is too large.
    """
    linear, circular = not vanishes(medium.dichroism), not vanishes(medium.circular_dichroism)
    rotates = not (vanishes(medium.rotation) and vanishes(medium.dextrorotation))
    retards, depolarizes = not vanishes(medium.retardance), not vanishes(medium.depolarization)
    absorbing = _absorbing(medium, dichroic=linear or circular)
    if depolarizes and (linear or circular):
        return *absorbing, *_together(medium, DEPOLARIZING_DICHROISM_ALONG, medium.depolarization)
    depolarizing = _along(medium, DEPOLARIZATION_ALONG, medium.depolarization)
    two_axes = linear and retards and not same(medium.angle, medium.dichroic_axis)
    if two_axes or ((linear or retards) and (circular or rotates)):
        at_once = _together(medium, DICHROISM_AND_RETARDANCE_ALONG)
    elif linear:
        at_once = _filtering_along_axis(medium)
    elif circular:
        at_once = (*_rotating(medium), *_filtering_circularly(medium))
    else:
        at_once = (*_rotating(medium), *_retarding(medium))
    return *absorbing, *depolarizing, *at_once


def _absorbing(medium: Any, *, dichroic: bool) -> tuple[Operation, ...]:
    is_far = largest(medium.absorption) * largest(medium.length) > _FAR
    count = 3 if is_far else 1
    if dichroic:
        kernel = THIRD_BESIDE_DICHROISM if is_far else ABSORPTION_BESIDE_DICHROISM
        rates = medium.absorption, medium.dichroism, medium.circular_dichroism
        return count * (Operation(kernel, (*rates, medium.length)),)
    kernel = THIRD_OF_ABSORPTION if is_far else ABSORPTION_ALONG
    return count * _along(medium, kernel, medium.absorption)


def _rotating(medium: Any) -> tuple[Operation, ...]:
    rotating = _along(medium, ROTATION_ALONG, medium.rotation)
    return rotating + _along(medium, DEXTROROTATION_ALONG, medium.dextrorotation)


def _retarding(medium: Any) -> tuple[Operation, ...]:
    retarding = _along(medium, RETARDANCE_ALONG, medium.retardance)
    return turned(medium.angle, *retarding) if retarding else ()


def _filtering_along_axis(medium: Any) -> tuple[Operation, ...]:
    """Return linear dichroism, and retardance along the same axis."""
    rates = medium.dichroism, medium.retardance, medium.length
    return turned(medium.dichroic_axis, Operation(DICHROISM_ALONG, rates))


def _filtering_circularly(medium: Any) -> tuple[Operation, ...]:
    rates = medium.circular_dichroism, 0.0, medium.length
    return along_circular_axes(Operation(DICHROISM_ALONG, rates))


def _together(medium: Any, kernel: Kernel, *first: Any) -> tuple[Operation, ...]:
    """Return what is done at once, in the frame of the fast axis."""
    axis = medium.dichroic_axis
    angles = (0.0, 0.0) if same(axis, medium.angle) else (axis, medium.angle)
    rates = medium.dichroism, medium.circular_dichroism, medium.retardance, medium.turning
    return turned(medium.angle, Operation(kernel, (*first, *rates, *angles, medium.length)))


def _along(medium: Any, kernel: Kernel, per_metre: Any) -> tuple[Operation, ...]:
    return () if vanishes(per_metre) else (Operation(kernel, (per_metre, medium.length)),)
