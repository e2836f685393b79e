"""Light that goes to and fro between parallel boundaries, and adds up by its intensity."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from optipath.kernels.carriers.structures import grey_block
from optipath.kernels.numbers.elimination import Elimination

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from optipath.kernels.numbers.primitives import Primitives

Rows: TypeAlias = tuple[tuple[Any, ...], ...]
"""What becomes of some parts of light: rows of a small matrix."""

_LITTLE = 1e-3


class Face(NamedTuple):
    """The numbers of a boundary, (Fs, Fp, B, C, S) each."""

    reflected: tuple[Any, ...]
    passed: tuple[Any, ...]
    back: tuple[Any, ...]
    beside: tuple[Any, Any] | None
    beside_behind: tuple[Any, Any] | None

    def unpolarising(self) -> Face:
        """Return a boundary that does to s and to p what this one does to both on average."""
        passed = tuple(grey_block(self.passed))
        back = passed if self.back is self.passed else tuple(grey_block(self.back))
        beside = (
            None if pair is None else (0.5 * (pair[0] + pair[1]),) * 2
            for pair in (self.beside, self.beside_behind)
        )
        return Face(tuple(grey_block(self.reflected)), passed, back, *beside)


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

    def side(passed: tuple[Any, ...], beside: tuple[Any, Any] | None) -> Side:
        T = passed[part]
        if beside is None:
            return Side(((T,),), (0.0,), ((T,), (0.0,)), ((T,), (0.0,)))
        stays = beside[part]
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
    lost = _beside(xp, Fs, Fp, B, C, S)

    def side(passed: tuple[Any, ...], beside: tuple[Any, Any] | None) -> Side:
        Ts, Tp, D, c, s = passed
        out, on = lost + 0.5 * (Ts + Tp), lost + _beside(xp, Ts, Tp, D, c, s)
        if beside is None:
            leaves = (out + S, out - S), (on + S + s, on - S - s)
            return Side(_rows(c, s), (0.0, 0.0), leaves, leaves)
        stays = 0.5 * (beside[0] + beside[1])
        size = 0.5 * (abs(beside[0]) + abs(beside[1])) + abs(S)
        sizes = 2 * (out + size,), 2 * (on + size + abs(s),)
        out, on = out + stays, on + stays
        return Side(
            _rows(c, s), (stays, stays), ((out + S, out - S), (on + S + s, on - S - s)), sizes
        )

    return Parts(_rows(C, S), _both_sides(face, side))


def _both_sides(face: Face, side: Callable[..., Side]) -> tuple[Side, Side]:
    """Return what happens to light from in front, and from behind."""
    front = side(face.passed, face.beside)
    if face.back is face.passed and face.beside is None and face.beside_behind is None:
        return front, front
    return front, side(face.back, face.beside_behind)


def _beside(xp: Primitives, Fs: Any, Fp: Any, B: Any, C: Any, S: Any) -> Any:
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
        found = []
        for layer, (way, lights) in enumerate(zip(self.ways, self._lights(), strict=True)):
            sides = self.faces[layer + 1].sides[0], self.faces[layer].sides[1]
            found.append(
                0.0
                if way is None
                else reduce(
                    add,
                    (
                        (way[1] + way[0] * side.stays[0]) * light[0]
                        for side, light in zip(sides, lights, strict=True)
                    ),
                )
            )
        return found

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
        found = system.solved([*first, *[0.0] * (len(columns) - width)])
        places = range(0, len(columns), 2 * width)
        return [(found[at : at + width], found[at + width : at + 2 * width]) for at in places]

    def _columns(self) -> Iterator[tuple[dict[int, Any], Any, Any]]:
        """Yield what becomes of a unit of light that goes down, or up, in each layer.

        The unknowns are the parts of the light below each boundary but the last, layer by layer:
        first those that go down, then those that go up.
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
