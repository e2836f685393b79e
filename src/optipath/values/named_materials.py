"""Materials that are given by name where an index of refraction stands: ``"gold"``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import OptipathError, ParameterError, shown
from optipath.values.cures import of_options
from optipath.values.curves.curve_value import CurveValue
from optipath.values.database.named_pages import VACUUM
from optipath.values.materials import Material
from optipath.values.other_part import extinctions_beside, places_of
from optipath.values.parameters import Parameter
from optipath.values.plain_json import plain
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from optipath.values.use import Use

WAVELENGTH = Wavelength(help="wavelength in vacuum, by which materials that have a name are taken")
"""What is offered where a preset has no parameter of this name."""


def is_material(parameter: Parameter, text: str, uses: Sequence[Use]) -> bool:
    """Tell whether a text is the name of a material for the index of refraction there."""
    is_range = ":" in text  # Of which an end may be no number.
    if not text[:1].isalpha() or is_range or text in (*parameter.all_words, "inf", "nan"):
        return False
    return stands_for_index(uses, parameter.name)


def stands_for_index(uses: Sequence[Use], name: str) -> bool:
    """Tell whether a parameter stands as an index of refraction, wherever it stands."""
    places = places_of(uses, name)
    return bool(places) and all(use.domain.takes_materials for use in places)


def extinction_beside(uses: Sequence[Use], name: str) -> str:
    """Return the parameter that is the k of an index of which another is n; nothing without one."""
    found = {k.name for k in extinctions_beside(uses, name).values() if isinstance(k, Parameter)}
    return found.pop() if len(found) == 1 else ""


def material_named(option: str, text: str, beside: str = "", k: Any = None) -> Material:
    """Return the material of a name."""
    if "," in text:
        raise ParameterError(
            f"{option} takes one material, and {shown(text)} names several; give one, and write a "
            f"command for each"
        )
    options = {"page": f"{option} '{text}/PAGE'"} | ({"k": beside} if beside else {})
    try:
        with of_options(options):
            return Material.named(text, k=k)
    except OptipathError as error:
        raise ParameterError(*(f"{option}: {fault}" for fault in error.faults)) from None


def take_extinctions(uses: Sequence[Use], values: dict[str, Any]) -> None:
    """Take each k out of some values that a material beside it has in place of its own."""
    for name, value in list(values.items()):
        if isinstance(value, Material):
            values.pop(extinction_beside(uses, name), None)


def materials_among(values: Mapping[str, Any]) -> Iterator[tuple[str, str, Material]]:
    """Yield what is a material among some values: its parameter, what it is called, and itself."""
    for name, value in values.items():
        if isinstance(value, Material):
            curves = [v.curve for v in (value.n, value.k) if isinstance(v, CurveValue)]
            yield name, curves[0].label if curves else VACUUM, value


def material_as_json(label: str, material: Material, wavelength: Any) -> dict[str, Any]:
    """Return what a material is called and comes to, as JSON can hold it.

    Units: wavelength in metres.
    """
    parts = {part: getattr(material, part) for part in ("n", "k")}
    return {"name": label} | {
        part: plain(value.at(wavelength) if isinstance(value, CurveValue) else value)
        for part, value in parts.items()
    }
