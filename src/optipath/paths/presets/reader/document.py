"""Reading a whole document, in the order parameters, elements, links, cases."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.path_values import Values
from optipath.composer.validate import partial_faults, validate
from optipath.composer.wiring import LOOPS
from optipath.errors import PathError, did_you_mean, shown, unknown
from optipath.paths.format import schema
from optipath.paths.format.codec import decode, which_pair
from optipath.paths.format.faults import Faults, joined
from optipath.paths.format.references import references_in
from optipath.paths.format.writer import as_toml, complex_domains
from optipath.paths.path_graph import PathGraph
from optipath.paths.place_choice import PlaceChoice, choice_faults
from optipath.paths.port_names import find_port
from optipath.paths.presets.reader.case_tables import read_case
from optipath.paths.presets.reader.declarations import (
    read_declarations,
    tables_of,
    unit_faults,
)
from optipath.paths.presets.reader.element_tables import STAND_IN, read_element, read_frames
from optipath.values.cases import name_faults
from optipath.values.domains.pair import pair_in
from optipath.values.domains.quantities import ANGLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.paths.presets.reader.declarations import Declarations
    from optipath.values.parameters import Parameter
    from optipath.values.use import Use

    Table: TypeAlias = dict[str, Any]
    Parameters: TypeAlias = dict[str, Parameter]


_MOST_ENTRIES = 3000
"""How many elements, links, ... a file may have, so that it is loaded and run within 2 s."""


def read(document: Table) -> PathGraph:
    """Return the path that a parsed TOML document describes."""
    for key, table in document.items():
        if isinstance(table, (dict, list)) and len(table) > _MOST_ENTRIES:
            raise PathError(f"it has {len(table):,} {key}; give {_MOST_ENTRIES:,} at most")
    faults = Faults(schema.type_faults("the preset", document, schema.TOP))
    if faults:
        document = schema.as_meant(document, schema.TOP)
    if "format" not in document:
        faults.append(f"the preset: 'format' is missing; add format = {schema.FORMAT}")
    references = references_in([document.get("elements"), document.get("links")])
    parameters = read_declarations(document, references, faults)
    description = str(document.get("description", ""))
    loops = document.get("loops", LOOPS[0])
    if isinstance(loops, str):
        faults += unknown("the preset: loops", loops, LOOPS)
    loops = loops if loops in LOOPS else LOOPS[-1]
    path = PathGraph(description, declared=tuple(parameters), loops=loops)
    before = len(faults)
    lost = _elements(path, document, parameters, faults)
    suspects = lost | _links(path, document, parameters, lost, faults)
    misplaced = Faults()
    for name, table in tables_of(document, "choices", faults).items():
        _offer(path, name, table, lost, faults, misplaced)
    values = Values(path.graph)
    unfit = unit_faults(values, parameters)
    faults += unfit.values()
    pairs = _pair_faults(path, document)
    faults += chain(*pairs.values())
    doubtful = {*parameters.doubtful, *unfit, *pairs, STAND_IN.name}
    known = {**values.parameters, **parameters}
    _cases(path, document, known, doubtful, values.uses, lost, faults)
    if len(faults) == before:
        faults += [
            f"parameter '{name}' is declared, but no element takes it"
            for name in parameters
            if name not in references and name not in values.parameters
        ]
    if faults:
        whole = bool(path.graph) and not lost
        partial = partial_faults(path.graph, suspects, doubtful, whole=whole)
        raise PathError(*joined([*faults, *partial]))
    validate(path.graph, values)
    if misplaced:
        raise PathError(*joined(misplaced))
    return path


def _pair_faults(path: PathGraph, document: Table) -> dict[str, list[str]]:
    """Ask what pairs mean that are given for parameters of complex numbers, by their names."""
    found: dict[str, list[str]] = {}
    declared = document.get("parameters", {})
    for name, domain in complex_domains(path.graph).items():
        tables = [(f"parameters.{name}", "default", declared.get(name))]
        for case, table in document.get("cases", {}).items():
            values = table.get("values") if isinstance(table, dict) else None
            tables.append((f"cases.{case}.values", name, values))
        for where, key, table in tables:
            raw: Any = table.get(key) if isinstance(table, dict) else None
            if pair_in(raw, domain):
                which = which_pair(raw, domain.complex_parts)
                found.setdefault(name, []).append(f"{where}.{key}: {which}")
    return found


def _elements(
    path: PathGraph, document: Table, parameters: Declarations, faults: Faults
) -> set[str]:
    """Add the elements; return the names of those that could not be added."""
    tables = document.get("elements", {})
    if tables == {}:
        faults.append("the preset has no elements; add a table [elements.NAME] for each")
    if not isinstance(tables, dict):
        return set()
    lost = {
        name for name, table in tables.items() if not _add(path, name, table, parameters, faults)
    }
    # Links to a name that has a dot name but its first part.
    return lost | {name.partition(".")[0] for name in lost}


def _links(
    path: PathGraph, document: Table, parameters: Declarations, lost: set[str], faults: Faults
) -> set[str]:
    """Add the links; return the nodes of which some may be missing."""
    links = document.get("links", [])
    if not isinstance(links, list):
        return set(path.graph)
    suspects = set()
    for number, table in enumerate(links):
        suspects |= _link(path, f"links[{number}]", table, parameters, lost, faults)
    return suspects


def _cases(
    path: PathGraph,
    document: Table,
    parameters: Parameters,
    doubtful: set[str],
    uses: Sequence[Use],
    lost: set[str],
    faults: Faults,
) -> None:
    ends = {name for name, e in path.graph.nodes(data="element") if not e.outputs}
    for name, table in tables_of(document, "cases", faults).items():
        faults += name_faults(name)
        path.cases[name] = read_case(f"cases.{name}", table, parameters, doubtful, uses, faults)
        for detector in path.cases[name].published:
            if detector not in ends and detector not in lost and path.graph:
                cure = did_you_mean(detector, ends)
                faults.append(f"cases.{name}.published: '{detector}' is no detector{cure}")


def _add(path: PathGraph, name: str, table: Any, parameters: Parameters, faults: Faults) -> bool:
    where = f"elements.{name}"
    if not isinstance(table, dict):
        faults.append(f"{where} must be a table, not {shown(table)}")
        return False
    element = read_element(where, table, parameters, faults)
    frames = read_frames(where, table.get("frames", {}), faults)
    if element is None:
        return False
    if faults.attempt(where, path.add, name, element, frames) is not None:
        return True
    # Without its frames, perhaps, so that the links to it are not called wrong as well.
    return bool(frames) and Faults().attempt(where, path.add, name, element) is not None


def _offer(
    path: PathGraph, name: str, table: Table, lost: set[str], faults: Faults, misplaced: Faults
) -> None:
    """Offer a choice; what is wrong with its places is told where the links have no fault."""
    where = f"choices.{name}"
    wrong = schema.type_faults(where, table, schema.CHOICE)
    wrong += [f"{where}: '{k}' is missing" for k in ("element", "behind") if k not in table]
    behind = table.get("behind")
    if isinstance(behind, dict) and not _are_ports(behind):
        wrong.append(
            f"{where}: 'behind' must name a port for each word, such as behind = "
            f'{{ light = "L.out" }}, not {as_toml(behind)}'
        )
    faults += wrong
    if wrong or lost or not path.graph:
        return
    about = table["element"], table["behind"], table.get("help", "")
    choice = faults.attempt(where, PlaceChoice, *about)
    if choice is None:
        return
    unknown_names = choice_faults(path.graph, choice, linked=False)
    faults += [f"{where}: {fault}" for fault in unknown_names]
    if not unknown_names:
        misplaced.attempt(where, path.offer, name, *about)


def _are_ports(behind: Table) -> bool:
    """Tell whether there are words, and a text for each."""
    words = [text.strip() for text in behind if isinstance(behind[text], str)]
    return bool(behind) and len(words) == len(behind) and all(words)


def _link(
    path: PathGraph, where: str, table: Any, parameters: Parameters, lost: set[str], faults: Faults
) -> set[str]:
    """Add a link; return the nodes whose links are not all there, if it could not be added."""
    if not isinstance(table, dict):
        faults.append(f"{where} must be a table headed [[links]], not {shown(table)}")
        return set(path.graph)
    sound = schema.checked(where, table, schema.LINK, faults)
    if sound is None:
        return set(path.graph)
    table = sound
    ends = {key: str(table.get(key)).partition(".")[0] for key in ("from", "to")}
    missing = [f"{where}: '{key}' is missing" for key in ends if key not in table]
    if missing:
        faults += missing
        return set(path.graph)
    azimuth = None
    if "azimuth" in table:
        azimuth = faults.attempt(f"{where}.azimuth", decode, table["azimuth"], ANGLE, parameters)
    known = [key for key, name in ends.items() if name not in lost]
    wrong, graph = Faults(), path.graph
    found = [wrong.attempt(where, find_port, graph, table[key], out=key == "from") for key in known]
    if wrong and _is_reversed(path, table):
        wrong = Faults([f"{where} leads from an in-port to an out-port; swap 'from' and 'to'"])
    faults += wrong
    if len(known) == 2 and None not in found:
        before = len(faults)
        tap = table.get("tap", False)
        faults.attempt(where, path.connect, table["from"], table["to"], azimuth, tap=tap)
        return set() if len(faults) == before else set(ends.values())
    # A node that does not exist may be any of those that do.
    return set(ends.values()) if set(ends.values()) <= {*path.graph, *lost} else set(path.graph)


def _is_reversed(path: PathGraph, table: Table) -> bool:
    """Tell whether a link that is wrong would do if it were written the other way round."""
    swapped = Faults()
    swapped.attempt("from", find_port, path.graph, table["to"], out=True)
    swapped.attempt("to", find_port, path.graph, table["from"], out=False)
    return not swapped
