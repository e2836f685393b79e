"""The values of a path: which are known, which are parameters, and whether they fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.domains import Choice
from optipath.elements import Interface
from optipath.errors import ValueFault
from optipath.inputs import Inputs, Use, broadcast_fault
from optipath.parameters import Parameter
from optipath.units import dimension_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    import networkx as nx

_LINK_AZIMUTH = Interface.domains()["azimuth"]


def uses_of(graph: nx.MultiDiGraph) -> Iterator[Use]:
    """Yield every number of the path, node by node, then link by link."""
    for name, element in graph.nodes(data="element"):
        for part, value, domain in element.quantities():
            yield Use(f"{name}.{part}", value, domain)
    for start, end, (leaves, enters), azimuth in graph.edges(keys=True, data="azimuth"):
        if azimuth is not None:
            owner = f"link '{start}.{leaves} -> {end}.{enters}' azimuth"
            yield Use(owner, azimuth, _LINK_AZIMUTH)


def parameters_of(graph: nx.MultiDiGraph) -> dict[str, Parameter]:
    """Return the parameters of a path by name: in declared order, then as they are met."""
    found: dict[str, Parameter] = {}
    for use in uses_of(graph):
        if isinstance(use.value, Parameter) and use.value.name not in found:
            found[use.value.name] = -use.value if use.value.negative else use.value
    declared = [name for name in graph.graph.get("declared", ()) if name in found]
    return {name: found[name] for name in dict.fromkeys([*declared, *found])}


def inputs_of(graph: nx.MultiDiGraph) -> Inputs:
    """Return what may be given when the path is run."""
    parameters = parameters_of(graph)
    return Inputs(
        open={name: p for name, p in parameters.items() if not p.bound},
        bound={name: p for name, p in parameters.items() if p.bound},
        uses=tuple(use for use in uses_of(graph) if use.is_open),
        shapes=_known_shapes(graph),
    )


def value_faults(graph: nx.MultiDiGraph) -> list[str]:
    """Return what is wrong with the values that are known, a sentence each."""
    found: list[str] = []
    for use in uses_of(graph):
        try:
            _check(use)
        except ValueFault as fault:
            found += fault.faults
    found += _parameter_faults(graph)
    return found or broadcast_fault(_known_shapes(graph))


def _known_shapes(graph: nx.MultiDiGraph) -> dict[str, tuple[int, ...]]:
    shapes = {}
    for use in uses_of(graph):
        if not use.is_open:
            known = use.value.default if isinstance(use.value, Parameter) else use.value
            shapes[use.owner] = use.batch_shape(known)
    for name, frames in graph.nodes(data="frames"):
        shapes |= {f"frame of {name}.{port}": f.z.shape[:-1] for port, f in frames.items()}
    return {owner: shape for owner, shape in shapes.items() if shape}


def _check(use: Use) -> None:
    if not isinstance(use.value, Parameter):
        use.domain.check(use.owner, use.value)
        return
    if isinstance(use.domain, Choice):
        raise ValueFault(f"{use.owner} cannot be a parameter; choose one word when building")
    unit, name = use.value.unit, use.value.name
    if unit and dimension_of(unit) != use.domain.dimension:
        raise ValueFault(
            f"parameter '{name}' is in {unit}, but {use.owner} takes {use.domain.described()}; "
            f"change its unit or where it is used"
        )
    if use.value.default is not None:
        use.check_given(use.value.resolve(use.value.default).value)


def _parameter_faults(graph: nx.MultiDiGraph) -> Iterator[str]:
    first = parameters_of(graph)
    for use in uses_of(graph):
        if not isinstance(use.value, Parameter):
            continue
        name = use.value.name
        if not use.value.same_specification(first[name]):
            yield (
                f"parameter '{name}' at {use.owner} differs from the one of that name "
                f"elsewhere; use one Parameter, or two names"
            )
        if use.value.optional and not _can_be_absent(graph, use.owner):
            yield (
                f"parameter '{name}' is optional, but the element of {use.owner} cannot be "
                f"left out; only one that light goes straight through can"
            )


def _can_be_absent(graph: nx.MultiDiGraph, owner: str) -> bool:
    name, _, part = owner.rpartition(".")
    if name not in graph or part == "azimuth":
        return False
    element = graph.nodes[name]["element"]
    ways = [(coupling.enters, coupling.leaves) for coupling in element.couplings()]
    return bool(element.straight) and ways == [("in", "out")]
