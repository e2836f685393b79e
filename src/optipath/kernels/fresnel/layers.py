"""Stacks of thick layers: multiple reflections that add as intensities, and absorption."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from optipath.kernels.carriers.structures import grey_block
from optipath.kernels.fresnel.boundary import squared_along_normal
from optipath.kernels.fresnel.stable import interference
from optipath.kernels.linear_solve import Elimination, is_zero
from optipath.kernels.vectors import brought_near_one, complex_root, from_within

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from optipath.kernels.kernel import Kernel
    from optipath.kernels.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class Stack:
    """Makes the kernel of a stack, ``(n, ..., k, [of layers that absorb,] [n0,] cos, sin)``.

    The indices, front medium first and substrate last, are followed by the k of the substrate;
    where layers absorb, by the k and then the length of each, and the wavelength in vacuum. Layers
    are added one by one: s, p and (S2, S3) each by itself, the complex C + iS multiplying S2 - iS3.
    """

    reflection: Kernel
    transmission: Kernel
    from_behind: Kernel
    wanted: str
    measured: str
    absorbing: tuple[int, ...] = ()
    unpolarising: bool = False

    def __call__(self, xp: Primitives) -> KernelFunction:
        """Return the kernel in terms of these primitives."""

        def stacked(*argument: Any) -> tuple[Any, ...]:
            pile = self._pile(argument)
            faces = [self._face(xp, pile, place) for place in range(len(pile.media) - 1)]
            ways = [self._way(xp, pile, place) for place in range(1, len(pile.media) - 1)]
            lit = [face.unpolarising() for face in faces] if self.unpolarising else faces
            s, p = (Rounds(xp, [along(face, part) for face in lit], ways) for part in (0, 1))
            if self.wanted == "absorbed":
                pairs = zip(s.absorbed(), p.absorbed(), strict=True)
                return tuple(share for pair in pairs for share in pair)
            (Fs,), (Fp,) = s.came_out(self.wanted), p.came_out(self.wanted)
            # Where light is turned over at each reflection, S2 and S3 are those of -(S2, S3).
            sign = xp.where(faces[0].reflected[3] < 0.0, -1.0, 1.0)
            both = Rounds(xp, [across(xp, face, sign) for face in faces], ways)
            C, minus_s = both.came_out(self.wanted)
            if self.wanted == "reflected":
                C, minus_s = sign * C, sign * minus_s
            return Fs, Fp, 0.5 * (Fs - Fp), C, -minus_s

        return stacked

    def _pile(self, arguments: Sequence[Any]) -> _Pile:
        """Return what is given, each where it belongs."""
        *numbers, c, s = arguments
        before = (numbers.pop(),) if self.measured == "before" else ()
        count = len(self.absorbing)
        wavelength = numbers.pop() if count else None
        *numbers, last = numbers[: len(numbers) - 2 * count], numbers[len(numbers) - 2 * count :]
        *indices, k = numbers[0]
        extinction = dict.fromkeys(range(len(indices)), 0.0)
        extinction |= {len(indices) - 1: k} | dict(zip(self.absorbing, last, strict=False))
        lengths = dict(zip(self.absorbing, last[count:], strict=True))
        media = [*zip(indices, extinction.values(), strict=True)]
        measured_at = None if before else len(media) - 1 if self.measured == "behind" else 0
        n0 = before[0] if before else indices[measured_at or 0]
        return _Pile(media, lengths, wavelength, measured_at, (n0, c, s))

    def _face(self, xp: Primitives, pile: _Pile, place: int) -> Face:
        """Return what the boundary behind a medium does to light from either side."""
        front, behind = pile.media[place : place + 2]
        arguments = (*front, *behind, *pile.angle_in(place))
        reflected = _made(xp, self.reflection, arguments)
        passed = back = _made(xp, self.transmission, arguments)
        of_front, of_behind = (not is_zero(k) for _, k in (front, behind))
        # No light comes from behind the last.
        if place + 2 == len(pile.media) or not (of_front or of_behind):
            of_behind = False
        else:
            back = _made(xp, self.from_behind, arguments)
        beside = interference_behind = None
        if of_front or of_behind:
            *before, Is, Ip = xp.apart(interference(xp))(*front, *behind, *pile.angle)
            beside = tuple(before) if of_front and place else None
            interference_behind = (Is, Ip) if of_behind else None
        return Face(reflected, passed, back, beside, interference_behind)

    def _way(self, xp: Primitives, pile: _Pile, place: int) -> tuple[Any, Any] | None:
        """Return what is left behind a layer and what is not; nothing where it is lossless."""
        if place not in pile.lengths:
            return None
        arguments = *pile.media[place], pile.lengths[place], pile.wavelength, *pile.angle
        left, absorbed = xp.apart(attenuation(xp))(*arguments)
        return left, absorbed


class _Pile(NamedTuple):
    """What a stack is made of, and the angle of its light."""

    media: list[tuple[Any, Any]]
    lengths: dict[int, Any]
    wavelength: Any
    measured_at: int | None
    angle: tuple[Any, Any, Any]

    def angle_in(self, place: int) -> tuple[Any, ...]:
        """Return the angle as a boundary lit from a medium is given it."""
        return self.angle[1:] if place == self.measured_at else self.angle


def _made(xp: Primitives, kernel: Kernel, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the five numbers of a boundary, by the cheapest kernel."""
    cheapest, left = kernel.specialised(arguments, is_zero)
    numbers: tuple[Any, ...] = xp.apart(cheapest.made_for(xp))(*left)
    return numbers


