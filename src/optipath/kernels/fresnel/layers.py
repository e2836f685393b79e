"""Stacks of smooth layers, thick enough that light which has gone round adds up incoherently."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.kernels.fresnel.attenuation import attenuation
from optipath.kernels.fresnel.interference import interference
from optipath.kernels.fresnel.rounds import Face, Rounds, across, along
from optipath.kernels.numbers.elimination import is_zero

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.kernels.carriers.kernel import Kernel
    from optipath.kernels.numbers.primitives import KernelFunction, Primitives


@dataclass(frozen=True)
class Stack:
    """Makes the kernel of a stack, ``(n, ..., k, [of layers that absorb,] [n0,] cos, sin)``.

    The indices, front medium first and substrate last, are followed by the k of the substrate.
    Where layers absorb, there follow the k of each of these, then the length of each, and the
    wavelength in vacuum. Layers are added one after the other; the intensities along s and
    along p go their own ways, and (S2, S3) together, the complex C + iS of a boundary being what
    multiplies S2 - iS3.
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

        def stacked(*given: Any) -> tuple[Any, ...]:
            pile = self._pile(given)
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

    def _pile(self, given: Sequence[Any]) -> _Pile:
        """Return what is given, each where it belongs."""
        *numbers, c, s = given
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
        given = (*front, *behind, *pile.angle_in(place))
        reflected = _made(xp, self.reflection, given)
        passed = back = _made(xp, self.transmission, given)
        of_front, of_behind = (not is_zero(k) for _, k in (front, behind))
        # No light comes from behind the last.
        if place + 2 == len(pile.media) or not (of_front or of_behind):
            of_behind = False
        else:
            back = _made(xp, self.from_behind, given)
        beside: tuple[Any, ...] = (None, None, None, None)
        if of_front or of_behind:
            beside = xp.apart(interference(xp))(*front, *behind, *pile.angle)
        return Face(
            reflected,
            passed,
            back,
            beside[:2] if of_front and place else None,
            beside[2:] if of_behind else None,
        )

    def _way(self, xp: Primitives, pile: _Pile, place: int) -> tuple[Any, Any] | None:
        """Return what is left behind a layer and what is not; nothing where it is lossless."""
        if place not in pile.lengths:
            return None
        given = *pile.media[place], pile.lengths[place], pile.wavelength, *pile.angle
        left, absorbed = xp.apart(attenuation(xp))(*given)
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


def _made(xp: Primitives, kernel: Kernel, given: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the five numbers of a boundary, by the cheapest kernel."""
    cheapest, left = kernel.specialised(given, is_zero)
    numbers: tuple[Any, ...] = xp.apart(cheapest.made_for(xp))(*left)
    return numbers
