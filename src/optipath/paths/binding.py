"""Binding: parameters of a path that get their value for good."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import parameters_of, value_faults
from optipath.errors import OptipathError, ParameterError, did_you_mean
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx


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
    for node in copy.nodes.values():
        if any(parameter.name in bound for parameter in node["element"].parameters()):
            node["element"] = _with_bound_fields(node["element"], bound)
    for link in copy.edges.values():
        link["azimuth"] = _bound_value(link["azimuth"], bound)
    faults += value_faults(copy)
    if faults:
        raise ParameterError(*faults)
    return copy


def _with_bound_fields(whole: Any, bound: Mapping[str, Parameter]) -> Any:
    changed = {f.name: _bound_value(getattr(whole, f.name), bound) for f in fields(whole)}
    same = all(changed[name] is getattr(whole, name) for name in changed)
    return whole if same else replace(whole, **changed)


def _bound_value(value: Any, bound: Mapping[str, Parameter]) -> Any:
    if isinstance(value, Parameter):
        parameter = bound.get(value.name)
        return value if parameter is None else -parameter if value.negative else parameter
    if isinstance(value, tuple):
        return tuple(_bound_value(one, bound) for one in value)
    # What is made of several values, as a material and a chain of vertices are.
    return _with_bound_fields(value, bound) if is_dataclass(value) else value
