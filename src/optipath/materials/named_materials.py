"""Materials by name, or known later, where an index of refraction is given."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, UnitError
from optipath.faults import Fault, listed, shown
from optipath.materials.database_names import VACUUM
from optipath.materials.material import Material
from optipath.materials.quantities import plain
from optipath.values.curve import Curve
from optipath.values.curve_value import CurveValue, curve_values, parameters_among
from optipath.values.parameters import Parameter
from optipath.values.units import parse_quantity
from optipath.values.use import axes_for
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from optipath.values.use import Use


WAVELENGTH = Wavelength(help="wavelength in vacuum, by which materials that have a name are taken")
"""What is offered where a preset has no parameter of this name."""


def is_material(parameter: Parameter, text: str, uses: Sequence[Use]) -> bool:
    """Tell whether a text is the name of a material for the index of refraction there."""
    # An end of a range may be no number.
    is_name = text[:1].isalpha() and ":" not in text
    is_word = text in (*parameter.all_words, "inf", "nan")
    return is_name and not is_word and stands_for_index(uses, parameter.name)


def stands_for_index(uses: Sequence[Use], name: str) -> bool:
    """Tell whether a parameter stands as an index of refraction, wherever it stands."""
    places = places_of(uses, name)
    return bool(places) and all(use.domain.takes_materials for use in places)


def extinction_with(uses: Sequence[Use], name: str) -> str:
    """Return the parameter that is the k of an index of which another is n; nothing without one."""
    results = {k.name for k in extinctions_with(uses, name).values() if isinstance(k, Parameter)}
    return results.pop() if len(results) == 1 else ""


def material_named(option: str, text: str, k: Any = None) -> Material:
    """Return the material of a name."""
    if "," in text:
        raise ParameterError(
            f"{option} takes one material, and {shown(text)} names several; give one, and write a "
            f"command for each"
        )
    with ParameterError.wrapping(option):
        return Material.named(text, k=k)


def materials_among(values: Mapping[str, Any]) -> Iterator[tuple[str, str, Material]]:
    """Yield what is a material among some values: its parameter, what it is called, and itself."""
    for name, value in values.items():
        if isinstance(value, Material):
            curves = [v.curve for v in (value.n, value.k) if isinstance(v, CurveValue)]
            yield name, curves[0].label if curves else VACUUM, value


def material_as_json(label: str, material: Material, wavelength: Any) -> dict[str, Any]:
    """Return the name of a material and its values at wavelengths in metres, for JSON."""
    n, k = [v.at(wavelength) if isinstance(v, CurveValue) else v for v in (material.n, material.k)]
    return {"name": label, "n": plain(n), "k": plain(k)}


def is_curve(argument: Any) -> bool:
    """Return whether something is one curve, or what it comes to at a wavelength."""
    one = isinstance(argument, Curve) and len(argument.parts) == 1
    return one or isinstance(argument, CurveValue)


def is_by_wavelength(argument: Any) -> bool:
    """Return whether something is put in place of a parameter: a material, or one curve.

    >>> is_by_wavelength(Material(1.5)), is_by_wavelength(1.5)
    (True, False)
    """
    return isinstance(argument, Material) or is_curve(argument)


def waits_for(argument: Any) -> Sequence[str]:
    """Return the names of the parameters that a material or curve depends on; else none.

    >>> waits_for(Material(1.5, Parameter("k"))), waits_for(Material(1.5))
    (['k'], [])
    """
    if not is_by_wavelength(argument):
        return []
    if isinstance(argument, Curve):
        argument = curve_values(argument, Wavelength())[0]
    parts = [argument.n, argument.k] if isinstance(argument, Material) else [argument]
    waiting = [p for p in parameters_among(parts) if not isinstance(p, CurveValue)]
    return [*dict.fromkeys(parameter.name for parameter in waiting)]


def passed_too_late(name: str, argument: Any) -> str:
    """Return the fault of a material or curve that is given while a path runs; mostly none."""
    if not (names := waits_for(argument)):
        return ""
    return (
        f"parameter '{name}' depends on {listed(names)}, and is put in place "
        f"before a path runs; write path.bind({name}=...), or load_preset(..., {name}=...)"
    )


_OTHER = {"n": "k", "k": "n"}


def other_part(uses: Iterable[Use], name: str, how: Callable[[str], str] = str) -> str:
    """Say how the other part of a complex index is given; nothing where there is none."""
    uses = [*uses]
    values = {use.owner: use.value for use in uses}
    for place, _, part in [use.owner.rpartition(".") for use in places_of(uses, name)]:
        other = _OTHER.get(part, "")
        result = values.get(f"{place}.{other}")
        if isinstance(result, CurveValue):
            return f"{other} is that of {result.curve.label}; give {part} alone, a real number"
        if isinstance(result, Parameter):
            return f"give {other} by {how(result.name)}"
        if isinstance(result, (int, float)):
            return f"{other} is {result:g} where the path is built; make it a parameter there"
    return ""


def places_of(uses: Iterable[Use], name: str) -> list[Use]:
    """Return where a parameter stands."""
    return [u for u in uses if isinstance(u.value, Parameter) and u.value.name == name]


def extinctions_with(uses: Iterable[Use], name: str) -> dict[str, Any]:
    """Return what k is wherever a parameter stands as the n of an index."""
    values = {use.owner: use.value for use in uses}
    owners = [use.owner for use in places_of(uses, name) if use.owner.endswith(".n")]
    return {k: values[k] for k in (f"{owner[:-1]}k" for owner in owners) if k in values}


def of_complex(faults: Iterable[Fault], uses: Iterable[Use], name: str, value: Any) -> list[Fault]:
    """Return faults of a value; those of a complex one with how its other part is given."""
    cure = other_part(uses, name) if _is_complex(value) else ""
    return [fault.cured(cure).but(subject=name) for fault in faults]


def _is_complex(value: Any) -> bool:
    if isinstance(value, Material):
        return not waits_for(value) and not (isinstance(value.k, (int, float)) and value.k == 0.0)
    if isinstance(value, str):
        try:
            value = parse_quantity(value, "")
        except UnitError:
            return False
    return isinstance(value, (complex, np.complexfloating, np.ndarray)) and np.iscomplexobj(value)


def single_value(
    parameter: Parameter,
    text: str,
    uses: Sequence[Use],
    unit: str = "",
    called: Callable[[str], str] = str,
) -> Any:
    """Return what a text stands for: a number, a word of the parameter, or an axis.

    >>> single_value(Parameter("delta", unit="deg"), "180", (), "deg")
    3.141592653589793
    """
    value = axes_for(parameter.name, text, uses)
    value = parameter.parse(value, unit) if isinstance(value, str) else value
    if isinstance(value, complex) and (other := other_part(uses, parameter.name, called)):
        name = called(parameter.name)
        raise ParameterError(f"'{text}' is complex, but {name} takes a real number; {other}")
    return value
