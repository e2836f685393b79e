"""Compiled facets: where a ray meets one, and reflection or refraction there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numba as nb
import numpy as np

from optipath.engines.formula import Formula
from optipath.engines.symbols import OPERATIONS, SYMBOLIC, Recorder, Symbol
from optipath.kernels.carriers.structures import BLOCK, ROTATION
from optipath.kernels.facets import plane_at_facet, reflected_at_facet, refracted_at_facet
from optipath.kernels.fresnel.stable import (
    lossless_reflection,
    lossless_transmission,
    stable_reflection,
)
from optipath.surfaces.walk import layout

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.kernels.primitives import KernelFunction, Primitives


NO_FACET, LOWER, UPPER = -1, 0, 1
"""No facet of a cell, the one beside its edge along x, and the one beside its edge along y."""


@nb.njit(error_model="numpy")
def corners_of(heights: Any, corner: int, row: int) -> Any:
    """Return the heights of a cell's corners (0, 0), (1, 0), (0, 1) and (1, 1)."""
    other = corner + row
    return heights[corner], heights[corner + 1], heights[other], heights[other + 1]


@nb.njit(error_model="numpy")
def facet_gradient(corners: Any, facet: int) -> Any:
    """Return how a facet rises from a cell's side to the next, along x and along y."""
    low, right, back, high = corners
    if facet == LOWER:
        return right - low, high - right
    return high - back, back - low


@nb.njit(error_model="numpy")
def facet_hit(corners: Any, u: float, v: float, ray: Any, span: Any, side: float, own: int) -> Any:
    """Return which facet of a cell a ray meets, and where along the ray.

    A ray hits where it approaches the plane from its side of the surface, and is at the plane or
    behind it where it leaves the facet: a ray can slip through no edge.
    """
    _, dx, dy, _ = ray
    enters, leaves = span
    apart, along = u - v, dx - dy
    first = own
    if own == NO_FACET:
        at = apart + enters * along
        first = LOWER if at > 0.0 or (at == 0.0 and along > 0.0) else UPPER
    at = apart + leaves * along
    last = LOWER if at > 0.0 or (at == 0.0 and along < 0.0) else UPPER
    cut = leaves
    if first != last:
        # A ray may start from one facet and go along the diagonal.
        cut = min(max(-apart / along, enters), leaves) if along != 0.0 else enters
    if own == NO_FACET:
        t = _met(corners, u, v, ray, (enters, cut), side, first)
        if t >= 0.0:
            return first, t
    if first != last:
        t = _met(corners, u, v, ray, (cut, leaves), side, last)
        if t >= 0.0:
            return last, t
    return NO_FACET, 0.0


@nb.njit(error_model="numpy")
def _met(corners: Any, u: float, v: float, ray: Any, span: Any, side: float, facet: int) -> Any:
    """Return where a ray meets the plane of a facet between two places, or -1."""
    (z, dx, dy, dz), (enters, leaves) = ray, span
    rise_x, rise_y = facet_gradient(corners, facet)
    rate = dz - (dx * rise_x + dy * rise_y)
    above = (z - corners[0]) - (u * rise_x + v * rise_y)
    if side * rate < 0.0 and side * (above + leaves * rate) <= 0.0:
        return min(max(-above / rate, enters), leaves)
    return -1.0


@nb.njit(error_model="numpy")
def facet_normal(meshes: Any, layer: int, column: int, line: int, facet: int, side: float) -> Any:
    """Return the normal of a facet, on one side of it."""
    wholes, numbers, heights = meshes[0], meshes[1], meshes[2]
    about, sizes = layer * layout.WHOLES, layer * layout.NUMBERS
    row = wholes[about + layout.CELLS_X] + 1
    corner = wholes[about + layout.HEIGHTS] + line * row + column
    rise_x, rise_y = facet_gradient(corners_of(heights, corner, row), facet)
    x, y = -rise_x / numbers[sizes + layout.CELL_X], -rise_y / numbers[sizes + layout.CELL_Y]
    size = side / np.sqrt(x * x + y * y + 1.0)
    return x * size, y * size, size


@nb.njit(error_model="numpy")
def facet_event(
    k: Any, x: Any, normal: Any, indices: Any, base: Any, lights: Any, count: int, state: Any
) -> Any:
    """Reflect a photon with probability (Rs + Rp) / 2, else refract it; divide by that share."""
    n1, n2 = indices
    c, s, sx, sy, sz, cos2, sin2, rx, ry, rz = plane(*k, *x, *normal)
    if n2 == layout.OPAQUE:
        numbers = opaque_reflection(n1, base[0], base[1], c, s)
        for each in range(count):
            at = 2 * each
            # Several states of one light share an index.
            if each > 0 and (base[at] != base[at - 2] or base[at + 1] != base[at - 1]):
                numbers = opaque_reflection(n1, base[at], base[at + 1], c, s)
            _act(lights, layout.CARRIED * each, cos2, sin2, numbers)
            lights[layout.CARRIED * each + 4] *= 0.5 * (numbers[0] + numbers[1])
        return True, (rx, ry, rz), (sx, sy, sz), (c, s, cos2, sin2, 1.0)
    Fs, Fp, B, C, S, Ts, Tp, Bt, Ct, tx, ty, tz = boundary(n1, n2, c, s, *k, *normal)
    reflected = uniform(state) < 0.5 * (Fs + Fp)
    if not reflected:
        Fs, Fp, B, C, S = Ts, Tp, Bt, Ct, 0.0
        rx, ry, rz = tx, ty, tz
    share = 0.5 * (Fs + Fp)
    weight = 1.0 / share
    numbers = weight * Fs, weight * Fp, weight * B, weight * C, weight * S
    for each in range(count):
        _act(lights, layout.CARRIED * each, cos2, sin2, numbers)
    return reflected, (rx, ry, rz), (sx, sy, sz), (c, s, cos2, sin2, share)


