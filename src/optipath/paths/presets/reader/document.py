"""Reading a whole document, in the order parameters, elements, links, cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.validate import partial_faults
from optipath.composer.wiring import LOOPS
from optipath.errors import PathError, did_you_mean, shown, unknown
from optipath.paths.format import schema
from optipath.paths.format.codec import decode
from optipath.paths.format.faults import Faults
from optipath.paths.path_graph import PathGraph
from optipath.paths.port_names import find_port
from optipath.paths.presets.reader.case_tables import read_case
from optipath.paths.presets.reader.element_tables import read_element, read_frames
from optipath.paths.presets.reader.parameter_tables import read_parameter
from optipath.values.domains.quantities import ANGLE
from optipath.values.units import dimension_of, with_article

if TYPE_CHECKING:
    from optipath.values.parameters import Parameter

    Table: TypeAlias = dict[str, Any]
    Parameters: TypeAlias = dict[str, Parameter]


def read(document: Table) -> PathGraph:
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
    loops = document.get("loops", LOOPS[0])
    if isinstance(loops, str):
        faults += unknown("the preset: loops", loops, LOOPS)
    loops = loops if loops in LOOPS else LOOPS[-1]
    path = PathGraph(description, declared=tuple(parameters), loops=loops)
    elements = _tables(document, "elements", faults)
    lost = {
        name for name, table in elements.items() if not _add(path, name, table, parameters, faults)
    }
    links = document.get("links", [])
    suspects = set(lost)
    for number, table in enumerate(links if isinstance(links, list) else []):
        suspects |= _link(path, f"links[{number}]", table, parameters, lost, faults)
    ends = {name for name, e in path.graph.nodes(data="element") if not e.outputs}
    for name, table in _tables(document, "cases", faults).items():
        path.cases[name] = read_case(f"cases.{name}", table, parameters, faults)
        for detector in path.cases[name].published:
            if detector not in ends and detector not in lost:
                cure = did_you_mean(detector, ends)
                faults.append(f"cases.{name}.published: '{detector}' is no detector{cure}")
    used = path.parameters
    if not suspects:
        faults += [
            f"parameter '{name}' is declared, but no element takes it"
            for name in parameters
            if name not in used
        ]
    faults += [
        f"parameters.{name} is used where {with_article(dimension_of(parameter.unit))} is "
        f'asked for; add unit = "{parameter.unit}" or another'
        for name, parameter in used.items()
        if name in parameters and parameter.unit != parameters[name].unit
    ]
    if faults:
        partial = partial_faults(path.graph, suspects, whole=not lost)
        raise PathError(*dict.fromkeys([*faults, *partial]))
    path.check()
    return path


def _tables(document: Table, section: str, faults: Faults) -> dict[str, Table]:
    tables = document.get(section, {})
    entries = tables.items() if isinstance(tables, dict) else ()
    wrong = {name: table for name, table in entries if not isinstance(table, dict)}
    faults += [f"{section}.{name} must be a table, not {shown(wrong[name])}" for name in wrong]
    return {name: table for name, table in entries if name not in wrong}


def _add(path: PathGraph, name: str, table: Table, parameters: Parameters, faults: Faults) -> bool:
    where = f"elements.{name}"
    element = read_element(where, table, parameters, faults)
    frames = read_frames(where, table.get("frames", {}), faults)
    if element is None:
        return False
    if faults.attempt(where, path.add, name, element, frames) is not None:
        return True
    # Without its frames, perhaps, so that the links to it are not called wrong as well.
    return bool(frames) and Faults().attempt(where, path.add, name, element) is not None


def _link(
    path: PathGraph, where: str, table: Any, parameters: Parameters, lost: set[str], faults: Faults
) -> set[str]:
    """Add a link; return the nodes whose links are not all there, if it could not be added."""
    if not isinstance(table, dict):
        faults.append(f"{where} must be a table headed [[links]], not {shown(table)}")
        return set(path.graph)
    ends = {key: str(table.get(key)).partition(".")[0] for key in ("from", "to")}
    before = len(faults)
    faults += schema.type_faults(where, table, schema.LINK)
    faults += [f"{where}: '{key}' is missing" for key in ends if key not in table]
    if len(faults) > before:
        return set(path.graph)
    azimuth = None
    if "azimuth" in table:
        azimuth = faults.attempt(where, decode, table["azimuth"], ANGLE, parameters)
    known = [key for key, name in ends.items() if name not in lost]
    found = [
        faults.attempt(where, find_port, path.graph, table[key], out=key == "from") for key in known
    ]
    if len(known) == 2 and None not in found:
        before = len(faults)
        faults.attempt(where, path.connect, table["from"], table["to"], azimuth)
        return set() if len(faults) == before else set(ends.values())
    # A node that does not exist may be any of those that do.
    return set(ends.values()) if set(ends.values()) <= {*path.graph, *lost} else set(path.graph)
