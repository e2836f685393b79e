"""A chain of vertices by its angles, which need no world and keep their digits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import PathError, shown
from optipath.kernels.geometry.points_by_angles import PointsByAngles
from optipath.kernels.numbers.circular import cosine, sine
from optipath.kernels.numbers.primitives import NUMPY
from optipath.values.arrays.array_likes import entries_of
from optipath.values.arrays.read_only import same_fields
from optipath.values.arrays.shapes import check_broadcast
from optipath.values.domains.quantities import ANGLE, INCIDENCE
from optipath.values.made import kept_value

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy.typing as npt

    from optipath.values.domains.domain import Domain


@dataclass(frozen=True, eq=False)
class VerticesByAngles:
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
        for name, domain in (("incidences", INCIDENCE), ("turns", ANGLE)):
            several = entries_of(name, "angles", getattr(self, name), PathError)
            each = tuple(
                kept_value(f"{name}[{place}]", angle, domain) for place, angle in enumerate(several)
            )
            object.__setattr__(self, name, each)
        count, turns = len(self.incidences), len(self.turns)
        if not count:
            raise PathError("vertices by angles need an incidence for each reflection; give one")
        if turns != count - 1:
            raise PathError(
                f"{counted(count, 'incidence')} take{'s' * (count == 1)} "
                f"{counted(count - 1, 'turn')}, one from each plane of incidence to the next, not "
                f"{turns}"
            )

    def parts(self, name: str) -> Iterator[tuple[str, Any, Domain]]:
        """Yield the angles: their names, values and domains."""
        for field, domain in (("incidences", INCIDENCE), ("turns", ANGLE)):
            for place, angle in enumerate(getattr(self, field)):
                yield f"{name}.{field}[{place}]", angle, domain

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]


def vertices_from_angles(
    incidences: Sequence[npt.ArrayLike], turns: Sequence[npt.ArrayLike] = ()
) -> npt.NDArray[np.float64]:
    """Return the points of a chain of m specular reflections with given angles.

    Parameters
    ----------
    incidences : sequence of m array_like
        The angles of incidence in radians, 0 to pi/2, in order from the light.
    turns : sequence of m - 1 array_like, optional
        The turns from each plane of incidence to the next, as `VerticesByAngles` has them.

    Returns
    -------
    ndarray, shape (..., m + 2, 3)
        From the light to the eye; legs are of length 1, the middle one along z.

    Raises
    ------
    PathError
        If the numbers of angles do not fit.
    ValueFault
        If an angle is out of its range.

    Examples
    --------
    >>> import numpy as np
    >>> vertices_from_angles([np.pi / 4]).round(12) + 0.0
    array([[0., 0., 0.],
           [0., 0., 1.],
           [0., 1., 1.]])
    """
    chain = VerticesByAngles(incidences, turns)  # type: ignore[arg-type]
    given = {name: domain.check(name, angle) for name, angle, domain in chain.parts("vertices")}
    batch = check_broadcast({name: angle.shape for name, angle in given.items()})
    count, cos, sin = len(chain.incidences), cosine(NUMPY), sine(NUMPY)
    pairs = [part for angle in given.values() for part in (cos(angle), sin(angle))]
    numbers = PointsByAngles(count, 0, count + 1)(NUMPY)(*pairs)
    points = np.stack([np.broadcast_to(number, batch) for number in numbers], axis=-1)
    return points.reshape(*batch, count + 2, 3)


def counted(count: int, what: str) -> str:
    """Return how many there are of something.

    Examples
    --------
    >>> counted(1, "turn"), counted(2, "turn")
    ('1 turn', '2 turns')
    """
    return f"{count} {what}{'s' * (count != 1)}"
