"""Lowering: a validated path graph becomes a program of steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.builder import Builder
from optipath.composer.placement import alignment, frame_at, vertex_frame
from optipath.composer.wiring import link_text
from optipath.engines.program import Reading
from optipath.errors import ComposerError
from optipath.faults import listed
from optipath.kernels.catalog import RESPONSE
from optipath.light.frame import Frame
from optipath.values.operands import Operand, Operation, ResultOf, operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Container

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
        f"'{step.label}' has a Mueller matrix, which may depolarise, and no Jones matrix; {cure}"
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
    ComposerError.raise_for(faults)


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
        ends: dict[bool, dict[str, Reading]] = {True: {}, False: {}}
        for name, port in self.wiring.ends:
            element, light = self.wiring.elements[name], self.lights[name, port]
            response = getattr(element, "response", None)
            if response is not None:
                reads = self._lowered(Operation(RESPONSE, (response,)))
                light = self.builder.step(f"{name}.response", (light,), reads)
            components = _COMPONENTS[getattr(element, "reads", "stokes")]
            frame = self._reading_frame(name, port)
            ends[element.detects][name] = Reading(light, frame, components)
        return self.builder.program(
            sources=self.sources, detectors=ends[True], dumps=ends[False], links=self._links()
        )

    def _links(self) -> dict[str, Reading]:
        """Return the light of every link and outlet, if all is to be kept."""
        if self.wiring.keep != "all":
            return {}
        links = self.wiring.graph.edges(keys=True)
        ports = {link_text(link): (link[0], link[2][0]) for link in links}
        for outlet in self.wiring.outlets:
            name, _, leaves = outlet.partition(".")
            ports[outlet] = name, leaves
        lit = {text: port for text, port in ports.items() if port in self.lights}
        return {text: Reading(self.lights[p], self._frame_behind(*p)) for text, p in lit.items()}

    def add(self, stretch: Stretch) -> None:
        """Add the steps that make the light at the ports of a stretch."""
        outside = {junction: self._arriving(junction) for junction in stretch.junctions}
        for junction in outside:
            self.lights[junction] = self.builder.sum(".".join(junction), ())
        # The junctions come first.
        for port in stretch.ports[len(outside) :]:
            self.lights[port] = self.builder.sum(".".join(port), self._arriving(port))
        if outside:
            within, sums = set(stretch.ports), dict[int, list[int]]()
            for junction, lights in outside.items():
                sums[self.lights[junction]] = [*lights, *self._arriving(junction, within)]
            self.builder.close(sums)

    def _arriving(self, port: Port, within: set[Port] | None = None) -> list[int]:
        """Return the lights that add up at a port, those from ports within some alone."""
        name, way = port
        lit: Container[Port] = self.lights if within is None else within
        if way in self.wiring.elements[name].inputs:
            links = self.wiring.links_to[port]
            return [self._along(link) for link in links if (link[0], link[2][0]) in lit]
        return [
            self._pass(name, coupling)
            for coupling in self.wiring.couplings[name]
            if coupling.leaves == way
            and (within is None if coupling.enters is None else (name, coupling.enters) in lit)
        ]

    def _along(self, link: Link) -> int:
        """Return the light of a link in the frame that it enters."""
        start, _, (leaves, _) = link
        light, turn = self.lights[start, leaves], alignment(self.wiring, link)
        if turn is None:
            return light
        return self.builder.step(link_text(link), (light,), self._lowered(turn))

    def _pass(self, name: str, coupling: Coupling) -> int:
        label = f"{name}.{coupling.leaves}"
        operations = map(self._lowered, coupling.operations)
        if coupling.enters is None:
            light = self.builder.step(label, (), next(operations), port=True)
            self.sources[name] = (light, self._frame_behind(name, coupling.leaves))
            return light
        light = self.lights[name, coupling.enters]
        presence = _presence(coupling.operations)
        if presence is not None and presence.known:
            if np.all(there := presence.numbers()):
                presence = None
            elif not np.any(there):
                return light
        last = len(coupling.operations) - 1
        for place, operation in enumerate(operations):
            about = {"port": True, "bounces": int(coupling.reflects and place == last)}
            light = self.builder.step(label, (light,), operation, presence, **about)
        return light

    def _lowered(self, operation: Operation) -> Operation:
        """Return an operation by the method, with operands and results of such as arguments."""
        known: dict[int, Operation] = {}
        results: list[Operand | ResultOf] = []
        for argument in operation.arguments:
            if not isinstance(argument, ResultOf):
                operand = operand_of(argument)
                is_bound = isinstance(operand.value, Parameter) and operand.value.bound
                results.append(_number_bound(operand) if is_bound else operand)
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
        links = self.wiring.links_to[name, port]
        places = [(name, port), *((start, leaves) for start, _, (leaves, _) in links)]
        placed = (frame_at(self.wiring, *place) for place in places)
        own = next((frame for frame in placed if frame is not None), None)
        result = own or vertex_frame(self.wiring, name, port)
        if result or len(links) > 1 or alignment(self.wiring, links[0]) is not None:
            return result or _UNIT
        return self._frame_behind(*places[1])


def _number_bound(operand: Operand) -> Operand:
    """Return the number to which a parameter is bound, or the operand where it is no such."""
    number = operand.value.default
    if type(number) is not float or operand.part not in ("value", "real", "imag"):
        return operand
    return Operand(0.0 if operand.part == "imag" else operand.value.placed(number))


def _presence(operations: tuple[Operation, ...]) -> Operand | None:
    for operation in operations:
        for operand in operation.operands():
            value: Any = operand.value
            if isinstance(value, Parameter) and value.optional:
                return Operand(value, "present")
    return None
