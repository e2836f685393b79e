"""Lowering: a validated path graph becomes a program of steps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from optipath.composer.placement import alignment, frame_at, vertex_frame
from optipath.composer.wiring import link_text
from optipath.engines.draft import Draft, DraftStep
from optipath.engines.program import Reading
from optipath.errors import ComposerError
from optipath.faults import listed
from optipath.kernels.catalog import RESPONSE
from optipath.light.frame import Frame
from optipath.values.operands import Operand, Operation, ResultOf, operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Container, Iterable

    from optipath.composer.wiring import Link, Port, Stretch, Wiring
    from optipath.elements.coupling import Coupling
    from optipath.elements.vertex_place import VertexFrame


_FEW = 8

_UNIT = Frame()

_COMPONENTS = {"stokes": 4, "linear": 3, "intensity": 1}


def lower(wiring: Wiring, method: str) -> Draft:
    """Return the draft of a path: ports in the order of travel, each a step or none."""
    lowering = _Lowering(wiring, method)
    for stretch in wiring.stretches:
        lowering.add(stretch)
    return lowering.result()


def refuse_no_jones(draft: Draft) -> None:
    """Refuse what Jones columns cannot pass: elements that may depolarise, and loops."""
    cure = "compose with composing='stokes'"
    faults = [
        f"'{step.label}' has a Mueller matrix, which may depolarise, and no Jones matrix; {cure}"
        for step in draft.steps
        if step.operation is not None
        and (structure := getattr(step.operation.kernel, "structure", None))
        and not structure.jones
    ]
    if draft.loops and not faults:
        places = listed([f"'{draft.steps[min(at)].label}'" for at, _ in draft.loops[:_FEW]])
        faults.append(
            f"light goes round at {places}, and what adds up there has no Jones vector; {cure}"
        )
    ComposerError.raise_for(faults)


class _Lowering:
    """Takes the ports of a path one after the other."""

    def __init__(self, wiring: Wiring, method: str) -> None:
        self.wiring = wiring
        self._links_to, self._couplings = wiring.links_to, wiring.couplings
        self._turned, self._framed = wiring.turned, wiring.framed_links
        self.method = method
        self.draft = Draft()
        self.lights: dict[Port, int] = {}
        self._ways: dict[int, tuple[Operand | None, list[Operation], Coupling]] = {}
        self.sources: dict[str, tuple[int, Frame | VertexFrame]] = {}

    def result(self) -> Draft:
        """Return the steps that have been added, and where their light ends."""
        ends: dict[bool, dict[str, Reading]] = {True: {}, False: {}}
        for name, port in self.wiring.ends:
            element, light = self.wiring.elements[name], self.lights[name, port]
            response = getattr(element, "response", None)
            if response is not None:
                reads = self._lowered(Operation(RESPONSE, (response,)))
                light = self.draft.add(DraftStep(f"{name}.response", (light,), reads))
            components = _COMPONENTS[getattr(element, "reads", "stokes")]
            frame = self._reading_frame(name, port)
            ends[element.detects][name] = Reading(light, frame, components)
        self.draft.ends = {
            "sources": self.sources,
            "detectors": ends[True],
            "dumps": ends[False],
            "links": self._links(),
        }
        return self.draft

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
            self.lights[junction] = self.draft.sum(".".join(junction), ())
        # The junctions come first.
        for port in stretch.ports[len(outside) :]:
            links = self._links_to.get(port)
            if links and len(links) == 1:
                self.lights[port] = self._along(links[0])
            else:
                lights = self._arriving(port)
                self.lights[port] = self.draft.sum(".".join(port), lights)
        if outside:
            within, sums = set(stretch.ports), dict[int, list[int]]()
            for junction, lights in outside.items():
                sums[self.lights[junction]] = [*lights, *self._arriving(junction, within)]
            self.draft.close(sums)

    def _arriving(self, port: Port, within: set[Port] | None = None) -> list[int]:
        """Return the lights that add up at a port, those from ports within some alone."""
        lit: Container[Port] = self.lights if within is None else within
        if links := self._links_to.get(port):
            return [self._along(link) for link in links if (link[0], link[2][0]) in lit]
        name, way = port
        return [
            self._pass(name, coupling)
            for coupling in self._couplings[name]
            if coupling.leaves == way
            and (within is None if coupling.enters is None else (name, coupling.enters) in lit)
        ]

    def _along(self, link: Link) -> int:
        """Return the light of a link in the frame that it enters."""
        start, end, (leaves, _) = link
        light = self.lights[start, leaves]
        if (end not in self._turned and link not in self._framed) or (
            turn := alignment(self.wiring, link)
        ) is None:
            return light
        return self.draft.add(DraftStep(link_text(link), (light,), self._lowered(turn)))

    def _pass(self, name: str, coupling: Coupling) -> int:
        label = f"{name}.{coupling.leaves}"
        # One element may stand in many places.
        if (known := self._ways.get(id(coupling))) is None:
            operations = [self._lowered(operation) for operation in coupling.operations]
            known = self._ways[id(coupling)] = _presence(coupling.operations), operations, coupling
        presence, operations, _ = known
        if coupling.enters is None:
            light = self.draft.add(DraftStep(label, (), operations[0], bounces=0))
            self.sources[name] = (light, self._frame_behind(name, coupling.leaves))
            return light
        light = self.lights[name, coupling.enters]
        if presence is not None and presence.known:
            if np.all(there := presence.numbers()):
                presence = None
            elif not np.any(there):
                return light
        last = len(operations) - 1
        for place, operation in enumerate(operations):
            bounces = int(coupling.reflects and place == last)
            light = self.draft.add(DraftStep(label, (light,), operation, presence, bounces))
        return light

    def _lowered(self, operation: Operation) -> Operation:
        """Return an operation by the method, with floats, operands and results as arguments."""
        kernel = operation.kernel.by_method(self.method)
        if operation.is_of_floats:
            is_one = kernel is operation.kernel
            return operation if is_one else Operation(kernel, operation.arguments)
        known: dict[int, Operation] = {}
        results: list[float | Operand | ResultOf] = []
        for argument in operation.arguments:
            if type(argument) is float:
                results.append(argument)
            elif type(argument) is ResultOf:
                inner = argument.operation
                if id(inner) not in known:
                    known[id(inner)] = self._lowered(inner)
                results.append(ResultOf(known[id(inner)], argument.place))
            else:
                operand = operand_of(argument)
                is_bound = isinstance(operand.value, Parameter) and operand.value.bound
                results.append(_number_bound(operand) if is_bound else operand)
        return Operation(kernel, tuple(results))

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


def _presence(operations: Iterable[Operation]) -> Operand | None:
    for operation in operations:
        for argument in operation.arguments:
            if type(argument) is ResultOf:
                if inner := _presence([argument.operation]):
                    return inner
                continue
            value = argument.value if type(argument) is Operand else argument
            if isinstance(value, Parameter) and value.optional:
                return Operand(value, "present")
    return None
