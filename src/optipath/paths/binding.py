"""Binding: parameters of a path that get their value for good."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values, value_faults
from optipath.errors import OptipathError, ParameterError
from optipath.values.arrays.read_only import changed
from optipath.values.curves.curve_value import CurveValue
from optipath.values.domains.axis import axes_for
from optipath.values.large_angles import LargeAngles
from optipath.values.made import checked_later
from optipath.values.other_part import of_complex
from optipath.values.parameters import ABSENT, Parameter
from optipath.values.unknown_parameter import unknown_parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx


def bind(
    graph: nx.MultiDiGraph, values: Mapping[str, Any], *, for_good: bool = True
) -> nx.MultiDiGraph:
    """Return a copy of a graph of elements in which parameters have values.

    Parameters
    ----------
    graph : networkx.MultiDiGraph
        The elements and links.
    values : mapping
        The value of each parameter, by name.
    for_good : bool, optional
        Whether they are bound to these, which are their defaults otherwise.

    Returns
    -------
    networkx.MultiDiGraph

    Raises
    ------
    ParameterError
        With every unknown parameter and every value that is not allowed.
    """
    known_values = Values(graph)
    parameters, inputs = known_values.parameters, known_values.inputs()
    known_names = [*parameters, *graph.graph.get("choices", ())]
    bound: dict[str, Parameter] = {}
    faults: list[str] = []
    for name, value in values.items():
        if name not in parameters:
            faults.append(unknown_parameter(name, known_names))
        elif parameters[name].bound:
            known = parameters[name]
            faults.append(
                f"parameter '{name}' is bound to {known.text(known.default)} already; give the "
                f"value where it is bound, or leave it open there"
            )
        elif value is None:
            absent = f"; {name}='{ABSENT}' leaves its element out" * parameters[name].optional
            faults.append(f"parameter '{name}' is None, which is no value; give one{absent}")
        else:
            try:
                # Whether it is one of degrees is looked at below, where all is well.
                known_value = axes_for(name, value, inputs.uses)
                found = replace(parameters[name], default=known_value, bound=True)
                bound[name] = changed(found, bound=for_good)
            except OptipathError as fault:
                faults += of_complex(fault.faults, Values(graph).uses, name, value)
    copy = graph.copy()
    with checked_later():  # The check below names parameters and nodes.
        for node in copy.nodes.values():
            if any(parameter.name in bound for parameter in node["element"].parameters()):
                node["element"] = _with_bound_fields(node["element"], bound)
    for link in copy.edges.values():
        link["azimuth"] = _bound_value(link["azimuth"], bound)
    faults += value_faults(copy)
    if faults:
        raise ParameterError(*faults)
    LargeAngles(inputs).look(values)
    return copy


def _with_bound_fields(whole: Any, bound: Mapping[str, Parameter]) -> Any:
    others = {f.name: _bound_value(getattr(whole, f.name), bound) for f in fields(whole)}
    same = all(others[name] is getattr(whole, name) for name in others)
    return whole if same else replace(whole, **others)


def _bound_value(value: Any, bound: Mapping[str, Parameter]) -> Any:
    if isinstance(value, CurveValue):
        return value.bound_to(bound)
    if isinstance(value, Parameter):
        parameter = bound.get(value.name)
        return value if parameter is None else parameter.like(value)
    if isinstance(value, tuple):
        return tuple(_bound_value(one, bound) for one in value)
    # What is made of several values, as a material and a chain of vertices are.
    return _with_bound_fields(value, bound) if is_dataclass(value) else value
