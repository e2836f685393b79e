"""Reading a whole document, in the order parameters, elements, links, cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.composer import structure_faults, value_faults
from optipath.domains import Domain
from optipath.errors import PathError, did_you_mean
from optipath.path_graph import PathGraph
from optipath.preset_format import decode, schema
from optipath.preset_reader.cases import read_case
from optipath.preset_reader.elements import read_element, read_frames
from optipath.preset_reader.faults import Faults
from optipath.preset_reader.parameters import read_parameter

if TYPE_CHECKING:
    from optipath.parameters import Parameter

_AZIMUTH = Domain("azimuth", "angle")


def read(document: dict[str, Any]) -> PathGraph:
    """Return the path that a parsed TOML document describes.

    Raises
    ------
    PathError
        With every fault: keys, kinds, units, values, ports, links, and the path itself.
    """
    faults = Faults(schema.type_faults("the preset", document, schema.TOP))
    if "format" not in document:
        faults.append(f"the preset: 'format' is missing; add format = {schema.FORMAT}")
    parameters = {
        name: read_parameter(name, table, faults)
        for name, table in _tables(document, "parameters", faults).items()
    }
    description = str(document.get("description", ""))
    path = PathGraph(description, declared=tuple(parameters))
    elements = _tables(document, "elements", faults)
    added = [_add(path, name, table, parameters, faults) for name, table in elements.items()]
    links = document.get("links", [])
    linked = [
        _link(path, f"links[{number}]", table, parameters, faults)
        for number, table in enumerate(links if isinstance(links, list) else [])
    ]
    for name, table in _tables(document, "cases", faults).items():
        path.cases[name] = read_case(f"cases.{name}", table, parameters, faults)
        for detector in path.cases[name].published:
            if detector not in path.graph:
                cure = did_you_mean(detector, path.graph)
                faults.append(f"cases.{name}.published: node '{detector}' does not exist{cure}")
    if all(added) and all(linked):
        for name in parameters.keys() - path.parameters.keys():
            faults.append(f"parameter '{name}' is declared, but no element takes it")
    if not faults:
        path.check()
        return path
    faults += value_faults(path.graph)
    if all(added) and all(linked):
        # Only with every node and link in place does their structure say something.
        faults += structure_faults(path.graph)
    raise PathError(*dict.fromkeys(faults))


def _tables(document: dict[str, Any], section: str, faults: Faults) -> dict[str, dict[str, Any]]:
    tables = document.get(section, {})
    found = {}
    for name, table in tables.items() if isinstance(tables, dict) else ():
        if isinstance(table, dict):
            found[name] = table
        else:
            faults.append(f"{section}.{name} must be a table, not {table!r}")
    return found


def _add(
    path: PathGraph,
    name: str,
    table: dict[str, Any],
    parameters: dict[str, Parameter],
    faults: Faults,
) -> bool:
    where = f"elements.{name}"
    element = read_element(where, table, parameters, faults)
    frames = read_frames(where, table.get("frames", {}), faults)
    if element is None:
        return False
    return faults.attempt(where, path.add, name, element, frames) is not None


def _link(
    path: PathGraph, where: str, table: Any, parameters: dict[str, Parameter], faults: Faults
) -> bool:
    if not isinstance(table, dict):
        faults.append(f"{where} must be a table headed [[links]], not {table!r}")
        return False
    before = len(faults)
    faults += schema.type_faults(where, table, schema.LINK)
    faults += [f"{where}: '{key}' is missing" for key in ("from", "to") if key not in table]
    if len(faults) > before:
        return False
    azimuth = None
    if "azimuth" in table:
        azimuth = faults.attempt(where, decode, table["azimuth"], _AZIMUTH, parameters)
    before = len(faults)
    faults.attempt(where, path.connect, table["from"], table["to"], azimuth)
    return len(faults) == before
