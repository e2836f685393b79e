"""Materials and curves that are bound to parameters; a material gives n, and k with it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from optipath.composer.path_values import Values
from optipath.errors import ParameterError
from optipath.values.arrays.read_only import same
from optipath.values.curves.curve import Curve
from optipath.values.curves.curve_value import curve_values
from optipath.values.materials import Material
from optipath.values.open_materials import is_by_wavelength, waits_for
from optipath.values.other_part import extinctions_beside, places_of
from optipath.values.parameters import Parameter
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Container, Mapping, Sequence

    import networkx as nx

    from optipath.values.cases import Case
    from optipath.values.use import Use


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
        if doubts := [doubt for use in places if (doubt := use.doubt(material))]:
            faults.append(doubts[0])
            continue
        beside = extinctions_beside(uses, name)
        given: dict[str, Any] = {name: material.n} if beside else {name: material}
        if beside:
            given |= {k.name: material.k for k in beside.values() if isinstance(k, Parameter)}
        elif not waits_for(material):
            continue  # One complex number.
        if wrong := _faults(name, material, beside, places, values, uses):
            faults += wrong
            continue
        for part, value in given.items():
            plain.pop(part, None)
            is_number = not isinstance(value, (Parameter, Material))
            (plain if is_number else placed)[part] = value
    if faults:
        raise ParameterError(*dict.fromkeys(faults))
    return plain, placed


def given_by_materials(graph: nx.MultiDiGraph, values: Mapping[str, Any]) -> set[str]:
    """Return the parameters that are the k of materials among some values."""
    names = [name for name, value in values.items() if isinstance(value, Material)]
    uses = Values(graph).uses if names else ()
    found = [k for name in names for k in extinctions_beside(uses, name).values()]
    return {k.name for k in found if isinstance(k, Parameter)}


def _faults(
    name: str,
    material: Material,
    beside: Mapping[str, Any],
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
    for owner, k in beside.items():
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
        elif others := {use.owner for use in places_of(uses, k.name)} - {*beside}:
            faults.append(
                f"parameter '{k.name}' stands at {min(others)} besides, of which '{name}' says "
                f"nothing; use two names"
            )
    if beside and len({use.owner for use in places}) > len(beside):
        faults.append(
            f"parameter '{name}' is n beside a k in one place, and stands without a k in another; "
            f"use two names"
        )
    return faults


def cases_left(cases: Mapping[str, Case], known: Container[str]) -> dict[str, Case]:
    """Return the cases of a path in which parameters are there no more."""
    found = {}
    for name, case in cases.items():
        left = {given: value for given, value in case.values.items() if given in known}
        same_values = len(left) == len(case.values)
        found[name] = case if same_values else replace(case, values=left, published={}, note="")
    return found