@nb.njit(error_model="numpy")
def _act(lights: Any, at: int, cos2: float, sin2: float, numbers: Any) -> None:
    """Turn one light into the plane of incidence, and let a Mueller matrix act on it."""
    result = acted(lights[at], lights[at + 1], lights[at + 2], lights[at + 3], cos2, sin2, *numbers)
    lights[at], lights[at + 1], lights[at + 2], lights[at + 3] = result


def compiled_kernel(
    name: str, kernel: Callable[[Primitives], Callable[..., Sequence[Any]]], argument: int
) -> Any:
    """Return a kernel as a function of Numba, common terms found once."""
    recorder = Recorder(np.dtype(float))
    inputs = [recorder.input(f"a{place}") for place in range(argument)]
    formula = Formula(recorder.dtype, tuple(kernel(SYMBOLIC)(*inputs)))
    lines = [f"def {name}({', '.join(map(_written, inputs))}):"]
    for step in formula.steps:
        text = OPERATIONS[step.operation].text.format(*map(_written, step.operands))
        lines.append(f"    {_written(step)} = {text}")
    lines.append(f"    return ({', '.join(map(_written, formula.results))},)")
    space: dict[str, Any] = {**_SPACE, "__name__": __name__}
    exec("\n".join(lines), space)  # noqa: S102 - our own
    # With the flags of the loops that it goes into: nothing is an error, all is a number.
    return nb.njit(space[name], error_model="numpy")


def _written(operand: Any) -> str:
    if isinstance(operand, Symbol):
        return f"t{operand.index}"
    return repr(operand.item() if isinstance(operand, np.generic) else operand)


@nb.njit(error_model="numpy")
def exponent(number: Any) -> Any:
    """Return the exponent that frexp gives."""
    wide = np.float64(number)
    small = np.int64(abs(wide) < 2.2250738585072014e-308)
    bits = np.float64(wide * (1.0 + small * 18014398509481983.0)).view(np.int64)
    return (((bits >> 52) & 2047) - 1022 - 54 * small) * np.int64(wide != 0.0)


@nb.njit(error_model="numpy")
def ldexp(number: Any, power: Any) -> Any:
    """Return a number times two to a power, in double precision."""
    power = min(max(power, -2040), 2040)
    half = power >> 1
    first, second = np.int64((half + 1023) << 52), np.int64((power - half + 1023) << 52)
    return np.float64(number) * first.view(np.float64) * second.view(np.float64)


_SPACE = {"sqrt": np.sqrt, "inf": np.inf, "nan": np.nan, "exponent": exponent, "ldexp": ldexp}


def _plane(xp: Primitives) -> KernelFunction:
    """Make ``(k, x, normal) -> (cos, sin, s, cos 2a, sin 2a, direction of the reflection)``."""
    plane = plane_at_facet(xp)

    def met(*numbers: Any) -> tuple[Any, ...]:
        k, x, normal = numbers[:3], numbers[3:6], numbers[6:]
        cos, sin, s, *turn = plane(k, x, normal)
        return cos, sin, *s, *turn, *reflected_at_facet(k, normal, cos)

    return met


def _boundary(xp: Primitives) -> KernelFunction:
    """Make ``(n1, n, cos, sin, k, normal) -> (of what is reflected, of what is not, direction)``.

    Of what is let through, Ts, Tp, B and C: its S is 0.
    """
    reflect, transmit = lossless_reflection(xp), lossless_transmission(xp)
    refract = refracted_at_facet(xp)

    def met(n1: Any, n: Any, cos: Any, sin: Any, *vectors: Any) -> tuple[Any, ...]:
        let_through = transmit(n1, n, cos, sin)[:4]
        direction = refract(n1, n, vectors[:3], vectors[3:], cos, sin)
        return *reflect(n1, n, cos, sin), *let_through, *direction

    return met


def _acted(xp: Primitives) -> KernelFunction:
    """Make ``(carried, cos 2a, sin 2a, Fs, Fp, B, C, S) -> carried``: turned, then met."""

    def acted(a: Any, b: Any, c: Any, d: Any, cos: Any, sin: Any, *block: Any) -> tuple[Any, ...]:
        return BLOCK.action(xp, block, ROTATION.action(xp, (cos, sin), (a, b, c, d), 4), 4)

    return acted


plane = compiled_kernel("plane", _plane, 9)
boundary = compiled_kernel("boundary", _boundary, 10)
opaque_reflection = compiled_kernel("opaque_reflection", stable_reflection, 5)
acted = compiled_kernel("acted", _acted, 11)


_ONE = np.uint64(1)
_SHIFTS = np.uint64(11), np.uint64(3), np.uint64(24), np.uint64(40)
_STEP = 2.0**-53


@nb.njit(error_model="numpy")
def uniform(state: Any) -> float:
    """Return a number in [0, 1), and advance the state: ``Generator(SFC64).random()`` of NumPy."""
    right, left, around, back = _SHIFTS
    a, b, c, counter = state[0], state[1], state[2], state[3]
    result = a + b + counter
    state[0] = b ^ (b >> right)
    state[1] = c + (c << left)
    state[2] = ((c << around) | (c >> back)) + result
    state[3] = counter + _ONE
    return np.float64(result >> right) * _STEP