Rows: TypeAlias = tuple[tuple[Any, ...], ...]
"""What becomes of some parts of light: rows of a small matrix."""

_LITTLE = 1e-3


class Face(NamedTuple):
    """The numbers of a boundary, (Fs, Fp, B, C, S) each."""

    reflected: tuple[Any, ...]
    passed: tuple[Any, ...]
    back: tuple[Any, ...]
    beside: tuple[Any, Any] | None
    interference_behind: tuple[Any, Any] | None

    def unpolarising(self) -> Face:
        """Return a boundary that does to s and to p what this one does to both on average."""
        passed = tuple(grey_block(self.passed))
        back = passed if self.back is self.passed else tuple(grey_block(self.back))
        others = (
            None if pair is None else (0.5 * (pair[0] + pair[1]),) * 2
            for pair in (self.beside, self.interference_behind)
        )
        return Face(tuple(grey_block(self.reflected)), passed, back, *others)


class Side(NamedTuple):
    """What becomes of some parts of light that comes to a boundary from one side."""

    passed: Rows
    stays: tuple[Any, ...]
    leaves: tuple[tuple[Any, ...], tuple[Any, ...]]
    sizes: tuple[tuple[Any, ...], tuple[Any, ...]]


class Parts(NamedTuple):
    """What a boundary does to some parts of light."""

    reflected: Rows
    sides: tuple[Side, Side]


def along(face: Face, part: int) -> Parts:
    """Return what a boundary does to the intensity along s, or along p."""

    def side(passed: tuple[Any, ...], others: tuple[Any, Any] | None) -> Side:
        T = passed[part]
        if others is None:
            return Side(((T,),), (0.0,), ((T,), (0.0,)), ((T,), (0.0,)))
        stays = others[part]
        size = abs(stays)
        return Side(((T,),), (stays,), ((T + stays,), (stays,)), ((T + size,), (size,)))

    return Parts(((face.reflected[part],),), _both_sides(face, side))


def across(xp: Primitives, face: Face, sign: Any) -> Parts:
    """Return what a boundary does to (S2, S3), of which a sign is taken at each reflection.

    What is left of 1 when C and that of the other side are taken away is the sum of what each
    leaves of (Fs + Fp) / 2, which is not computed as a difference where C is near to that.
    """
    Fs, Fp, B, *turned = face.reflected
    C, S = (sign * number for number in turned)
    missing = _interference(xp, Fs, Fp, B, C, S)

    def side(passed: tuple[Any, ...], others: tuple[Any, Any] | None) -> Side:
        Ts, Tp, D, c, s = passed
        out, on = missing + 0.5 * (Ts + Tp), missing + _interference(xp, Ts, Tp, D, c, s)
        if others is None:
            leaves = (out + S, out - S), (on + S + s, on - S - s)
            return Side(_rows(c, s), (0.0, 0.0), leaves, leaves)
        stays = 0.5 * (others[0] + others[1])
        size = 0.5 * (abs(others[0]) + abs(others[1])) + abs(S)
        sizes = 2 * (out + size,), 2 * (on + size + abs(s),)
        out, on = out + stays, on + stays
        return Side(
            _rows(c, s), (stays, stays), ((out + S, out - S), (on + S + s, on - S - s)), sizes
        )

    return Parts(_rows(C, S), _both_sides(face, side))


