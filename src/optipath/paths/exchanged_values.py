"""Parameters of a graph whose places other values take."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.values.curves.curve_value import CurveValue
from optipath.values.made import checked_later
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx


def exchanged(graph: nx.MultiDiGraph, values: Mapping[str, Any]) -> nx.MultiDiGraph:
    """Return a copy of a graph in which other values stand for parameters."""
    copy = graph.copy()
    with checked_later():  # The check of the whole path names parameters and nodes.
        for node in copy.nodes.values():
            if any(parameter.name in values for parameter in node["element"].parameters()):
                node["element"] = _with_other_fields(node["element"], values)
    for link in copy.edges.values():
        link["azimuth"] = _exchanged(link["azimuth"], values)
    return copy


def _with_other_fields(whole: Any, values: Mapping[str, Any]) -> Any:
    others = {f.name: _exchanged(getattr(whole, f.name), values) for f in fields(whole)}
    same = all(others[name] is getattr(whole, name) for name in others)
    return whole if same else replace(whole, **others)


def _exchanged(value: Any, values: Mapping[str, Any]) -> Any:
    if isinstance(value, CurveValue):
        return value.bound_to(values)
    if isinstance(value, Parameter):
        found = values.get(value.name, value)
        kept = found is value or not isinstance(found, Parameter)
        if kept or not isinstance(found, CurveValue):
            return found if kept else found.like(value)
        offset = value.scale * found.offset + value.offset
        dimension = value.offset_dimension or found.offset_dimension
        return found.shaped(value.scale * found.scale, offset, dimension)
    if isinstance(value, tuple):
        return tuple(_exchanged(one, values) for one in value)
    # What is made of several values, as a material and a chain of vertices are.
    return _with_other_fields(value, values) if is_dataclass(value) else value
