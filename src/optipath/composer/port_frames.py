"""Port frames: in which frame light is at each port of a path, and the turn on each link."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.placement import azimuth_of, before, frame_at, vertex_frame
from optipath.composer.wiring import link_text
from optipath.errors import ParameterError
from optipath.faults import no_value
from optipath.light.frame import Frame
from optipath.values.operands import operand_of

if TYPE_CHECKING:
    from optipath.composer.wiring import Link, Port, Wiring
    from optipath.values.operands import Operand
    from optipath.values.precision import Numbers


_UNIT = Frame()


class PathFrames(dict[str, dict[str, Frame]]):
    """The frame of each port, by node and port.

    Attributes
    ----------
    turns : dict of str to ndarray
        By what angle, in radians, the frame that light enters is turned against the one that it
        leaves, by links such as ``"lamp.out -> glass.in"``.
    relative : frozenset of str
        The ports, such as ``"glass.in"``, that are not placed in space. Their frames are turned
        against the unit frame of the light, whose z is its direction.
    """

    turns: dict[str, Numbers]
    relative: frozenset[str]

    @classmethod
    def of(cls, wiring: Wiring) -> PathFrames:
        """Return the frames of a path whose parameters are known."""
        ports = PortFrames(wiring)
        result = cls({name: ports.of(name) for name in wiring.elements})
        result.turns = {link_text(link): ports.turn(link) for link in wiring.graph.edges(keys=True)}
        result.relative = frozenset([".".join(port) for port in ports.relative])
        return result


class PortFrames:
    """Finds the frames of ports, one after the other, where the parameters of a path are known."""

    def __init__(self, wiring: Wiring) -> None:
        self.wiring = wiring
        self.relative: list[Port] = []
        self._ends = frozenset(wiring.ends)
        self._turns: dict[Port, Any] = {}

    def of(self, name: str) -> dict[str, Frame]:
        """Return the frames of the ports of a node."""
        element = self.wiring.elements[name]
        return {port: self.frame((name, port)) for port in (*element.inputs, *element.outputs)}

    def frame(self, port: Port) -> Frame:
        """Return the frame of a port: in space, or turned against the unit frame of the light."""
        if (placed := self.placed(port)) is not None:
            return placed
        self.relative.append(port)
        turn = self._turn_until(port)
        return _UNIT.turned_by(turn) if np.any(turn) else _UNIT

    def placed(self, port: Port) -> Frame | None:
        """Return the frame of a port in space, by its own frame or by points; None for others."""
        # An end takes the frame of the light that arrives.
        links = self.wiring.links_to.get(port, []) if port in self._ends else []
        for place in (port, *((start, leaves) for start, _, (leaves, _) in links)):
            if (result := frame_at(self.wiring, *place)) is not None:
                return result
        by_points = vertex_frame(self.wiring, *port)
        if by_points is None:
            return None
        ParameterError.raise_for(map(no_value, sorted(by_points.names)))
        return by_points.frame({})

    def turn(self, link: Link) -> Numbers:
        """Return by what angle in radians light is turned on a link."""
        start, end, (leaves, enters) = link
        ports = (start, leaves), (end, enters)
        in_space = any(frame_at(self.wiring, *port) is not None for port in ports)
        first = second = None
        if in_space or {start, end} <= self.wiring.self_placed:
            first, second = map(self.placed, ports)
        if first is None or second is None or first is second:
            return _number(operand_of(azimuth_of(self.wiring, link)))
        along = np.sum(first.x * second.x, axis=-1)
        return np.asarray(np.arctan2(np.sum(first.y * second.x, axis=-1), along))

    def _turn_until(self, port: Port) -> Numbers:
        """Return the sum of turns since light began, went on another way, or met other light."""
        way: dict[Port, list[Operand]] = {}
        while port not in self._turns:
            place = before(self.wiring, port)
            if place is None or port in way:
                self._turns[port] = np.asarray(0.0)
                break
            way[port] = place[1]
            port = place[0]
        for later, turns in reversed(way.items()):
            self._turns[later] = sum(map(_number, turns), self._turns[port])
            port = later
        return np.asarray(self._turns[port])


def _number(turn: Operand) -> Numbers:
    """Return a turn in radians, whose parameter has been given."""
    if not turn.known:
        raise ParameterError(no_value(turn.value.name))
    return turn.numbers()
