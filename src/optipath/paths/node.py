"""Node: a named element in its path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from optipath.composer.port_frames import PortFrames
from optipath.elements.element import Chainable, begun
from optipath.errors import PathError
from optipath.paths.binding import wiring_at_defaults

if TYPE_CHECKING:
    from optipath.light.frame import Frame
    from optipath.paths.path_graph import PathGraph


@dataclass(frozen=True)
class Node(Chainable):
    """A named element in its path; ``a >> b`` links the natural way out of a to b.

    An element or a chain in no path yet is added to the path of the first.
    """

    path: PathGraph
    name: str
    port: str = ""

    def __rshift__(self, behind: Chainable) -> Node:  # type: ignore[override] # it has a path
        if not isinstance(behind, Node):
            return Node(self.path, self.path._append(self._text, begun(behind)))
        if behind.path is not self.path:
            raise PathError(f"'{self.name}' and '{behind.name}' stand in different paths; use one")
        self.path.connect(self._text, behind._text)
        return Node(behind.path, behind.name)

    @property
    def frames(self) -> dict[str, Frame]:
        """The frame of each port, as `PathGraph.frames` has it, with parameters at their defaults.

        >>> import optipath as op
        >>> op.load_preset("npgr026-3d")["X2"].frames["in"].x.round(12) + 0.0
        array([1., 0., 0.])
        """
        return PortFrames(wiring_at_defaults(self.path._values, {})).of(self.name)  # noqa: SLF001

    @property
    def _text(self) -> str:
        return f"{self.name}.{self.port}" if self.port else self.name

    def __repr__(self) -> str:
        return f"Node '{self._text}'"
