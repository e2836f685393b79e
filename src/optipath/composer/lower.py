"""Lowering: a validated path graph becomes a program of steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.builder import Builder
from optipath.composer.placement import alignment, frame_at, vertex_frame
from optipath.composer.wiring import link_text
from optipath.engines.program import Reading
from optipath.errors import ComposerError, listed
from optipath.kernels.catalog import RESPONSE
from optipath.light.frame import Frame
from optipath.values.operands import Operand, Operation, ResultOf, operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from optipath.composer.wiring import Link, Port, Stretch, Wiring
    from optipath.elements.coupling import Coupling
    from optipath.elements.vertex_place import VertexFrame
    from optipath.engines.program import Program


_FEW = 8

_UNIT = Frame()

_COMPONENTS = {"stokes": 4, "linear": 3, "intensity": 1}


def lower(wiring: Wiring, method: str) -> Program:
    """Return the program of a path: ports in the order of travel, each a step or none."""
    lowering = _Lowering(wiring, method)
    for stretch in wiring.stretches:
        lowering.add(stretch)
    return lowering.program()


def refuse_no_jones(program: Program) -> None:
    """Refuse what Jones columns cannot pass: elements that may depolarise, and loops."""
    cure = "compose with composing='stokes'"
    faults = [
        f"'{step.label}' has a whole Mueller matrix, which may depolarise, and no Jones matrix; "
        f"{cure}"
        for step in program.steps
        if step.evaluation is not None
        and (structure := program.evaluations[step.evaluation].kernel.structure)
        and not structure.jones
    ]
    if program.loops and not faults:
        places = listed([f"'{program.steps[loop.start].label}'" for loop in program.loops[:_FEW]])
        faults.append(
            f"light goes round at {places}, and what adds up there has no Jones vector; {cure}"
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
            stored = detectors if element.detects else dumps
            light, frame = self._read_of(name, port), self._reading_frame(name, port)
            stored[name] = Reading(light, frame, _COMPONENTS[reads])
        return self.builder.program(self.sources, detectors, dumps, self._links())

    def _read_of(self, name: str, port: str) -> int:
        """Return the light that ends somewhere, as far as what stands there responds to it."""
        light = self.lights[name, port]
        response = getattr(self.wiring.elements[name], "response", None)
        if response is None:
            return light
        return self._step(f"{name}.response", (light,), Operation(RESPONSE, (response,)), None)

    def _links(self) -> dict[str, Reading]:
        """Return the light of every link and outlet, if all is to be kept."""
        if self.wiring.keep != "all":
            return {}
        links = self.wiring.graph.edges(keys=True)
        ports = {link_text(link): (link[0], link[2][0]) for link in links}
        for outlet in self.wiring.outlets:
            name, _, leaves = outlet.partition(".")
            ports[outlet] = name, leaves
        return {
            text: Reading(self.lights[port], self._frame_behind(*port))
            for text, port in ports.items()
            if port in self.lights
        }

    def add(self, stretch: Stretch) -> None:
        """Add the steps that make the light at the ports of a stretch."""
        if not stretch.junctions:
            for port in stretch.ports:
                self.lights[port] = self.builder.sum(".".join(port), self._arriving(port))
            return
        outside = {junction: self._arriving(junction) for junction in stretch.junctions}
        for junction in stretch.junctions:
            self.lights[junction] = self.builder.junction(".".join(junction))
        # The junctions come first.
        for port in stretch.ports[len(stretch.junctions) :]:
            self.lights[port] = self.builder.sum(".".join(port), self._arriving(port))
        members = set(stretch.ports)
        inside = {junction: self._arriving(junction, members) for junction in stretch.junctions}
        self.builder.close(
            {
                self.lights[junction]: [*outside[junction], *inside[junction]]
                for junction in stretch.junctions
            }
        )

    def _arriving(self, port: Port, within: set[Port] | None = None) -> list[int]:
        """Return the lights that add up at a port, those from ports within some alone."""
        name, way = port
        if way in self.wiring.elements[name].inputs:
            links = self.wiring.links_to[port]
            starts = [(link[0], link[2][0]) for link in links]
            pairs = zip(links, starts, strict=True)
            return [self._along(link) for link, start in pairs if self._is_there(start, within)]
        return [
            self._pass(name, coupling)
            for coupling in self.wiring.couplings[name]
            if coupling.leaves == way and self._is_lit(name, coupling, within)
        ]

    def _along(self, link: Link) -> int:
        """Return the light of a link in the frame that it enters."""
        start, _, (leaves, _) = link
        light, turn = self.lights[start, leaves], alignment(self.wiring, link)
        return light if turn is None else self._step(link_text(link), (light,), turn, None)

    def _is_there(self, port: Port, within: set[Port] | None) -> bool:
        return port in self.lights and (within is None or port in within)

    def _is_lit(self, name: str, coupling: Coupling, within: set[Port] | None) -> bool:
        if coupling.enters is None:
            return within is None
        return self._is_there((name, coupling.enters), within)

    def _pass(self, name: str, coupling: Coupling) -> int:
        label = f"{name}.{coupling.leaves}"
        if coupling.enters is None:
            light = self._step(label, (), coupling.operations[0], None, port=True)
            self.sources[name] = (light, self._frame_behind(name, coupling.leaves))
            return light
        light = self.lights[name, coupling.enters]
        presence = _presence(coupling.operations)
        if presence is not None and presence.known and not np.any(presence.numbers()):
            return light
        last = len(coupling.operations) - 1
        for place, operation in enumerate(coupling.operations):
            bounces = int(coupling.reflects and place == last)
            light = self._step(label, (light,), operation, presence, port=True, bounces=bounces)
        return light

    def _step(
        self,
        label: str,
        inputs: tuple[int, ...],
        operation: Operation,
        presence: Operand | None,
        **about: Any,
    ) -> int:
        operation = self._lowered(operation)
        return self.builder.step(label, inputs, operation, presence, **about)

    def _lowered(self, operation: Operation) -> Operation:
        """Return an operation by the method, with operands and results of such as arguments."""
        known: dict[int, Operation] = {}
        results: list[Operand | ResultOf] = []
        for argument in operation.arguments:
            if not isinstance(argument, ResultOf):
                results.append(operand_of(argument))
                continue
            inner = argument.operation
            if id(inner) not in known:
                known[id(inner)] = self._lowered(inner)
            results.append(ResultOf(known[id(inner)], argument.place))
        return Operation(operation.kernel.by_method(self.method), tuple(results))

    def _frame_behind(self, name: str, port: str) -> Frame | VertexFrame:
        """Return the frame in which light leaves an element; the unit frame if none is known."""
        result = frame_at(self.wiring, name, port) or vertex_frame(self.wiring, name, port)
        return result or _UNIT

    def _reading_frame(self, name: str, port: str) -> Frame | VertexFrame:
        own = frame_at(self.wiring, name, port)
        if own is not None:
            return own
        links = self.wiring.links_to[name, port]
        arriving = [frame_at(self.wiring, start, leaves) for start, _, (leaves, _) in links]
        placed = next((frame for frame in arriving if frame is not None), None)
        result = placed or vertex_frame(self.wiring, name, port)
        if result or len(links) > 1 or alignment(self.wiring, links[0]) is not None:
            return result or _UNIT
        start, _, (leaves, _) = links[0]
        return self._frame_behind(start, leaves)


def _presence(operations: tuple[Operation, ...]) -> Operand | None:
    for operation in operations:
        for operand in operation.operands():
            value: Any = operand.value
            if isinstance(value, Parameter) and value.optional:
                presence = Operand(value, "present")
                if presence.known and np.all(presence.numbers()):
                    return None
                return presence
    return None