def _both_sides(face: Face, side: Callable[..., Side]) -> tuple[Side, Side]:
    """Return what happens to light from in front, and from behind."""
    front = side(face.passed, face.beside)
    if face.back is face.passed and face.beside is None and face.interference_behind is None:
        return front, front
    return front, side(face.back, face.interference_behind)


def _interference(xp: Primitives, Fs: Any, Fp: Any, B: Any, C: Any, S: Any) -> Any:
    """Return (Fs + Fp) / 2 - C, where Fs Fp = C^2 + S^2."""
    # Below, the difference has digits enough beside what else leaves.
    both, near = Fs + Fp, C > _LITTLE
    small = 2.0 * (B * B + S * S) / xp.where(near, both + 2.0 * C, 1.0)
    return xp.where(near, small, 0.5 * both - C)


def _rows(C: Any, S: Any) -> Rows:
    return (C, S), (-S, C)


class Rounds:
    """Some parts of light between boundaries, for a unit of the first part from the front."""

    def __init__(
        self,
        xp: Primitives,
        faces: Sequence[Parts],
        ways: Sequence[tuple[Any, Any] | None],
    ) -> None:
        self.xp, self.faces, self.ways = xp, faces, ways
        self.width = len(faces[0].reflected)

    def came_out(self, wanted: str) -> list[Any]:
        """Return what is reflected by all, or has passed all."""
        through = wanted == "transmitted"
        first, last = self.faces[0], self.faces[-1]
        direct = [row[0] for row in first.reflected]
        if not self.ways:
            return [row[0] for row in first.sides[0].passed] if through else direct
        lights = self._lights()
        if through:
            return _times(last.sides[0].passed, _left(self.ways[-1], lights[-1][0]))
        back = _times(first.sides[1].passed, _left(self.ways[0], lights[0][1]))
        return [one + other for one, other in zip(direct, back, strict=True)]

    def absorbed(self) -> list[Any]:
        """Return how much of the light stays in each layer."""
        if not self.ways:
            return []
        results = []
        for layer, (way, (down, up)) in enumerate(zip(self.ways, self._lights(), strict=True)):
            stays: Any = 0.0
            if way is not None:
                left, absorbed = way
                behind, before = self.faces[layer + 1].sides[0], self.faces[layer].sides[1]
                stays = (absorbed + left * behind.stays[0]) * down[0]
                stays = stays + (absorbed + left * before.stays[0]) * up[0]
            results.append(stays)
        return results

    def _lights(self) -> list[tuple[list[Any], list[Any]]]:
        """Return the light that begins each way down, and each way up, in each layer."""
        width, columns = self.width, [*self._columns()]
        absorbs = any(way is not None for way in self.ways)
        system = Elimination(
            self.xp,
            [back for back, _, _ in columns],
            [leaves for _, leaves, _ in columns],
            [True] * len(columns),
            sizes=[size for _, _, size in columns] if absorbs else None,
        )
        first = [row[0] for row in self.faces[0].sides[0].passed]
        result = system.solved([*first, *[0.0] * (len(columns) - width)])
        places = range(0, len(columns), 2 * width)
        return [(result[at : at + width], result[at + width : at + 2 * width]) for at in places]

    def _columns(self) -> Iterator[tuple[dict[int, Any], Any, Any]]:
        """Yield what becomes of a unit of light that goes down, or up, in each layer.

        The unknowns are the light below each boundary but the last: first down, then up.
        """
        width, layers = self.width, len(self.ways)
        for layer, way in enumerate(self.ways):
            down, up = 2 * width * layer, 2 * width * layer + width
            meets = (
                # What goes down meets the boundary behind the layer; what goes up, the one before.
                (layer + 1, 0, up, down + 2 * width if layer + 1 < layers else None),
                (layer, 1, down, up - 2 * width if layer else None),
            )
            for boundary, side, turned, onwards in meets:
                face = self.faces[boundary]
                yield from _parted(face.reflected, face.sides[side], way, turned, onwards)


