"""The reference for whole paths: coherency matrices in 50 digits, from port to port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import networkx as nx
import numpy as np

from optipath.accuracy.element_reference import Jones, Reader, jones, mueller, times, turn
from optipath.accuracy.many_digits import (
    DIGITS,
    MANY_DIGITS,
    WORKING_DIGITS,
    exactly,
    mpmath,
)
from optipath.composer import Wiring
from optipath.composer.placement import alignment, azimuth_of, frame_at
from optipath.composer.values import Values
from optipath.composer.vertex_placement import is_vertex
from optipath.errors import ParameterError, PathError
from optipath.kernels import REFLECTION
from optipath.path_graph import PathGraph

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.composer.wiring import Link
    from optipath.elements import Coupling, Element
    from optipath.frames import Frame
    from optipath.parameters import Resolved


class ExactLight(NamedTuple):
    """The light at an end, and how it follows the angles of the path.

    Attributes
    ----------
    stokes : tuple of mpf
        S0, S1, S2, S3.
    conditions : tuple of float
        Of each component: the sum of |t dX/dt / X| over the tangents t of all angles of
        incidence and of twice all turns; 0 where X is 0.
    """

    stokes: tuple[Any, ...]
    conditions: tuple[float, ...]


def exact_lights(path: PathGraph, **parameters: Any) -> dict[str, ExactLight]:
    """Return the light at every detector and dump of a path, in 50 digits.

    Parameters
    ----------
    path : PathGraph
        Any path.
    **parameters : float
        Single values; `exact_batch` takes arrays.

    Raises
    ------
    ParameterError
        If a parameter is unknown or not allowed, or if there are several values for one.

    Examples
    --------
    >>> import optipath as op
    >>> lights = exact_lights(op.load_preset("malus", angle=0.0))
    >>> [float(component) for component in lights["eye"].stokes]
    [0.5, 0.5, 0.0, 0.0]
    """
    if not isinstance(path, PathGraph):
        raise PathError(f"a reference is of a PathGraph, not of {path!r}")
    given, batch = path.compose().inputs.resolve(parameters)
    if batch:
        raise ParameterError(f"a reference takes single values, not a batch of shape {batch}")
    return _exact(Wiring(path.graph), given, (), ())


def exact_batch(graph: nx.MultiDiGraph, **parameters: Any) -> Iterator[dict[str, ExactLight]]:
    """Yield the light at every detector and dump, for each of a batch in C order.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        The elements and links of a path.
    **parameters : float or array_like
        Values of the open parameters.
    """
    given, batch = Values(graph).inputs().resolve(parameters)
    wiring = Wiring(graph)
    for at in np.ndindex(batch):
        yield _exact(wiring, given, batch, at)


def _exact(
    wiring: Wiring, given: Mapping[str, Resolved], batch: tuple[int, ...], at: tuple[int, ...]
) -> dict[str, ExactLight]:
    scout = Reader(given, batch, at)
    _Walk(wiring, scout).stokes()
    # Numbers far from 1 need digits for what they leave of each other.
    with mpmath.workdps(WORKING_DIGITS + 4 * scout.decades):
        reader = Reader(given, batch, at)
        values = _Walk(wiring, reader).stokes()
        step = mpmath.mpf(10) ** -(DIGITS // 2 + scout.decades)
        conditions = {name: [0.0] * 4 for name in values}
        for angle in range(reader.count):
            moved = _Walk(wiring, Reader(given, batch, at, angle, step)).stokes()
            for name, before in values.items():
                for i, (old, new) in enumerate(zip(before, moved[name], strict=True)):
                    conditions[name][i] += abs(float((new / old - 1) / step)) if old else 0.0
        return {name: ExactLight(s, tuple(conditions[name])) for name, s in values.items()}


class _Walk:
    """One passage of light through a path; coherency matrices by port."""

    def __init__(self, wiring: Wiring, read: Reader) -> None:
        self.wiring = wiring
        self.read = read
        self.at: dict[tuple[str, str], Jones] = {}

    def stokes(self) -> dict[str, tuple[Any, ...]]:
        """Return the Stokes vector at every end that light reaches."""
        for name, way in nx.lexicographical_topological_sort(self.wiring.wanted):
            element = self.wiring.elements[name]
            if way in element.inputs:
                self.at[name, way] = _sum(self._arriving(name, way))
            else:
                self.at[name, way] = _sum(self._passing(name, way, element))
        return {name: _stokes(self.at[name, port]) for name, port in self.wiring.ends}

    def _arriving(self, name: str, way: str) -> list[Jones]:
        found = []
        for link in self.wiring.links_to[name, way]:
            start, _, (leaves, _) = link
            if (start, leaves) not in self.at:
                continue
            if is_vertex(self.wiring, start) and is_vertex(self.wiring, name):
                angle = self._between_vertices(link)
                found.append(_passed(turn(angle), self.at[start, leaves]))
                continue
            before, behind = (
                frame_at(self.wiring, *port) for port in ((start, leaves), (name, way))
            )
            if before is not None and behind is not None:
                angle = self.read.move(_angle_between(before, behind), 2)
            else:
                angle = self.read.angle(azimuth_of(self.wiring, link), 2)
            found.append(_passed(turn(angle), self.at[start, leaves]))
        return found

    def _between_vertices(self, link: Link) -> Any:
        turning = alignment(self.wiring, link)
        assert turning is not None  # noqa: S101 - vertices always turn
        kernel = turning.kernel.by_method(next(iter(REFLECTION.methods)))
        c, s = kernel.made_for(MANY_DIGITS)(*map(self.read.exact, turning.arguments))
        return self.read.move(mpmath.atan2(s, c) / 2, 2)

    def _passing(self, name: str, way: str, element: Element) -> list[Jones]:
        found = []
        for coupling in self.wiring.couplings[name]:
            if coupling.leaves != way:
                continue
            if coupling.enters is None:
                found.append(self._emitted(coupling))
            elif (name, coupling.enters) in self.at:
                light = self.at[name, coupling.enters]
                found.append(
                    light if self._absent(element) else self._through(coupling, element, light)
                )
        return found

    def _emitted(self, coupling: Coupling) -> Jones:
        intensity, *state = map(self.read.real, coupling.operations[0].arguments)
        return _coherency([intensity * part for part in state or (1, 0, 0, 0)])

    def _through(self, coupling: Coupling, element: Element, light: Jones) -> Jones:
        matrix = jones(element, coupling.leaves, self.read)
        if matrix is not None:
            return _passed(matrix, light)
        stokes = _stokes(light)
        rows = mueller(coupling, self.read)
        return _coherency([sum(m * s for m, s in zip(row, stokes, strict=True)) for row in rows])

    def _absent(self, element: Element) -> bool:
        optional = [p for p in element.parameters() if p.optional]
        resolved = (p.resolve(p.default) if p.bound else self.read.given[p.name] for p in optional)
        return not all(self.read.pick(value.present) for value in resolved)


def _angle_between(frame: Frame, other: Frame) -> Any:
    x, new_x, z = ([exactly(v) for v in axis] for axis in (frame.x, other.x, frame.z))
    across = [x[i - 2] * new_x[i - 1] - x[i - 1] * new_x[i - 2] for i in range(3)]
    d = sum(a * b for a, b in zip(x, new_x, strict=True))
    return mpmath.atan2(sum(a * b for a, b in zip(z, across, strict=True)), d)


def _passed(matrix: Jones, light: Jones) -> Jones:
    (a, b), (c, d) = matrix
    conj = mpmath.conj
    return times(times(matrix, light), ((conj(a), conj(c)), (conj(b), conj(d))))


def _sum(lights: list[Jones]) -> Jones:
    (a, b), (c, d) = ((0, 0), (0, 0)) if not lights else lights[0]
    for (e, f), (g, h) in lights[1:]:
        a, b, c, d = a + e, b + f, c + g, d + h
    return (a, b), (c, d)


def _coherency(stokes: Any) -> Jones:
    s0, s1, s2, s3 = stokes
    # <E conj(E)>, where S2 + i S3 = 2 conj(Ex) Ey.
    return ((s0 + s1) / 2, mpmath.mpc(s2, -s3) / 2), (mpmath.mpc(s2, s3) / 2, (s0 - s1) / 2)


def _stokes(light: Jones) -> tuple[Any, ...]:
    (xx, _), (yx, yy) = light
    xx, yy, yx = (mpmath.mpmathify(part) for part in (xx, yy, yx))
    values = (xx.real + yy.real, xx.real - yy.real, 2 * yx.real, 2 * yx.imag)
    # What cancels exactly leaves the rounding of the last digit.
    least = (xx.real + yy.real) * mpmath.mpf(10) ** -(mpmath.mp.dps - 10)
    return tuple(value if abs(value) > least else mpmath.mpf(0) for value in values)
