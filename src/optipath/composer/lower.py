"""Lowering: a validated path graph becomes a program of steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import networkx as nx
import numpy as np

from optipath.composer.builder import Builder
from optipath.composer.placement import alignment, frame_at
from optipath.composer.vertex_placement import vertex_frame
from optipath.composer.wiring import link_text
from optipath.elements import Detector
from optipath.errors import ComposerError
from optipath.frames import Frame
from optipath.parameters import Parameter
from optipath.program import Reading
from optipath.views import View, view_of

if TYPE_CHECKING:
    from optipath.composer.wiring import Port, Wiring
    from optipath.elements import Coupling, Operation
    from optipath.program import Program
    from optipath.vertices import VertexFrame

_COMPONENTS = {"stokes": 4, "linear": 3, "intensity": 1}


def lower(wiring: Wiring, method: str) -> Program:
    """Return the program of a path: ports in the order of travel, each a step or none.

    Ports from which no light reaches a detector or a dump are left out.
    """
    lowering = _Lowering(wiring, method)
    for port in nx.lexicographical_topological_sort(wiring.wanted):
        lowering.add_port(port)
    return lowering.program()


def refuse_depolarizers(program: Program) -> None:
    """Refuse elements that Jones columns cannot pass.

    Raises
    ------
    ComposerError
        Naming each of them.
    """
    faults = []
    for step in program.steps:
        if step.evaluation is None:
            continue
        structure = program.evaluations[step.evaluation].kernel.structure
        if structure is not None and structure.jones is None:
            faults.append(
                f"'{step.label}' has a whole Mueller matrix, which may depolarise, and so no "
                f"Jones matrix; compose with composing='stokes'"
            )
    if faults:
        raise ComposerError(*faults)


class _Lowering:
    """Takes the ports of a path one after the other."""

    def __init__(self, wiring: Wiring, method: str) -> None:
        self.wiring = wiring
        self.method = method
        self.builder = Builder()
        self.lights: dict[Port, int] = {}
        self.sources: dict[str, tuple[int, Frame | VertexFrame]] = {}

    def program(self) -> Program:
        """Return the steps that have been added, and where their light ends."""
        detectors: dict[str, Reading] = {}
        dumps: dict[str, Reading] = {}
        for name, port in self.wiring.ends:
            element = self.wiring.elements[name]
            reads = getattr(element, "reads", "stokes")
            kept = detectors if isinstance(element, Detector) else dumps
            light, frame = self.lights[name, port], self._reading_frame(name, port)
            kept[name] = Reading(light, frame, _COMPONENTS[reads])
        return self.builder.program(self.sources, detectors, dumps)

    def add_port(self, port: Port) -> None:
        """Add the steps that make the light at a port."""
        name, way = port
        if way in self.wiring.elements[name].inputs:
            self._add_arrivals(port)
            return
        lights = [
            self._pass(name, coupling)
            for coupling in self.wiring.couplings[name]
            if coupling.leaves == way and self._is_lit(name, coupling)
        ]
        self.lights[port] = self.builder.sum(f"{name}.{way}", lights)

    def _add_arrivals(self, port: Port) -> None:
        name, way = port
        lights = []
        for link in self.wiring.links_to[port]:
            start, _, (leaves, _) = link
            if (start, leaves) not in self.lights:
                continue
            light = self.lights[start, leaves]
            turn = alignment(self.wiring, link)
            if turn is not None:
                light = self._step(link_text(link), (light,), turn, None)
            lights.append(light)
        self.lights[port] = self.builder.sum(f"{name}.{way}", lights)

    def _is_lit(self, name: str, coupling: Coupling) -> bool:
        return coupling.enters is None or (name, coupling.enters) in self.lights

    def _pass(self, name: str, coupling: Coupling) -> int:
        label = f"{name}.{coupling.leaves}"
        if coupling.enters is None:
            light = self._step(label, (), coupling.operations[0], None)
            port = self.wiring, name, coupling.leaves
            self.sources[name] = (light, frame_at(*port) or vertex_frame(*port) or Frame())
            return light
        light = self.lights[name, coupling.enters]
        presence = _presence(coupling.operations)
        if presence is not None and presence.known and not np.any(presence.present()):
            return light
        for operation in coupling.operations:
            light = self._step(label, (light,), operation, presence)
        return light

    def _step(
        self, label: str, inputs: tuple[int, ...], operation: Operation, presence: View | None
    ) -> int:
        views = [view_of(argument) for argument in operation.arguments]
        kernel = operation.kernel.by_method(self.method)
        return self.builder.step(label, inputs, kernel, views, presence)

    def _reading_frame(self, name: str, port: str) -> Frame | VertexFrame:
        own = frame_at(self.wiring, name, port)
        if own is not None:
            return own
        arriving = [
            frame_at(self.wiring, start, leaves)
            for start, _, (leaves, _) in self.wiring.links_to[name, port]
        ]
        placed = next((frame for frame in arriving if frame is not None), None)
        return placed or vertex_frame(self.wiring, name, port) or Frame()


def _presence(operations: tuple[Operation, ...]) -> View | None:
    for operation in operations:
        for argument in operation.arguments:
            value: Any = view_of(argument).value
            if isinstance(value, Parameter) and value.optional:
                presence = View(value, "present")
                if presence.known and np.all(presence.present()):
                    return None
                return presence
    return None