def _parted(
    reflected: Rows, side: Side, way: tuple[Any, Any] | None, turned: int, onwards: int | None
) -> Iterator[tuple[dict[int, Any], Any, Any]]:
    """Yield what of each part of light comes back as what, what leaves, and the size of that."""
    for part in range(len(reflected)):
        back = {turned + i: row[part] for i, row in enumerate(reflected)}
        if onwards is not None:
            back |= {onwards + i: row[part] for i, row in enumerate(side.passed)}
        goes_on = onwards is not None
        leaves, size = side.leaves[goes_on][part], side.sizes[goes_on][part]
        if way is not None:
            left, absorbed = way
            back = {to: left * gain for to, gain in back.items()}
            leaves, size = absorbed + left * leaves, absorbed + left * size
        yield back, leaves, size


def _left(way: tuple[Any, Any] | None, parts: Sequence[Any]) -> Sequence[Any]:
    """Return what is left of light behind its way through a layer."""
    return parts if way is None else [way[0] * part for part in parts]


def _times(rows: Rows, parts: Sequence[Any]) -> list[Any]:
    return [reduce(add, (g * p for g, p in zip(row, parts, strict=True))) for row in rows]


_LEAST = 2.0**-53
"""What a number times this underflows to 0 is close to where digits get lost."""

_ODD = tuple(range(15, 0, -2))
"""Down to 1, from where a fraction of them is right to the last digit of a long double."""


def attenuation(xp: Primitives) -> KernelFunction:
    """Make ``(n, k, length, wavelength, n0, cos, sin) -> (left, absorbed)``, which add up to 1.

    The angle is in a medium n0 before parallel boundaries. Once down, left = exp(-x), x = 4 pi
    Im(g) length / wavelength, with g = sqrt(m^2 - (n0 sin)^2), the wave along the normal (Byrnes,
    arXiv:1603.02720, sec. on incoherent layers); 0 where it would underflow.
    """
    wave, where, exp, missing = _decay(xp), xp.where, xp.exp, _one_less_exponential(xp)

    def attenuate(n: Any, k: Any, length: Any, wavelength: Any, *angle: Any) -> tuple[Any, ...]:
        x = 4.0 * math.pi * wave(n, k, *angle) * (length / wavelength)
        left = exp(-x)
        return where(left * _LEAST > 0.0, left, 0.0), missing(x, left)

    return attenuate


def _decay(xp: Primitives) -> Callable[..., Any]:
    """Make ``(n, k, n0, cos, sin) -> Im g``, without loss however weakly the layer absorbs."""
    divided, root, cosine = brought_near_one(xp), complex_root(xp), from_within(xp)
    scaling, ldexp, maximum, inside = xp.scaling, xp.ldexp, xp.maximum, from_within(xp, 6)

    def decay(n: Any, k: Any, n0: Any, c: Any, s: Any) -> Any:
        k = inside(xp.absolute(k))
        exponent = scaling(reduce(maximum, (n, k, n0)))
        n, k, n0 = divided(n, k, n0)
        along, _ = squared_along_normal(xp, n0, cosine(c), s)
        return ldexp(root(along(n) - k * k, n, k)[1], exponent)

    return decay


def _one_less_exponential(xp: Primitives) -> Callable[[Any, Any], Any]:
    """Make ``(x, exp(-x)) -> 1 - exp(-x)`` for x >= 0, by sums of what is not negative.

    Up to 1 it is 2 / (1 + coth y) with y = x / 2, and y coth y = 1 + y^2 / (3 + y^2 / (5 + ...)
    is Lambert's continued fraction (Abramowitz & Stegun 4.5.70).
    """
    where, minimum = xp.where, xp.minimum

    def lost(x: Any, left: Any) -> Any:
        y = 0.5 * minimum(x, 1.0)
        square = y * y
        hyperbolic = reduce(lambda below, odd: odd + square / below, _ODD[1:], 1.0 * _ODD[0])
        return where(x < 1.0, 2.0 * y / (y + hyperbolic), 1.0 - left)

    return lost
