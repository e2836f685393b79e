"""Reference for whole paths: coherency matrices in 50 digits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.media import with_followed
from optipath.composer.path_values import Values
from optipath.composer.placement import alignment, azimuth_of, frame_at
from optipath.composer.wiring import Wiring
from optipath.errors import ParameterError, PathError
from optipath.faults import shown
from optipath.lab.element_reference import matrix_of, times, turn
from optipath.lab.many_digits import DIGITS, MANY_DIGITS, WORKING_DIGITS, Reader, exactly, mpmath
from optipath.paths.path_graph import PathGraph
from optipath.values.operands import ResultOf

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    import networkx as nx

    from optipath.composer.wiring import Link, Port, Stretch
    from optipath.elements.coupling import Coupling
    from optipath.elements.element import Element
    from optipath.lab.boundary_reference import Jones
    from optipath.light.frame import Frame
    from optipath.values.parameters import Resolved


class ExactLight(NamedTuple):
    """The light at an end, and how it follows the angles of the path."""

    stokes: tuple[Any, ...]
    conditions: tuple[float, ...]


def exact_lights(path: PathGraph, **parameters: Any) -> dict[str, ExactLight]:
    """Return the light at every detector and dump of a path, in 50 digits.

    >>> import optipath as op
    >>> lights = exact_lights(op.load_preset("malus", angle=0.0))
    >>> [float(component) for component in lights["eye"].stokes]
    [0.5, 0.5, 0.0, 0.0]
    """
    argument = _single(path, parameters)
    return _exact(_wiring(path.graph), argument, (), ())


def exact_stokes(path: PathGraph, **parameters: Any) -> dict[str, tuple[Any, ...]]:
    """Return `exact_lights` of a path's detectors and dumps by one passage of light.

    >>> import optipath as op
    >>> [float(part) for part in exact_stokes(op.load_preset("malus", angle=0.0))["eye"]]
    [0.5, 0.5, 0.0, 0.0]
    """
    argument, wiring = _single(path, parameters), _wiring(path.graph)
    with mpmath.workdps(_digits(wiring, Reader(argument, (), ()))):
        return _Walk(wiring, Reader(argument, (), ())).stokes()


def _single(path: PathGraph, parameters: Mapping[str, Any]) -> Mapping[str, Resolved]:
    if not isinstance(path, PathGraph):
        raise PathError(f"a reference is of a PathGraph, not of {shown(path)}")
    argument, batch = path.compose().inputs.resolve(parameters)
    if batch:
        raise ParameterError(f"a reference takes single values, not a batch of shape {batch}")
    return argument


def exact_batch(graph: nx.MultiDiGraph, **parameters: Any) -> Iterator[dict[str, ExactLight]]:
    """Yield the light at every detector and dump, for each of a batch in C order."""
    argument, batch = Values(graph).inputs().resolve(parameters)
    wiring = _wiring(graph)
    for at in np.ndindex(batch):
        yield _exact(wiring, argument, batch, at)


def _wiring(graph: nx.MultiDiGraph) -> Wiring:
    return Wiring(with_followed(graph)[0])


def _exact(
    wiring: Wiring, arguments: Mapping[str, Resolved], batch: tuple[int, ...], at: tuple[int, ...]
) -> dict[str, ExactLight]:
    scout = Reader(arguments, batch, at)
    with mpmath.workdps(_digits(wiring, scout)):
        values = _Walk(wiring, Reader(arguments, batch, at)).stokes()
        step = mpmath.mpf(10) ** -(DIGITS // 2 + scout.decades)
        conditions = {name: [0.0] * 4 for name in values}
        for angle in range(scout.count):
            moved = _Walk(wiring, Reader(arguments, batch, at, angle, step)).stokes()
            for name, before in values.items():
                for i, (old, new) in enumerate(zip(before, moved[name], strict=True)):
                    conditions[name][i] += abs(float((new / old - 1) / step)) if old else 0.0
        return {name: ExactLight(s, tuple(conditions[name])) for name, s in values.items()}


def _digits(wiring: Wiring, scout: Reader) -> int:
    """Return how many digits are needed: numbers far from 1 leave little of each other."""
    with mpmath.workdps(WORKING_DIGITS):
        _Walk(wiring, scout).stokes()
    return WORKING_DIGITS + 4 * scout.decades


class _Walk:
    """One passage of light through a path; coherency matrices by port."""

    def __init__(self, wiring: Wiring, read: Reader) -> None:
        self.wiring = wiring
        self.read = read
        self.at: dict[Port, Jones] = {}
        self._known: dict[Any, Any] = {}

    def stokes(self) -> dict[str, tuple[Any, ...]]:
        """Return the Stokes vector at every end that light reaches."""
        ends = self.wiring.ends
        for stretch in self.wiring.stretches:
            if stretch.junctions:
                self._go_round(stretch)
            else:
                for port in stretch.ports:
                    self.at[port] = added(self._lights(port))
        return {name: self._read(name, _stokes(self.at[name, port])) for name, port in ends}

    def _go_round(self, loop: Stretch) -> None:
        """Solve for the light where it meets, in all four components."""
        arriving = [added(self._lights(junction)) for junction in loop.junctions]
        arguments = [part for light in arriving for part in stokes_of(light)]
        units = mpmath.eye(len(arguments)).tolist()
        back = mpmath.matrix([self._once_round(loop, unit) for unit in units])
        self._once_round(loop, _solved(mpmath.eye(len(arguments)) - back.T, arguments))

    def _once_round(self, loop: Stretch, parts: list[Any]) -> list[Any]:
        """Return what the light at the junctions brings back to them."""
        for place, junction in enumerate(loop.junctions):
            self.at[junction] = coherency(parts[4 * place : 4 * place + 4])
        members = set(loop.ports)
        for port in loop.ports[len(loop.junctions) :]:
            self.at[port] = added(self._lights(port, members))
        back = (added(self._lights(junction, members)) for junction in loop.junctions)
        return [part for light in back for part in stokes_of(light)]

    def _lights(self, port: Port, within: set[Port] | None = None) -> list[Jones]:
        """Return what arrives at a port, from ports within some alone."""
        name, way = port
        results = []
        if way in self.wiring.elements[name].inputs:
            for link in self.wiring.links_to[port]:
                start = link[0], link[2][0]
                if self._is_there(start, within):
                    results.append(passed(self._turn(link), self.at[start]))
            return results
        for coupling in self.wiring.couplings[name]:
            if coupling.leaves != way:
                continue
            if coupling.enters is None:
                results += [self._emitted(coupling)] if within is None else []
            elif self._is_there((name, coupling.enters), within):
                results.append(self._through(name, coupling))
        return results

    def _is_there(self, port: Port, within: set[Port] | None) -> bool:
        return port in self.at and (within is None or port in within)

    def _turn(self, link: Link) -> Jones:
        if link not in self._known:
            start, end, (leaves, enters) = link
            ends = (start, leaves), (end, enters)
            before, behind = (frame_at(self.wiring, *port) for port in ends)
            between_vertices = {start, end} <= self.wiring.self_placed
            if between_vertices and (turning := alignment(self.wiring, link)):
                c, s = turning.numbers(MANY_DIGITS, self.read.exact)
                angle = self.read.move(mpmath.atan2(s, c) / 2, 2)
            elif before is not None and behind is not None:
                angle = self.read.move(_angle_between(before, behind), 2)
            else:
                angle = self.read.angle(azimuth_of(self.wiring, link), 2)
            self._known[link] = turn(angle)
        return self._known[link]  # type: ignore[no-any-return]

    def _read(self, name: str, stokes: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return what is read of the light at an end."""
        response = getattr(self.wiring.elements[name], "response", None)
        return stokes if response is None else tuple([self.read.real(response) * s for s in stokes])

    def _emitted(self, coupling: Coupling) -> Jones:
        first, *others = coupling.operations[0].arguments
        # With a spectrum, the first is a product with its density.
        factors = first.operation.arguments if isinstance(first, ResultOf) else (first,)
        intensity = mpmath.fprod(map(self.read.real, factors))
        state = [*map(self.read.real, others)]
        return coherency([intensity * part for part in state or (1, 0, 0, 0)])

    def _through(self, name: str, coupling: Coupling) -> Jones:
        """Return the light behind a way through an element."""
        assert coupling.enters is not None  # noqa: S101 - sources are asked for what they emit
        element, light = self.wiring.elements[name], self.at[name, coupling.enters]
        if self._absent(element):
            return light
        key = name, coupling.enters, coupling.leaves
        if key not in self._known:
            self._known[key] = matrix_of(element, coupling, self.read)
        matrix = self._known[key]
        if len(matrix) == 2:
            return passed(matrix, light)
        stokes = stokes_of(light)
        return coherency([sum(m * s for m, s in zip(row, stokes, strict=True)) for row in matrix])

    def _absent(self, element: Element) -> bool:
        optional = [p for p in element.parameters() if p.optional]
        resolved = (p.resolve(p.default) if p.bound else self.read.given[p.name] for p in optional)
        return not all(self.read.pick(value.present) for value in resolved)


