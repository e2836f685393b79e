"""The parameters that a file declares, and those of which something is wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.errors import shown
from optipath.paths.format.references import wavelength_names
from optipath.paths.presets.reader.parameter_tables import read_parameter
from optipath.values.parameters import Parameter
from optipath.values.units import USUAL_UNITS, dimension_of, with_article

if TYPE_CHECKING:
    from collections.abc import Collection

    from optipath.composer.path_values import Values
    from optipath.paths.format.faults import Faults


class Declarations(dict[str, Parameter]):
    """Parameters by name, bare ones in place of those that are faulty."""

    def __init__(self) -> None:
        super().__init__()
        self.doubtful: set[str] = set()


def read_declarations(
    document: dict[str, Any], references: Collection[str], faults: Faults
) -> Declarations:
    """Return the parameters that a document declares."""
    found, tables = Declarations(), document.get("parameters", {})
    readable = tables_of(document, "parameters", faults)
    wavelengths = wavelength_names(document.get("elements"))
    # Without the tables, nobody knows what they have declared.
    for name in tables if isinstance(tables, dict) else references:
        table = readable.get(name)
        parameter = None if table is None else read_parameter(name, table, wavelengths, faults)
        if parameter is None:
            found.doubtful.add(name)
            parameter = Parameter(name if name.isidentifier() else "unknown")
        found[name] = parameter
    found.doubtful.update(name for name in references if name not in found)
    return found


def tables_of(document: dict[str, Any], section: str, faults: Faults) -> dict[str, Any]:
    """Return the tables of a section, without what is none."""
    tables = document.get(section, {})
    entries = tables.items() if isinstance(tables, dict) else ()
    wrong = {name: table for name, table in entries if not isinstance(table, dict)}
    faults += [
        f"{section}.{name} must be a table, not {shown(wrong[name])}; head it [{section}.{name}]"
        for name in wrong
    ]
    return {name: table for name, table in entries if name not in wrong}


def unit_faults(values: Values, parameters: Declarations) -> dict[str, str]:
    """Return the parameters whose unit fits nowhere, with a sentence for each."""
    asked: dict[str, dict[str, str]] = {}
    for use in values.uses:
        if isinstance(use.value, Parameter):
            asked.setdefault(use.value.name, {}).setdefault(use.domain.dimension, use.owner)
    found = {}
    for name, places in asked.items():
        if name not in parameters or name in parameters.doubtful or len(places) > 1:
            continue
        ((dimension, owner),) = places.items()
        unit = parameters[name].unit
        if dimension_of(unit) != dimension:
            found[name] = f"parameters.{name} {_misfit(unit, dimension, owner)}"
    return found


def _misfit(unit: str, dimension: str, owner: str) -> str:
    asked = with_article(dimension) if dimension else "a pure number"
    usual = USUAL_UNITS[dimension]
    if not unit:
        return (
            f'is used where {asked} is asked for; add unit = "{usual}" or another, and write '
            f'its values as in "1 {usual}"'
        )
    return f"is in {unit}, but {owner} takes {asked}; change its unit or where it is used"
