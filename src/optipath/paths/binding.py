"""Binding: parameters of a path that get their value for good."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values, parameters_of, value_faults
from optipath.errors import OptipathError, ParameterError
from optipath.paths.bound_materials import materials_placed
from optipath.paths.exchanged_values import exchanged
from optipath.values.arrays.read_only import changed
from optipath.values.domains.axis import axes_for
from optipath.values.large_angles import LargeAngles
from optipath.values.open_materials import is_by_wavelength
from optipath.values.other_part import of_complex
from optipath.values.parameters import ABSENT, Parameter
from optipath.values.unknown_parameter import unknown_parameter

if TYPE_CHECKING:
    from collections.abc import Mapping

    import networkx as nx


def bind(
    graph: nx.MultiDiGraph, values: Mapping[str, Any], *, for_good: bool = True
) -> nx.MultiDiGraph:
    """Return a copy of a graph of elements in which parameters have values."""
    if any(map(is_by_wavelength, values.values())):
        values, placed = materials_placed(values, Values(graph).uses)
        if placed and not for_good:
            raise ParameterError(
                f"parameter '{min(placed)}' cannot have as its default what depends on "
                f"other parameters; bind it, by path.bind({min(placed)}=...)"
            )
        graph = exchanged(graph, placed)
        # A material may follow from a wavelength to which the path is bound already.
        graph = exchanged(graph, {n: p for n, p in parameters_of(graph).items() if p.bound})
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
    copy = exchanged(graph, bound)
    faults += value_faults(copy)
    if faults:
        raise ParameterError(*faults)
    LargeAngles(inputs).look(values)
    return copy