def _solved(system: Any, arguments: list[Any]) -> list[Any]:
    """Return the unknowns of a system; those that nothing reaches are 0."""
    lit = [place for place, number in enumerate(arguments) if number]
    for column in lit:
        lit += [row for row in range(len(arguments)) if row not in lit and system[row, column]]
    result = [mpmath.mpf(0)] * len(arguments)
    if lit:
        part = mpmath.matrix([[system[row, column] for column in lit] for row in lit])
        numbers = mpmath.lu_solve(part, mpmath.matrix([arguments[row] for row in lit]))
        for place, number in zip(lit, numbers, strict=True):
            result[place] = number
    return result


def _angle_between(frame: Frame, other: Frame) -> Any:
    axes = frame.x, other.x, frame.z
    x, new_x, z = (np.array([exactly(number) for number in axis]) for axis in axes)
    return mpmath.atan2(np.dot(z, np.cross(x, new_x)), np.dot(x, new_x))


def _stokes(light: Jones) -> tuple[Any, ...]:
    values = stokes_of(light)
    # What cancels exactly leaves the rounding of the last digit.
    least = values[0] * mpmath.mpf(10) ** -(mpmath.mp.dps - 10)
    return tuple(value if abs(value) > least else mpmath.mpf(0) for value in values)


def passed(matrix: Jones, light: Jones) -> Jones:
    """Return the light behind an element."""
    (a, b), (c, d) = matrix
    conj = mpmath.conj
    return times(times(matrix, light), ((conj(a), conj(c)), (conj(b), conj(d))))


def added(lights: Iterable[Jones]) -> Jones:
    """Return the incoherent sum of lights; dark where there is none."""
    entries = [(a, b, c, d) for (a, b), (c, d) in lights] or [(0, 0, 0, 0)]
    a, b, c, d = map(sum, zip(*entries, strict=True))
    return (a, b), (c, d)


def coherency(stokes: Iterable[Any]) -> Jones:
    """Return the coherency matrix of a Stokes vector."""
    s0, s1, s2, s3 = stokes
    # S2 + i S3 = 2 conj(Ex) Ey.
    return ((s0 + s1) / 2, mpmath.mpc(s2, -s3) / 2), (mpmath.mpc(s2, s3) / 2, (s0 - s1) / 2)


def stokes_of(light: Jones) -> tuple[Any, ...]:
    """Return the Stokes vector of a coherency matrix."""
    (xx, _), (yx, yy) = light
    xx, yy, yx = (mpmath.mpmathify(part) for part in (xx, yy, yx))
    return xx.real + yy.real, xx.real - yy.real, 2 * yx.real, 2 * yx.imag
