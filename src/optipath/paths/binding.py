"""Binding: values, materials and curves put in place of parameters."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values
from optipath.errors import OptipathError, ParameterError, collecting
from optipath.materials.material import Material
from optipath.materials.named_materials import (
    extinctions_with,
    is_by_wavelength,
    of_complex,
    places_of,
    waits_for,
)
from optipath.plan.inputs import LargeAngles
from optipath.values.arrays import changed, same
from optipath.values.curve import Curve
from optipath.values.curve_value import CurveValue, curve_values
from optipath.values.parameters import ABSENT, Parameter, unknown_parameter
from optipath.values.use import axes_for, checked_later
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Container, Mapping, Sequence

    import networkx as nx

    from optipath.values.cases import Case
    from optipath.values.use import Use


def bind(known: Values, values: Mapping[str, Any], *, for_good: bool = True) -> Values:
    """Return the values of a copy of a path in which parameters have values."""
    if any(map(is_by_wavelength, values.values())):
        values, placed = materials_placed(values, known.uses)
        if placed and not for_good:
            raise ParameterError(
                f"parameter '{min(placed)}' cannot have as its default what depends on "
                f"other parameters; bind it, by path.bind({min(placed)}=...)"
            )
        known = Values(exchanged(known.graph, placed))
        # A material may follow from a wavelength to which the path is bound already.
        wholly = {name: p for name, p in known.parameters.items() if p.bound}
        known = Values(exchanged(known.graph, wholly))
    parameters, inputs = known.parameters, known.inputs()
    known_names = [*parameters, *known.graph.graph["choices"]]
    bound: dict[str, Parameter] = {}
    faults: list[str] = []
    for name, value in values.items():
        if name not in parameters:
            faults.append(unknown_parameter(name, known_names))
        elif parameters[name].bound:
            bound_to = parameters[name].text(parameters[name].default)
            faults.append(
                f"parameter '{name}' is bound to {bound_to} already; give the "
                f"value where it is bound, or leave it open there"
            )
        elif value is None:
            absent = f"; {name}='{ABSENT}' leaves its element out" * parameters[name].optional
            faults.append(f"parameter '{name}' is None, which is no value; give one{absent}")
        else:
            try:
                # Whether it is one of degrees is looked at below, where all is well.
                known_value = axes_for(name, value, inputs.uses)
                parameter = replace(parameters[name], default=known_value, bound=True)
                bound[name] = changed(parameter, bound=for_good)
            except OptipathError as fault:
                faults += of_complex(fault.faults, known.uses, name, value)
    result = Values(exchanged(known.graph, bound))
    faults += result.faults
    if faults:
        raise ParameterError(*faults)
    LargeAngles(inputs).look(values)
    return result


def materials_placed(
    values: Mapping[str, Any], uses: Sequence[Use]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what is bound once curves are in place, and materials give n and k."""
    placed: dict[str, Any] = {}
    plain, faults = dict(values), []
    for name, material in values.items():
        places = places_of(uses, name)
        known = not places or places[0].value.bound or isinstance(places[0].value, Wavelength)
        if known or not is_by_wavelength(material):
            continue
        if not isinstance(material, Material):
            curve = isinstance(material, Curve)
            placed[name] = curve_values(material, Wavelength())[0] if curve else material
            del plain[name]
            continue
        wrong: list[str] = []
        with collecting(wrong):
            for use in places:
                use.refuse_material(material)
        if wrong:
            faults += wrong
            continue
        other = extinctions_with(uses, name)
        arguments: dict[str, Any] = {name: material.n} if other else {name: material}
        if other:
            arguments |= {k.name: material.k for k in other.values() if isinstance(k, Parameter)}
        elif not waits_for(material):
            continue  # One complex number.
        if wrong := _faults(name, material, other, places, values, uses):
            faults += wrong
            continue
        for part, value in arguments.items():
            plain.pop(part, None)
            is_number = not isinstance(value, (Parameter, Material))
            (plain if is_number else placed)[part] = value
    if faults:
        raise ParameterError(*dict.fromkeys(faults))
    return plain, placed


def from_materials(graph: nx.MultiDiGraph, values: Mapping[str, Any]) -> set[str]:
    """Return the parameters that are the k of materials among some values."""
    names = [name for name, value in values.items() if isinstance(value, Material)]
    uses = Values(graph).uses if names else ()
    results = [k for name in names for k in extinctions_with(uses, name).values()]
    return {k.name for k in results if isinstance(k, Parameter)}


def _faults(
    name: str,
    material: Material,
    neighbors: Mapping[str, Any],
    places: Sequence[Use],
    values: Mapping[str, Any],
    uses: Sequence[Use],
) -> list[str]:
    """Return why a material cannot stand where the parameter does, or give its k there."""
    faults = [
        f"parameter '{name}' stands as {use.value.formula} at {use.owner}, for which no Material "
        f"can be given; let '{name}' itself stand there"
        for use in places
        if not use.value.is_signed or use.value.is_negative
    ]
    for owner, k in neighbors.items():
        if not isinstance(k, Parameter):
            if not same(k, material.k):
                faults.append(
                    f"{owner} is {k:g} where the path is built, but {material} has a k of its "
                    f"own; make it a parameter there"
                )
        elif k.name in values:
            faults.append(
                f"parameter '{k.name}' is given by '{name}', a Material, which has its own k; "
                f"leave {k.name} out, or make a Material of that k"
            )
        elif k.bound or not k.is_signed or k.is_negative:
            faults.append(
                f"{owner} is {k.formula}, so that no Material can give it; let the parameter "
                f"'{k.name}' itself stand there, and leave it open"
            )
        elif others := {use.owner for use in places_of(uses, k.name)} - {*neighbors}:
            faults.append(
                f"parameter '{k.name}' stands at {min(others)} besides, of which '{name}' says "
                f"nothing; use two names"
            )
    if neighbors and len({use.owner for use in places}) > len(neighbors):
        faults.append(
            f"parameter '{name}' is n beside a k in one place, and stands without a k in another; "
            f"use two names"
        )
    return faults


def cases_left(cases: Mapping[str, Case], known: Container[str]) -> dict[str, Case]:
    """Return the cases of a path in which parameters are there no more."""
    results = {}
    for name, case in cases.items():
        left = {argument: value for argument, value in case.values.items() if argument in known}
        same_values = len(left) == len(case.values)
        results[name] = case if same_values else replace(case, values=left, published={}, note="")
    return results


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
        result = values.get(value.name, value)
        stored = result is value or not isinstance(result, Parameter)
        if stored or not isinstance(result, CurveValue):
            return result if stored else result.like(value)
        return changed(
            result,
            scale=value.scale * result.scale,
            offset=value.scale * result.offset + value.offset,
            offset_dimension=value.offset_dimension or result.offset_dimension,
        )
    if isinstance(value, tuple):
        return tuple(_exchanged(one, values) for one in value)
    # What is made of several values, as a material and a chain of vertices are.
    return _with_other_fields(value, values) if is_dataclass(value) else value
