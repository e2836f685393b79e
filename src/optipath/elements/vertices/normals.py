"""The check of normals against those that the vertices of a chain have."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.elements.vertices.naming import of_chain, pieces_of
from optipath.errors import ShapeError, ValueFault, shown
from optipath.values.arrays.array_likes import as_given
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.roundings import as_doubles, rounding_of

if TYPE_CHECKING:
    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]

_TOLERANCE = 1e-6
_SURELY = 0.5
"""The part of the square of the tolerance that the rounding of a quick look leaves."""

_STRAIGHT = 1e-7
"""A bisector shorter than this is known to fewer digits than normals are checked to."""


def normal_faults(
    chains: Floats | None, normals: Any, count: int, sides: Floats | None = None
) -> list[str]:
    """Return which normals are not along those of their vertices, and by how much.

    That of a reflection is along the bisector k_out - k_in, and that of a refraction along
    n2 k_out - n1 k_in; between equal media any will do.

    Shapes: chains (..., count + 2, 3); normals (..., count, 3); sides (..., count, 2).

    Examples
    --------
    >>> chain = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> normal_faults(chain, [[0.0, -2.0, -2.0]], 1)
    []
    >>> normal_faults(chain, [[0.0, 0.0, 0.0]], 1)
    ['the normal of vertex 1 has no length; give one with a direction of its own']
    """
    try:
        given = as_given("the array of normals", normals)
    except ValueFault as fault:
        return list(fault.faults)
    if given.dtype.kind not in "iuf":
        return [f"normals must be real numbers, not {shown(normals)}"]
    if given.shape[-2:] != (count, 3):
        return [f"normals must have shape (..., {count}, 3), not {given.shape}"]
    tolerance = max(_TOLERANCE, 2.0 * rounding_of(given))
    given = as_doubles(given)
    if chains is None:
        return _own_faults(given.reshape(-1, count, 3), given.shape[:-2])
    sides = np.ones((count, 2)) if sides is None else sides
    shapes = {
        "vertices": chains.shape[:-2],
        "normals": given.shape[:-2],
        "materials": sides.shape[:-2],
    }
    try:
        batch = check_broadcast(shapes)
    except ShapeError as fault:
        return list(fault.faults)
    chains = np.broadcast_to(chains, (*batch, count + 2, 3)).reshape(-1, count + 2, 3)
    given = np.broadcast_to(given, (*batch, count, 3)).reshape(-1, count, 3)
    sides = np.broadcast_to(sides, (*batch, count, 2)).reshape(-1, count, 2)
    doubted = [
        piece
        for piece in pieces_of(len(given))
        if not _surely_along(chains[piece], given[piece], sides[piece])
    ]
    if not doubted:
        return []
    whole = chains, given, sides
    return _own_faults(given, batch) or _off_faults(whole, batch, doubted, tolerance)


def are_off(chains: Floats, normals: Any, sides: Floats) -> npt.NDArray[np.bool_]:
    """Return which chains have a normal that is not along that of its vertex.

    Shape: returns (...).
    """
    count = normals.shape[-2]
    tolerance = max(_TOLERANCE, 2.0 * rounding_of(normals))
    batch = np.broadcast_shapes(chains.shape[:-2], normals.shape[:-2], sides.shape[:-2])
    ends = (count + 2, 3), (count, 3), (count, 2)
    several = (chains, as_doubles(normals), sides)
    whole = [
        np.broadcast_to(each, (*batch, *end)).reshape(-1, *end)
        for each, end in zip(several, ends, strict=True)
    ]
    with np.errstate(all="ignore"):
        off = [
            np.any(_off(*(e[piece] for e in whole)) > tolerance, -1)
            for piece in pieces_of(len(whole[0]))
        ]
    return np.concatenate(off).reshape(batch)


def _own_faults(normals: Floats, batch: tuple[int, ...]) -> list[str]:
    """Return which normals are none, whatever the chain."""
    found = []
    for bad, problem in (
        (~np.isfinite(normals).all(axis=-1), "is not finite; give numbers"),
        (~normals.any(axis=-1), "has no length; give one with a direction of its own"),
    ):
        if bad.any():
            chain, place = (int(index[0]) for index in np.nonzero(bad))
            found.append(f"{_normal_of(place, chain, batch)} {problem}")
    return found


def _off_faults(
    whole: tuple[Floats, Floats, Floats],
    batch: tuple[int, ...],
    doubted: list[slice],
    tolerance: float,
) -> list[str]:
    """Return the vertex whose normal is furthest off what it must be, if any is too far."""
    worst, where, wanted = tolerance, "", ""
    for piece in doubted:
        part = [each[piece] for each in whole]
        off = _off(*part)
        chain, place = map(int, np.unravel_index(np.argmax(off), off.shape))
        if off[chain, place] > worst:
            worst = float(off[chain, place])
            where = _normal_of(place, piece.start + chain, batch)
            n1, n2 = part[2][chain, place]
            wanted = "the bisector of its legs" if n1 == n2 else "the one that refracts light so"
    sentence = (
        f"{where} is off {wanted} by {np.degrees(worst):.3g} deg; it must be "
        f"along it to within {tolerance:.2g} rad, or be left out"
    )
    return [sentence] if where else []


def _normal_of(place: int, chain: int, batch: tuple[int, ...]) -> str:
    return f"the normal of vertex {place + 1}{of_chain(chain, batch)}"


def _surely_along(chains: Floats, normals: Floats, sides: Floats) -> bool:
    """Tell, quickly, whether all normals are along those of their vertices beyond any doubt.

    By sin^2 = 1 - cos^2, whose rounding is far below the square of the tolerance.
    """
    # Component by component, each for all chains: sums of rows, and no short last axis.
    points, n, n12 = (
        np.ascontiguousarray(np.moveaxis(each, 0, -1)) for each in (chains, normals, sides)
    )
    with np.errstate(all="ignore"):
        legs = points[1:] - points[:-1]
        legs /= np.sqrt(_dot(legs, legs))[:, np.newaxis]
        b = legs[1:] * n12[:, 1, np.newaxis] - legs[:-1] * n12[:, 0, np.newaxis]
        bb, nb, nn = _dot(b, b), _dot(n, b), _dot(n, n)
        nb *= nb
        bent = bb >= _STRAIGHT * _STRAIGHT
        return bool(np.all((nn * bb - nb <= _SURELY * _TOLERANCE**2 * nb) & bent & (nb > 0.0)))


def _dot(a: Floats, b: Floats) -> Floats:
    product = a * b
    found: Floats = product[:, 0] + product[:, 1]
    found += product[:, 2]
    return found


def _off(chains: Floats, normals: Floats, sides: Floats) -> Floats:
    """Return the angles between normals and those of the vertices.

    Light that goes straight on has none: surfaces that reflect are all those along it, and
    those that refract may stand anyhow.
    """
    unit = _units(np.diff(chains, axis=-2))
    normal, (n1, n2) = _units(normals), np.moveaxis(sides, -1, 0)
    bisector = n2[..., np.newaxis] * unit[..., 1:, :] - n1[..., np.newaxis] * unit[..., :-1, :]
    along = np.abs(np.sum(normal * bisector, axis=-1))
    angle = np.arctan2(np.linalg.norm(np.cross(normal, bisector), axis=-1), along)
    straight = np.linalg.norm(bisector, axis=-1) < _STRAIGHT
    through = np.arcsin(np.minimum(np.abs(np.sum(normal * unit[..., 1:, :], axis=-1)), 1.0))
    grazes = np.where((n1 == n2) & (n1 > 0.0), through, 0.0)
    return np.asarray(np.where(straight, grazes, angle))


def _units(several: Floats) -> Floats:
    scaled = several / np.max(np.abs(several), axis=-1, keepdims=True)
    return np.asarray(scaled / np.linalg.norm(scaled, axis=-1, keepdims=True))
