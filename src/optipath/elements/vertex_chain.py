"""Chains of vertices: points in space or angles, checked."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, get_args
from weakref import finalize

import numpy as np

from optipath.errors import PathError, ValueFault
from optipath.faults import shown
from optipath.kernels.primitives import NUMPY
from optipath.kernels.trigonometry import cosine, sine
from optipath.kernels.vertex_chain import LONGEST, SHORTEST, PointsByAngles
from optipath.materials.quantities import ANGLE, INCIDENCE, Quantity
from optipath.values.arrays import (
    ComparedByFields,
    array_of,
    check_broadcast,
    entries_of,
    locked,
    read_only,
)
from optipath.values.domains import Choice, Domain
from optipath.values.jax_values import is_traced, namespace
from optipath.values.precision import as_doubles, held
from optipath.values.use import stored_value

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy.typing as npt


_ANGLES = {"incidences": INCIDENCE, "turns": ANGLE}


@dataclass(frozen=True, eq=False)
class VerticesByAngles(ComparedByFields):
    """The vertices of a chain of specular reflections, given by angles.

    Legs are of length 1, and the middle one runs from the world's origin along its z. Next to
    the normal and at grazing incidence, where points tell no plane of incidence, the angles do.

    Parameters
    ----------
    incidences : sequence of float, array_like or Parameter
        The angle of incidence at each reflection, in radians, in order from the light.
    turns : sequence of float, array_like or Parameter, optional
        The angle by which each next plane of incidence is turned about the direction of
        travel against the one before, right-handed; one fewer than `incidences`.
    backwards : bool, optional
        Whether light goes the other way through the same points, from the last one to the first;
        the angles are in the order from there to here then.

    Raises
    ------
    PathError
        If there is no incidence, the numbers of angles do not fit, or `backwards` is neither
        True nor False.

    Examples
    --------
    >>> import optipath as op
    >>> chain = op.VerticesByAngles(incidences=(0.3, op.Parameter("delta")), turns=(0.5,))
    >>> path = op.path_from_vertices(chain, materials=(1.5, 1.5))
    >>> list(path.parameters)
    ['delta']
    """

    incidences: tuple[Any, ...]
    turns: tuple[Any, ...] = ()
    backwards: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.backwards, bool):
            raise PathError(f"backwards must be True or False, not {shown(self.backwards)}")
        for name, domain in _ANGLES.items():
            several = enumerate(entries_of(name, "angles", getattr(self, name), PathError))
            stored = tuple(stored_value(f"{name}[{at}]", angle, domain) for at, angle in several)
            object.__setattr__(self, name, stored)
        count, turns = len(self.incidences), len(self.turns)
        if not count:
            raise PathError("vertices by angles need an incidence for each reflection; give one")
        if turns != count - 1:
            raise PathError(
                f"{counted(count, 'incidence')} and {counted(turns, 'turn')} make no chain; give "
                f"{counted(count - 1, 'turn')}, one from each plane of incidence to the next"
            )

    def parts(self, name: str) -> Iterator[tuple[str, Any, Domain]]:
        """Yield the angles: their names, values and domains."""
        for field, domain in _ANGLES.items():
            for place, angle in enumerate(getattr(self, field)):
                yield f"{name}.{field}[{place}]", angle, domain


def vertices_from_angles(
    incidences: Sequence[npt.ArrayLike], turns: Sequence[npt.ArrayLike] = ()
) -> npt.NDArray[np.float64]:
    """Return the points of a chain of m specular reflections with given angles.

    Parameters
    ----------
    incidences : sequence of m array_like
        The angles of incidence in radians, 0 to pi/2, in order from the light.
    turns : sequence of m - 1 array_like, optional
        As `VerticesByAngles` takes them.

    Returns
    -------
    ndarray, shape (..., m + 2, 3)
        From the light to the eye; legs are of length 1, the middle one along z.

    Raises
    ------
    PathError, ValueFault
        If the numbers of angles do not fit, or an angle is out of its range.

    Examples
    --------
    >>> import numpy as np
    >>> vertices_from_angles([np.pi / 4]).round(12) + 0.0
    array([[0., 0., 0.],
           [0., 0., 1.],
           [0., 1., 1.]])
    """
    chain = VerticesByAngles(incidences, turns)  # type: ignore[arg-type]
    arguments = {name: domain.check(name, angle) for name, angle, domain in chain.parts("vertices")}
    batch = check_broadcast({name: angle.shape for name, angle in arguments.items()})
    count, parts = len(chain.incidences), (cosine(NUMPY), sine(NUMPY))
    pairs = [part(angle) for angle in arguments.values() for part in parts]
    numbers = PointsByAngles(count, 0, count + 1)(NUMPY)(*pairs)
    points = np.stack([np.broadcast_to(number, batch) for number in numbers], axis=-1)
    return points.reshape(*batch, count + 2, 3)


def counted(count: int, what: str) -> str:
    """Return how many there are of something."""
    return f"{count} {what}{'s' * (count != 1)}"


_LEAST, _MOST = SHORTEST**2, LONGEST**2


@dataclass(frozen=True)
class VerticesDomain(Domain):
    """Points from the light to the eye, in the unit of any length."""

    shows_in_light = True  # Two vertices in one point have no direction.

    masks: bool = False
    ends: bool = False

    @property
    def takes_any(self) -> bool:
        """Whether any numbers are let in, which others look at."""
        return self.masks or self.ends

    def parts(self, name: str, value: Any) -> list[tuple[str, Any, Domain]]:
        if isinstance(value, VerticesByAngles):
            return list(value.parts(name))
        return super().parts(name, value)

    def described(self) -> str:
        """Say in words which values are allowed."""
        return "the points of a chain, without a unit"

    def kept(self, value: Any) -> Any:
        """Return a value that nobody can change; whole numbers, which may wrap, as floats."""
        if id(value) in _VIEWS:
            return value
        stored = read_only(value)
        whole = isinstance(stored, np.ndarray) and stored.dtype.kind in "iu"
        return read_only(stored.astype(np.float64)) if whole else stored

    def check(self, owner: str, value: Any) -> npt.NDArray[Any]:
        if self.takes_any and not is_traced(value):
            points = array_of(owner, value)
            if points.dtype.kind in "iuf":
                self._check_shape(owner, points.shape)
                return points
        return super().check(owner, value)

    def allows(self, numbers: Any) -> Any:
        """Return which chains of an array are allowed."""
        if self.takes_any:
            return namespace(numbers).ones(numbers.shape[:-2], bool)
        return super().allows(numbers).all(axis=(-2, -1)) & legs_fit(numbers).all(axis=-1)

    def _check_numbers(self, owner: str, array: npt.NDArray[Any], rounding: float) -> None:
        super()._check_numbers(owner, array, rounding)
        chains = array.reshape(-1, *array.shape[-2:])
        with np.errstate(over="ignore"):
            for piece in pieces_of(len(chains)):
                some = chains[piece]
                if _are_surely_apart(some) or (fit := legs_fit(some)).all():
                    continue
                chain, place = (int(result[0]) for result in np.nonzero(~fit))
                where = of_chain(piece.start + chain, array.shape[:-2])
                raise ValueFault(_leg_fault(owner, some[chain, place : place + 2], place, where))


def legs_fit(chains: Any) -> Any:
    """Return which legs of chains are within the limits, shape (..., m + 1)."""
    legs = chains[..., 1:, :] - chains[..., :-1, :]
    squares = namespace(chains).einsum("...i,...i", legs, legs)
    least, most = held(squares, (_LEAST, _MOST))
    return (squares >= least) & (squares <= most)


def _are_surely_apart(chains: npt.NDArray[Any]) -> bool:
    """Tell, quickly, whether all legs are within the limits; those from chain to chain as well."""
    flat = chains.reshape(-1)
    squares = flat[3:] - flat[:-3]
    squares *= squares
    lengths = squares[:-2] + squares[1:-1]
    lengths += squares[2:]
    of_legs = lengths[::3]
    return bool(of_legs.min() >= _LEAST and of_legs.max() <= _MOST)


def _leg_fault(owner: str, leg: npt.NDArray[Any], place: int, where: str) -> str:
    both = f"{owner}: vertices {place} and {place + 1}{where}, counted from the light as 0,"
    start, end = leg
    if np.array_equal(start, end):
        return f"{both} are one point, {start.tolist()}; move one, or leave it out"
    return (
        f"{both} are about {float(np.max(np.abs(end - start))):.2g} apart; legs are within "
        f"{SHORTEST:g} .. {LONGEST:g}: give the points in another unit"
    )


_VIEWS: dict[int, bytes] = {}
"""Some numbers of each array that is used where it stands, by its id, as they were at first."""

_FEW = 1 << 15
"""Arrays of fewer numbers are copied, which costs nothing."""


def viewed(value: Any) -> Any:
    """Return an array as a view of doubles that cannot be written to, which no vertex copies."""
    is_plain = type(value) is np.ndarray and value.dtype.kind in "fiu"
    if not is_plain or value.ndim < 2 or value.size < _FEW:
        return value
    view = locked(as_doubles(value).view())
    _VIEWS[id(view)] = _some_of(view)
    finalize(view, _VIEWS.pop, id(view))
    return view


def _some_of(view: npt.NDArray[Any]) -> bytes:
    """Return about a thousand numbers, of all points and axes in turn."""
    some: npt.NDArray[Any] = view.flat[:: view.size // _FEW * 30 + 1]
    return some.tobytes()


def refuse_changed(vertices: Any) -> None:
    """Raise where somebody has overwritten an array that is used where it stands."""
    was = _VIEWS.get(id(vertices))
    if was is not None and was != _some_of(vertices):
        raise PathError(
            "the array of vertices has been overwritten since the path was made; make the path of "
            "a copy, or of a parameter for them"
        )


VERTICES = VerticesDomain("coordinate")
IfBad: TypeAlias = Literal["refuse", "mask"]
BAD: tuple[IfBad, ...] = get_args(IfBad)
"""What becomes of chains that cannot be: an error, or light that is NaN."""
Vertices: TypeAlias = Annotated[Quantity | VerticesByAngles, VERTICES]
Bad: TypeAlias = Annotated[IfBad, Choice("what becomes of chains that cannot be", words=BAD)]


_AT_ONCE = 1 << 11
"""How many chains are looked at together, so that they stay in the cache."""


def of_chain(chain: int, batch: tuple[int, ...]) -> str:
    """Return which chain of a batch is meant, ready to be put behind what is in it."""
    if not batch:
        return ""
    results = tuple(int(place) for place in np.unravel_index(chain, batch))
    return f" of chain {results if len(results) > 1 else results[0]}"


def pieces_of(count: int) -> Iterator[slice]:
    """Yield slices of so many chains."""
    for start in range(0, count, _AT_ONCE):
        yield slice(start, min(start + _AT_ONCE, count))


def vertices_back(vertices: Any) -> Any:
    """Return the points (..., m + 2, 3) of a chain from its end to its start."""
    if isinstance(vertices, VerticesByAngles):
        return replace(vertices, backwards=not vertices.backwards)
    return vertices[..., ::-1, :]
