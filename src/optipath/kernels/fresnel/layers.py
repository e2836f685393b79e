"""Stacks of smooth layers, thick enough that light which has gone round adds up incoherently."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from optipath.kernels.numbers.elimination import Elimination, is_zero

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels.carriers.kernel import Kernel
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives

Rows: TypeAlias = tuple[tuple[Any, ...], ...]
"""What becomes of some parts of light: rows of a small matrix."""


class Boundaries(NamedTuple):
    """What the boundaries of a stack do to some parts of light, from the front to the back.

    Attributes
    ----------
    reflected, transmitted : list of Rows
        The same from either side.
    leaves : list of (tuple, tuple)
        What of each part is neither reflected nor let through into another layer: at a boundary
        behind which the light is out of the stack, and at one behind which it is not.
    """

    reflected: list[Rows]
    transmitted: list[Rows]
    leaves: list[tuple[tuple[Any, ...], tuple[Any, ...]]]


@dataclass(frozen=True)
class Stack:
    """Makes the kernel of a stack, ``(n, ..., k, [n0,] cos, sin) -> (Fs, Fp, B, C, S)``.

    Of the indices, front medium first and substrate last, only the last has a k. Layers are
    added one after the other; the intensities along s and along p go their own ways, and
    (S2, S3) together, the complex C + iS of a boundary being what multiplies S2 - iS3.

    Attributes
    ----------
    reflection, transmission : Kernel
        Of one boundary.
    through : bool
        Whether light that passes the stack is wanted, or that which comes back.
    measured : {"in front", "behind", "before"}
        Whether the incidence is that in the first medium, in the last, light coming from the
        other side, or in a medium n0 from which parallel boundaries have refracted the light.
    """

    reflection: Kernel
    transmission: Kernel
    through: bool
    measured: str

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the kernel in terms of these primitives."""

        def stacked(*given: Any) -> tuple[Any, ...]:
            *indices, c, s = given
            n0 = indices.pop() if self.measured == "before" else None
            k = indices.pop()
            measured_at = len(indices) - 1 if self.measured == "behind" else 0
            numbers = []
            for place in range(len(indices) - 1):
                before = () if place == measured_at else (indices[measured_at],)
                before = before if n0 is None else (n0,)
                absorbs = k if place == len(indices) - 2 else 0.0
                media = (*indices[place : place + 2], absorbs)
                numbers.append(self._boundary(xp, *media, *before, c, s))
            (Fs,), (Fp,) = (self._came_out(xp, _intensity(numbers, part)) for part in (0, 1))
            # Where light is turned over at each reflection, S2 and S3 are those of -(S2, S3).
            sign = xp.where(numbers[0][0][3] < 0.0, -1.0, 1.0)
            C, minus_s = self._came_out(xp, _across(xp, numbers, sign))
            if not self.through:
                C, minus_s = sign * C, sign * minus_s
            return Fs, Fp, 0.5 * (Fs - Fp), C, -minus_s

        return stacked

    def _boundary(self, xp: Primitives, *given: Any) -> tuple[Any, Any]:
        """Return the five numbers of the reflection, and those of the transmission."""
        cheapest = (k.specialised(given, is_zero) for k in (self.reflection, self.transmission))
        reflected, transmitted = (xp.apart(kernel.made_for(xp))(*left) for kernel, left in cheapest)
        return reflected, transmitted

    def _came_out(self, xp: Primitives, at: Boundaries) -> list[Any]:
        """Return what comes out of a unit of the first part of light from the front."""
        width = len(at.reflected[0])
        first = [row[0] for row in at.transmitted[0]]
        if len(at.reflected) == 1:
            return first if self.through else [row[0] for row in at.reflected[0]]
        columns = _columns(at)
        system = Elimination(
            xp,
            [back for back, _ in columns],
            [leaves for _, leaves in columns],
            [True] * len(columns),
        )
        lights = system.solved([*first, *[0.0] * (len(columns) - width)])
        down, up = lights[-2 * width : -width], lights[width : 2 * width]
        if self.through:
            return _times(at.transmitted[-1], down)
        direct = [row[0] for row in at.reflected[0]]
        return [
            one + other for one, other in zip(direct, _times(at.transmitted[0], up), strict=True)
        ]


_LITTLE = 1e-3


def _intensity(numbers: Sequence[Any], part: int) -> Boundaries:
    """Return what boundaries do to the intensity along s, or along p."""
    reflected: list[Rows] = [((pair[0][part],),) for pair in numbers]
    transmitted: list[Rows] = [((pair[1][part],),) for pair in numbers]
    leaves: list[Any] = [((pair[1][part],), (0.0,)) for pair in numbers]
    return Boundaries(reflected, transmitted, leaves)


def _across(xp: Primitives, numbers: Sequence[Any], sign: Any) -> Boundaries:
    """Return what boundaries do to (S2, S3), of which a sign is taken at each reflection.

    What is left of 1 when C and that of the other side are taken away is the sum of what each
    leaves of (Fs + Fp) / 2, which is not computed as a difference where C is near to that.
    """
    reflected, transmitted, leaves = [], [], []
    for (Fs, Fp, B, *turned), (Ts, Tp, D, c, s) in numbers:
        C, S = (sign * number for number in turned)
        reflected.append(_rows(C, S))
        transmitted.append(_rows(c, s))
        lost = _beside(xp, Fs, Fp, B, C, S)
        out, on = lost + 0.5 * (Ts + Tp), lost + _beside(xp, Ts, Tp, D, c, s)
        leaves.append(((out + S, out - S), (on + S + s, on - S - s)))
    return Boundaries(reflected, transmitted, leaves)


def _beside(xp: Primitives, Fs: Any, Fp: Any, B: Any, C: Any, S: Any) -> Any:
    """Return (Fs + Fp) / 2 - C, where Fs Fp = C^2 + S^2."""
    # Below, the difference has digits enough beside what else leaves.
    both, near = Fs + Fp, C > _LITTLE
    small = 2.0 * (B * B + S * S) / xp.where(near, both + 2.0 * C, 1.0)
    return xp.where(near, small, 0.5 * both - C)


def _rows(C: Any, S: Any) -> Rows:
    return (C, S), (-S, C)


def _columns(at: Boundaries) -> list[tuple[dict[int, Any], Any]]:
    """Return what becomes of a unit of light that goes down, or up, in each layer.

    The unknowns are the parts of the light below each boundary but the last, layer by layer:
    first those that go down, then those that go up.
    """
    width, layers, columns = len(at.reflected[0]), len(at.reflected) - 1, []
    for layer in range(layers):
        down, up = 2 * width * layer, 2 * width * layer + width
        ways = (
            # What goes down meets the boundary behind the layer; what goes up, the one before.
            (layer + 1, up, down + 2 * width if layer + 1 < layers else None),
            (layer, down, up - 2 * width if layer else None),
        )
        for boundary, turned, onwards in ways:
            for part in range(width):
                back = {turned + i: row[part] for i, row in enumerate(at.reflected[boundary])}
                passed = [row[part] for row in at.transmitted[boundary]]
                if onwards is not None:
                    back |= {onwards + i: number for i, number in enumerate(passed)}
                leaves = at.leaves[boundary][onwards is not None][part]
                columns.append((back, leaves))
    return columns


def _times(rows: Rows, parts: Sequence[Any]) -> list[Any]:
    return [reduce(add, (g * p for g, p in zip(row, parts, strict=True))) for row in rows]
