"""Binding: parameters of a path that get their value for good."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

from optipath.composer import parameters_of, value_faults
from optipath.elements.vertices import VerticesByAngles
from optipath.errors import OptipathError, ParameterError, did_you_mean
from optipath.values.materials import Material
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx

    from optipath.elements import Element


def bind(graph: nx.MultiDiGraph, values: Mapping[str, Any]) -> nx.MultiDiGraph:
    """Return a copy of a graph of elements in which parameters are bound to values.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        The elements and links.
    values : mapping
        The value of each parameter, by name.

    Returns
    -------
    networkx.MultiDiGraph

    Raises
    ------
    ParameterError
        With every unknown parameter and every value that is not allowed.
    """
    parameters = parameters_of(graph)
    bound: dict[str, Parameter] = {}
    faults: list[str] = []
    for name, value in values.items():
        if name not in parameters:
            faults.append(f"parameter '{name}' is unknown{did_you_mean(name, parameters)}")
        elif parameters[name].bound:
            known = parameters[name]
            faults.append(f"parameter '{name}' is bound to {known.text(known.default)} already")
        else:
            try:
                bound[name] = replace(parameters[name], default=value, bound=True)
            except OptipathError as fault:
                faults += fault.faults
    copy = graph.copy()
    for node in copy:
        copy.nodes[node]["element"] = _with_bound(copy.nodes[node]["element"], bound)
    for link in copy.edges:
        copy.edges[link]["azimuth"] = _bound_value(copy.edges[link]["azimuth"], bound)
    faults += value_faults(copy)
    if faults:
        raise ParameterError(*faults)
    return copy


def _with_bound(element: Element, bound: Mapping[str, Parameter]) -> Element:
    if not any(parameter.name in bound for parameter in element.parameters()):
        return element
    names = [f.name for f in fields(element)]  # type: ignore[arg-type]
    changed = {name: _bound_value(getattr(element, name), bound) for name in names}
    return replace(element, **changed)  # type: ignore[type-var]


def _bound_value(value: Any, bound: Mapping[str, Parameter]) -> Any:
    if isinstance(value, Material):
        return Material(_bound_value(value.n, bound), _bound_value(value.k, bound))
    if isinstance(value, VerticesByAngles):
        angles = (value.incidences, value.turns)
        return VerticesByAngles(*(tuple(_bound_value(a, bound) for a in each) for each in angles))
    if isinstance(value, tuple):
        return tuple(_bound_value(one, bound) for one in value)
    if isinstance(value, Parameter) and value.name in bound:
        parameter = bound[value.name]
        return -parameter if value.negative else parameter
    return value
