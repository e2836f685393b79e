"""Placing: every node and every link of a path gets its place, by following the light."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.composer.placement import azimuth_of
from optipath.composer.wiring import link_text
from optipath.elements.chain_vertex import ChainVertex
from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.plots.space.fixed_places import (
    chain_points,
    legs_beside_chains,
    own_axes_of,
    posture_in_space,
)
from optipath.plots.space.posture import posture_of, turn_about_x, turn_about_z
from optipath.plots.space.told_values import number

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.composer.wiring import Link
    from optipath.plots.space.posture import Posture
    from optipath.plots.space.told_values import ToldPath

    Array = npt.NDArray[np.float64]

_ASIDE = np.radians([40.0, -40.0, 75.0, -75.0])
"""By how much taps, and lights that meet, are turned out of the way of other light."""

_BESIDE = 0.6
"""How far light that comes back along its way is drawn beside it."""

_BACK, _ROOM = 3.0, 0.3
"""How long the way back is on which there should be room, and how much, in lengths of a link."""

_START = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""The axes of the first source, a column each: light goes to the right, y is up."""


class DrawnLink(NamedTuple):
    """A link where it is drawn.

    Shapes: tail, head (3,); axes (3, 3).
    """

    tail: Array
    head: Array
    axes: Array


class Placing:
    """Where the nodes and links of a path are drawn.

    Shape: at (3,).
    """

    def __init__(self, told: ToldPath) -> None:
        self.wiring = told.wiring
        self.at: dict[str, Array] = {}
        self.postures: dict[str, Posture] = {}
        self.links: dict[Link, DrawnLink] = {}
        self.notes: dict[str, None] = {}
        self.unit = 1.0
        self.by_angles = True
        self._returning: dict[tuple[str, str], tuple[Array, Array]] = {}
        self._begins: dict[tuple[str, str], Array] = {}
        self._aside: dict[tuple[str, str], int] = {}
        self._legs = legs_beside_chains(self.wiring)
        self._taps = {*self.wiring.taps}
        self._fix()
        self._follow()

    def note(self, sentence: str) -> None:
        """Say once what was chosen."""
        self.notes[sentence] = None

    def _fix(self) -> None:
        """Place what says itself where it stands."""
        legs = []
        for name, element in self.wiring.elements.items():
            if axes := own_axes_of(self.wiring, name):
                self.postures[name] = posture_in_space(self.wiring, name, axes)
            if isinstance(element, ChainVertex):
                points, place = chain_points(element), int(element.place)
                self.at[name] = points[place]
                ends = not self.wiring.self_placed.intersection(self.wiring.graph.successors(name))
                if isinstance(element.vertices, VerticesByAngles):
                    if ends:  # What comes behind the chain may stand beside it.
                        self._part_returning(name, self.postures[name])
                else:
                    around = points[place - 1 : place + 2]
                    legs += [*np.linalg.norm(np.diff(around, axis=0), axis=1)]
        if legs:
            self.unit, self.by_angles = float(np.median(legs)), False

    def _follow(self) -> None:
        """Draw link after link, forwards where that can be, else backwards to other sources."""
        left = sorted(
            self.wiring.graph.edges(keys=True),
            key=lambda link: (self.wiring.order.get((link[0], link[2][0]), 0), link in self._taps),
        )
        while left:
            forwards = [link for link in left if link[0] in self.at]
            backwards = [each for each in left if each[0] not in self.at and each[1] in self.at]
            # What comes back goes where there is room, and so comes last.
            onwards = [link for link in forwards if (link[0], link[2][0]) not in self._returning]
            if onwards or (forwards and not backwards):
                link = (onwards or forwards)[0]
                self.links[link] = self._forwards(link)
            elif backwards:
                link = backwards[0]
                self.links[link] = self._backwards(link)
            else:
                self._begin(left[0][0])
                continue
            left.remove(link)
        for name in self.wiring.elements:
            if name not in self.at:
                self._begin(name)

    def _begin(self, name: str) -> None:
        """Place a node that nothing else places."""
        below = 1.6 * len([n for n in self.at if not self.wiring.elements[n].inputs])
        at = np.array([0.0, 0.0, -below * self.unit])
        element = self.wiring.elements[name]
        port = (*element.outputs, *element.inputs)[0]
        self._stand(name, at, port, _START)

    def _stand(self, name: str, at: Array, port: str, axes: Array) -> None:
        """Place a node by the axes of one of its ports."""
        self.at[name] = at
        if name not in self.postures:
            usual = posture_of(self.wiring.elements[name])
            basis = axes @ usual.axes[port].T
            self.postures[name] = usual._replace(
                axes={p: basis @ own for p, own in usual.axes.items()},
                normal=None if usual.normal is None else basis @ usual.normal,
                across=None if usual.across is None else basis @ usual.across,
            )
        posture = self.postures[name]
        if not posture.told:
            self.note(
                f"schematic: nothing says by which angle '{name}' turns light; drawn at 45 deg"
            )
        self._part_returning(name, posture)

    def _part_returning(self, name: str, posture: Posture) -> None:
        """Let light that comes back along its own way begin beside where it arrived."""
        for enters, leaves in (("in", "reflected"), ("in", "out")):
            if not {enters, leaves} <= posture.axes.keys():
                continue
            arriving, returning = posture.axes[enters], posture.axes[leaves]
            if np.linalg.norm(arriving[:, 2] + returning[:, 2]) < 1e-6:
                self._returning[name, leaves] = arriving[:, 1], returning[:, 2]
                self.note(f"light that '{name}' sends back is drawn beside the way it came")

    def tail_of(self, name: str, port: str) -> Array:
        """Return where light begins that leaves a port.

        Shape: returns (3,).
        """
        if (name, port) not in self._returning:
            return self.at[name]
        if (name, port) not in self._begins:
            aside, way = self._returning[name, port]
            sides = [self.at[name] + _BESIDE * self.unit * each for each in (aside, -aside)]
            free = [self._free(side, way) for side in sides]
            # To where y is, unless another beam or element is there.
            other = free[0] < _ROOM and free[1] > free[0]
            self._begins[name, port] = sides[int(other)]
        return self._begins[name, port]

    def _free(self, start: Array, way: Array) -> float:
        """Return how far a beam keeps from what is placed, in lengths of a link."""
        beam = start + np.linspace(0.0, _BACK * self.unit, 31)[:, np.newaxis] * way
        share = np.linspace(0.0, 1.0, 11)[:, np.newaxis]
        lines = [link.tail + share * (link.head - link.tail) for link in self.links.values()]
        taken = np.concatenate([*lines, np.array([*self.at.values()])])
        distances = np.linalg.norm(beam[:, np.newaxis] - taken, axis=2)
        return float(distances.min()) / self.unit

    def axes_entering(self, link: Link) -> Array:
        """Return the axes in which the light of a link enters, a column each."""
        _, end, (_, enters) = link
        axes, drawn = self.postures[end].axes[enters], self.links[link]
        if np.linalg.norm(axes[:, 2] - drawn.axes[:, 2]) < 1e-9:
            return axes
        return drawn.axes @ turn_about_z(self._azimuth(link))

    def _azimuth(self, link: Link) -> float:
        return number(azimuth_of(self.wiring, link))

    def _length(self, link: Link) -> float:
        return self._legs.get(link, self.unit)

    def _forwards(self, link: Link) -> DrawnLink:
        """Draw a link from where it begins."""
        start, end, (leaves, enters) = link
        tail, axes = self.tail_of(start, leaves), self.postures[start].axes[leaves]
        if end in self.at:
            return self._closed(link, tail, axes)
        fixed = self.postures.get(end)
        if link in self._taps and fixed is None:
            axes = self._turned_aside((start, leaves), axes)
            self.note("taps, which only read light, are drawn dashed and aside")
        head = tail + self._length(link) * axes[:, 2]
        self._stand(end, head, enters, axes @ turn_about_z(self._azimuth(link)))
        return DrawnLink(tail, head, axes)

    def _backwards(self, link: Link) -> DrawnLink:
        """Draw a link to a node that stands, from one that does not."""
        start, end, (leaves, enters) = link
        arriving = self.postures[end].axes[enters]
        axes = arriving @ turn_about_z(-self._azimuth(link))
        taken = [other for other in self.links if other[1] == end and other[2][1] == enters]
        if taken and start not in self.postures:
            axes = self._turned_aside((end, enters), axes)
            self.note(f"lights that meet at '{end}' are drawn from several sides")
        head = self.at[end]
        tail = head - self._length(link) * axes[:, 2]
        self._stand(start, tail, leaves, axes)
        return DrawnLink(tail, head, axes)

    def _turned_aside(self, port: tuple[str, str], axes: Array) -> Array:
        count = self._aside[port] = self._aside.get(port, 0) + 1
        return axes @ turn_about_x(_ASIDE[(count - 1) % len(_ASIDE)])

    def _closed(self, link: Link, tail: Array, axes: Array) -> DrawnLink:
        """Draw a link between nodes that stand both."""
        _, end, (_, enters) = link
        way, along = self.at[end] - tail, axes[:, 2]
        length = np.linalg.norm(way)
        if length > 0.0 and np.linalg.norm(way / length - along) < 1e-9:
            return DrawnLink(tail, self.at[end], axes)
        posture = self.postures[end]
        if posture.normal is not None and posture.role != "plate":
            towards = posture.normal @ along
            distance = posture.normal @ way / towards if abs(towards) > 1e-9 else 0.0
            expected = posture.axes[enters][:, 2] @ along > 1.0 - 1e-9
            if expected and 0.2 * self.unit < distance < 5.0 * self.unit:
                self.note(f"light comes to '{end}' again at another place of its face")
                return DrawnLink(tail, tail + distance * along, axes)
        self.note(f"the picture cannot close: '{link_text(link)}' is drawn to where '{end}' stands")
        if length < 0.2 * self.unit:
            return DrawnLink(tail, tail + 0.5 * self.unit * along, axes)
        return DrawnLink(tail, self.at[end], _carried(axes, way / length))


def _carried(axes: Array, direction: Array) -> Array:
    """Return axes turned by the least turn that takes z to a direction."""
    z = axes[:, 2]
    across = np.cross(z, direction)
    cosine = float(z @ direction)
    if cosine < -1.0 + 1e-12:
        return np.asarray(axes * np.array([1.0, -1.0, -1.0]))
    matrix = np.array(
        [
            [0.0, -across[2], across[1]],
            [across[2], 0.0, -across[0]],
            [-across[1], across[0], 0.0],
        ]
    )
    return np.asarray((np.eye(3) + matrix + matrix @ matrix / (1.0 + cosine)) @ axes)
