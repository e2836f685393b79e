"""Reader: a preset file as a path: parameters, elements, links and cases."""

from __future__ import annotations

import re
from itertools import chain
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.path_values import Values
from optipath.composer.validate import partial_faults, validate
from optipath.composer.wiring import LOOPS
from optipath.elements.coupling import KINDS
from optipath.elements.known_elements import element_class
from optipath.elements.own_element import is_own
from optipath.errors import (
    Fault,
    OptipathError,
    PathError,
    PresetError,
    did_you_mean,
    shown,
    unknown,
)
from optipath.kernels.kernel import called
from optipath.light.frame import Frame
from optipath.materials.quantities import ANGLE
from optipath.paths.files import schema
from optipath.paths.files.schema import FORMAT, Faults, joined, texts_in
from optipath.paths.files.toml import parsed
from optipath.paths.files.values import (
    decode,
    decode_argument,
    references_in,
    wavelength_names,
    which_pair,
)
from optipath.paths.files.writer import as_toml, complex_domains
from optipath.paths.joining import find_port
from optipath.paths.path_graph import PathGraph
from optipath.paths.place_choice import PlaceChoice, choice_faults
from optipath.values.cases import Case, name_faults
from optipath.values.domains import Choice, Domain, pair_in
from optipath.values.messages import units_are_written
from optipath.values.parameters import Parameter, checked_name
from optipath.values.units import (
    UNITS,
    USUAL_UNITS,
    dimension_of,
    unit_meant,
    units_of,
    with_article,
)
from optipath.values.use import checked_later
from optipath.values.wavelength import WAVELENGTH, Wavelength, falls_with_wavelength

if TYPE_CHECKING:
    from collections.abc import Collection, Container, Iterable, Mapping, Sequence

    from optipath.elements.element import Element
    from optipath.values.use import Use

    Table: TypeAlias = dict[str, Any]
    Parameters: TypeAlias = dict[str, Parameter]


def path_of_text(text: str, source: str, about: str = "") -> PathGraph:
    """Return the path that a text describes, as `PathGraph.to_toml` writes it."""
    document = parsed(text, source)
    number = document.get("format", FORMAT)
    if number != FORMAT or isinstance(number, bool):
        raise PresetError(
            f"'{source}' has format {shown(number)}, but this version reads format {FORMAT}"
        )
    try:
        with units_are_written():
            return read(document)
    except OptipathError as error:
        raise PathError(*error.within("file"), about=about or source) from None


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
    missing = _elements(path, document, parameters, faults)
    suspects = missing | _links(path, document, parameters, missing, faults)
    misplaced = Faults()
    for name, table in tables_of(document, "choices", faults).items():
        _offer(path, name, table, missing, faults, misplaced)
    values = Values(path.graph)
    unfit = unit_faults(values, parameters)
    faults += unfit.values()
    pairs = _pair_faults(path, document)
    faults += chain(*pairs.values())
    doubtful = {*parameters.doubtful, *unfit, *pairs, STAND_IN.name}
    known = {**values.parameters, **parameters}
    _cases(path, document, known, doubtful, values.uses, missing, faults)
    if len(faults) == before:
        faults += [
            f"parameter '{name}' is declared, but no element takes it"
            for name in parameters
            if name not in references and name not in values.parameters
        ]
    if faults:
        whole = bool(path.graph) and not missing
        partial = partial_faults(path.graph, suspects, doubtful, whole=whole)
        raise PathError(*joined([*faults, *partial]))
    validate(path.graph, values)
    if misplaced:
        raise PathError(*joined(misplaced))
    return path


def _pair_faults(path: PathGraph, document: Table) -> dict[str, list[str]]:
    """Ask what pairs mean that are given for parameters of complex numbers, by their names."""
    results: dict[str, list[str]] = {}
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
                results.setdefault(name, []).append(Fault(which, place=f"{where}.{key}"))
    return results


def _elements(
    path: PathGraph, document: Table, parameters: Declarations, faults: Faults
) -> set[str]:
    """Add the elements; return the names of those that could not be added."""
    tables = document.get("elements", {})
    if tables == {}:
        faults.append("the preset has no elements; add a table [elements.NAME] for each")
    if not isinstance(tables, dict):
        return set()
    missing = set()
    for name, table in tables.items():
        if not _add(path, name, table, parameters, faults):
            missing.add(name)
        faults.refuse_many()
    # Links to a name that has a dot name but its first part.
    return missing | {name.partition(".")[0] for name in missing}


def _links(
    path: PathGraph, document: Table, parameters: Declarations, missing: set[str], faults: Faults
) -> set[str]:
    """Add the links; return the nodes of which some may be missing."""
    links = document.get("links", [])
    if not isinstance(links, list):
        return set(path.graph)
    suspects = set()
    for number, table in enumerate(links):
        suspects |= _link(path, f"links[{number}]", table, parameters, missing, faults)
        faults.refuse_many()
    return suspects


def _cases(
    path: PathGraph,
    document: Table,
    parameters: Parameters,
    doubtful: set[str],
    uses: Sequence[Use],
    missing: set[str],
    faults: Faults,
) -> None:
    ends = {name for name, e in path.graph.nodes(data="element") if not e.outputs}
    for name, table in tables_of(document, "cases", faults).items():
        faults.refuse_many()
        faults += name_faults(name)
        path.cases[name] = read_case(f"cases.{name}", table, parameters, doubtful, uses, faults)
        for detector in path.cases[name].published:
            if detector not in ends and detector not in missing and path.graph:
                cure = did_you_mean(detector, ends)
                faults.add(f"cases.{name}.published", f"'{detector}' is no detector{cure}")


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
    path: PathGraph, name: str, table: Table, missing: set[str], faults: Faults, misplaced: Faults
) -> None:
    """Offer a choice; what is wrong with its places is told where the links have no fault."""
    where = f"choices.{name}"
    wrong = schema.type_faults(where, table, schema.CHOICE)
    for key in ("element", "behind"):
        if key not in table:
            wrong.add(where, f"'{key}' is missing")
    behind = table.get("behind")
    if isinstance(behind, dict) and not _are_ports(behind):
        wrong.add(
            where,
            f"'behind' must name a port for each word, such as behind = "
            f'{{ light = "L.out" }}, not {as_toml(behind)}',
        )
    faults += wrong
    if wrong or missing or not path.graph:
        return
    about = table["element"], table["behind"], table.get("help", "")
    choice = faults.attempt(where, PlaceChoice, *about)
    if choice is None:
        return
    unknown_names = choice_faults(path.graph, choice, linked=False)
    faults += [Fault.of(each).under(where) for each in unknown_names]
    if not unknown_names:
        misplaced.attempt(where, path.offer, name, *about)


def _are_ports(behind: Table) -> bool:
    """Tell whether there are words, and a text for each."""
    words = [text.strip() for text in behind if isinstance(behind[text], str)]
    return bool(behind) and len(words) == len(behind) and all(words)


def _link(
    path: PathGraph,
    where: str,
    table: Any,
    parameters: Parameters,
    absent: set[str],
    faults: Faults,
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
    missing = [key for key in ends if key not in table]
    for key in missing:
        faults.add(where, f"'{key}' is missing")
    if missing:
        return set(path.graph)
    azimuth = None
    if "azimuth" in table:
        azimuth = faults.attempt(f"{where}.azimuth", decode, table["azimuth"], ANGLE, parameters)
    known = [key for key, name in ends.items() if name not in absent]
    wrong, graph = Faults(), path.graph
    results = [
        wrong.attempt(where, find_port, graph, table[key], out=key == "from") for key in known
    ]
    if wrong and _is_reversed(path, table):
        wrong = Faults([f"{where} leads from an in-port to an out-port; swap 'from' and 'to'"])
    faults += wrong
    if len(known) == 2 and None not in results:
        before = len(faults)
        tap = table.get("tap", False)
        faults.attempt(where, path.connect, table["from"], table["to"], azimuth, tap=tap)
        return set() if len(faults) == before else set(ends.values())
    # A node that does not exist may be any of those that do.
    return set(ends.values()) if set(ends.values()) <= {*path.graph, *absent} else set(path.graph)


def _is_reversed(path: PathGraph, table: Table) -> bool:
    """Tell whether a link that is wrong would do if it were written the other way round."""
    swapped = Faults()
    swapped.attempt("from", find_port, path.graph, table["to"], out=True)
    swapped.attempt("to", find_port, path.graph, table["from"], out=False)
    return not swapped


class Declarations(dict[str, Parameter]):
    """Parameters by name, bare ones in place of those that are faulty."""

    def __init__(self) -> None:
        super().__init__()
        self.doubtful: set[str] = set()


def read_declarations(
    document: dict[str, Any], references: Collection[str], faults: Faults
) -> Declarations:
    """Return the parameters that a document declares."""
    result, tables = Declarations(), document.get("parameters", {})
    readable = tables_of(document, "parameters", faults)
    wavelengths = wavelength_names(document.get("elements"))
    # Without the tables, nobody knows what they have declared.
    for name in tables if isinstance(tables, dict) else references:
        table = readable.get(name)
        parameter = None if table is None else read_parameter(name, table, wavelengths, faults)
        if parameter is None:
            result.doubtful.add(name)
            parameter = Parameter(name if name.isidentifier() else "unknown")
        result[name] = parameter
    result.doubtful.update(name for name in references if name not in result)
    return result


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
    requests: dict[str, dict[str, str]] = {}
    for use in values.uses:
        if isinstance(use.value, Parameter):
            requests.setdefault(use.value.name, {}).setdefault(use.domain.dimension, use.owner)
    results = {}
    for name, places in requests.items():
        if name not in parameters or name in parameters.doubtful or len(places) > 1:
            continue
        ((dimension, owner),) = places.items()
        unit = parameters[name].unit
        if dimension_of(unit) != dimension:
            results[name] = f"parameters.{name} {_misfit(unit, dimension, owner)}"
    return results


def _misfit(unit: str, dimension: str, owner: str) -> str:
    request = with_article(dimension) if dimension else "a pure number"
    usual = USUAL_UNITS[dimension]
    if not unit:
        return (
            f'is used where {request} is asked for; add unit = "{usual}" or another, and write '
            f'its values as in "1 {usual}"'
        )
    return f"is in {unit}, but {owner} takes {request}; change its unit or where it is used"


_WITH_UNIT = re.compile(rf"[-+.\d][-+.\deE]*\s*({'|'.join(map(re.escape, UNITS))})", re.ASCII)


def read_parameter(
    name: str, table: dict[str, Any], wavelengths: Container[str], faults: Faults
) -> Parameter | None:
    """Return the parameter that a table declares; None where the table is faulty."""
    where, before = f"parameters.{name}", len(faults)
    sound = schema.checked(where, table, schema.PARAMETER, faults)
    named = faults.attempt(where, checked_name, name) is not None
    if sound is None:
        return None
    usual = WAVELENGTH.unit if name in wavelengths else ""
    table, unit = sound, sound.get("unit", usual)
    fault = _unit_fault(where, unit, table)
    if usual and falls_with_wavelength(f"1 {unit}"):
        fault = _no_length(where, unit)
    if fault:
        faults.append(fault)
        return None
    dimension = faults.attempt(where, dimension_of, unit)
    if dimension is None or not named:
        return None
    of_light = name in wavelengths and dimension == "length"
    domain = WAVELENGTH if of_light else Domain("value", dimension, own_unit=unit)
    words = {
        word: faults.attempt(f"{where}.words.{word}", decode, raw, domain, {})
        for word, raw in table.get("words", {}).items()
    }
    keys: dict[str, Any] = {key: table[key] for key in ("help", "optional") if key in table}
    keys |= {"unit": unit, "words": {word: n for word, n in words.items() if n is not None}}
    keys |= _range(where, table, domain, faults)
    kind = Wavelength if of_light else Parameter
    keys.setdefault("help", "")
    default, bare = None, faults.attempt(where, kind, name, None, **keys)
    argument = table.get("default")
    waits = isinstance(argument, str) and argument in words and words[argument] is None
    if argument is not None and bare is not None and not waits:
        default = faults.attempt(f"{where}.default", decode_argument, argument, bare)
    if len(faults) > before:
        return None
    bound = table.get("bound", False)
    return faults.attempt(where, kind, name, default, bound=bound, **keys)


def _range(where: str, table: Mapping[str, Any], domain: Domain, faults: Faults) -> dict[str, Any]:
    """Return the limits of a parameter; none where they are faulty."""
    if "range" not in table:
        return {}
    if len(table["range"]) != 2:
        faults.add(where, f"'range' must have two ends, not {len(table['range'])}")
        return {}
    read = _ends_of_light if domain is WAVELENGTH else decode
    ends = faults.attempt(f"{where}.range", read, table["range"], domain, {})
    if ends is None:
        return {}
    if any(isinstance(end, list) for end in ends):
        faults.add(where, "the ends of 'range' must be single values")
        return {}
    return dict(zip(("minimum", "maximum"), ends, strict=True))


def _ends_of_light(raw: list[Any], domain: Domain, parameters: Mapping[str, Parameter]) -> Any:
    """Return the two limits of a wavelength, the lower one first where photon energies rise."""
    ends = [decode(end, domain, parameters) for end in raw]
    return sorted(ends) if all(map(falls_with_wavelength, raw)) else ends


def _no_length(where: str, unit: str) -> str:
    """Say that a unit of photon energy or the like is for texts alone, where a wavelength is."""
    return (
        f"{where}: unit '{unit}' is none of length, in which wavelengths are told; leave unit out, "
        f'and write values as texts with it, such as "2.4 {unit}"'
    )


def _unit_fault(where: str, unit: str, table: Mapping[str, Any]) -> str:
    """Say that no value has the dimension of the unit, if so: it is the unit that is wrong."""
    argument = texts_in([table.get(key) for key in ("default", "range", "words")])
    units = {text: match[1] for text in argument if (match := _WITH_UNIT.fullmatch(text.strip()))}
    dimensions = [UNITS[name].dimension for name in units.values()]
    if not units or (unit in UNITS and dimension_of(unit) in dimensions):
        return ""
    text, result = next(iter(units.items()))
    if unit and unit not in UNITS:
        return f"{where}: unit '{unit}' is unknown{unit_meant(unit, units_of(dimensions[0]))}"
    if not unit:
        cure = f'add unit = "{result}", or give pure numbers if it is one'
        return f"{where} declares no unit, but its values have one; {cure}"
    dimension = with_article(dimension_of(result))
    return f"{where} is in {unit}, but '{text}' is {dimension}; let them agree"


STAND_IN = Parameter("unknown")
"""Takes the place of a value that is missing or faulty, so that the rest is checked too."""


@checked_later()  # With the whole path, by the names of its nodes.
def read_element(
    where: str, table: dict[str, Any], parameters: Mapping[str, Parameter], faults: Faults
) -> Element | None:
    """Return the element that a table describes; None where its kind is not known."""
    named = table if "kind" in table else schema.as_meant(_no_fields(table), ["kind"])
    kind = named.get("kind")
    if not isinstance(kind, str):
        what = f"'kind' must be a text, not {shown(kind)}" if "kind" in named else "kind is missing"
        faults.add(where, f'{what}; write kind = "..."')
        return None
    result = faults.attempt(where, element_class, kind)
    if result is None:
        return None
    domains = result.domains()
    known = ["kind", "frames", *domains]
    if wrong := schema.unknown_keys(table, known, where):
        faults += wrong
        table = schema.as_meant(table, known)
    values: dict[str, Any] = {}
    for name, domain in domains.items():
        if name in table:
            value = faults.attempt(f"{where}.{name}", decode, table[name], domain, parameters)
            if value is not None:
                values[name] = value
            elif not isinstance(domain, Choice):
                values[name] = STAND_IN
        elif result.needs(name):
            faults.add(where, f"'{name}' is missing; every {kind} needs one")
            values[name] = STAND_IN
    what = f"element class {result.__name__}"
    # What code of a user's own says of a stand-in is no news.
    unknown = is_own(result) and any(value is STAND_IN for value in values.values())
    message = Faults() if unknown else faults
    return message.attempt(where, lambda: called(what, lambda: result(**values)))


def _no_fields(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is in a table that no element has a field for, as it has for ``index``."""
    fields = {name for result in KINDS.values() for name in result.domains()}
    return {key: value for key, value in table.items() if key not in fields}


def read_frames(where: str, table: Any, faults: Faults) -> dict[str, Frame]:
    """Return the world frames of an element's ports."""
    if not isinstance(table, dict) or not all(isinstance(axes, dict) for axes in table.values()):
        faults.append(f"{where}.frames must be tables with x, y and z, one for each port")
        return {}
    frames = {}
    for port, axes in table.items():
        at = f"{where}.frames.{port}"
        wrong = schema.unknown_keys(axes, ("x", "y", "z", "rounding"), at)
        wrong += [f"{at}: axis '{axis}' is missing" for axis in "xyz" if axis not in axes]
        faults += wrong
        frame = None if wrong else faults.attempt(at, Frame, **axes)
        if frame is not None:
            frames[port] = frame
    return frames


_LARGEST = 1e308


def read_case(
    where: str,
    table: dict[str, Any],
    parameters: Mapping[str, Parameter],
    doubtful: Collection[str],
    uses: Iterable[Use],
    faults: Faults,
) -> Case:
    """Return the case that a table describes, without what is faulty in it."""
    if loose := [name for name in table if name in parameters and name not in schema.CASE]:
        faults.append(
            f"{where}: the values of parameters stand in a table of their own; write values = "
            f"{{ {loose[0]} = ... }}"
        )
        table = {name: value for name, value in table.items() if name not in loose}
    sound = schema.checked(where, table, schema.CASE, faults)
    if sound is None:
        return Case({})
    table = sound
    values = {}
    for name, raw in table.get("values", {}).items():
        if name in doubtful:
            continue
        if name not in parameters:
            cure = did_you_mean(name, parameters)
            faults.add(where, f"parameter '{name}' is unknown{cure}")
            continue
        parameter = parameters[name]
        value = faults.attempt(f"{where}.{name}", decode_argument, raw, parameter, uses)
        if value is not None:
            faults.attempt(f"{where}.{name}", parameter.resolve, value)
            values[name] = value
    published = {}
    for name, stokes in table.get("published", {}).items():
        if _is_stokes(stokes):
            published[name] = tuple(map(float, stokes))
        else:
            at = f"{where}.published.{name}"
            faults.append(f"{at} must be four finite numbers, not {shown(stokes)}")
    return Case(values, published, table.get("note", ""))


def _is_stokes(stokes: Any) -> bool:
    if not isinstance(stokes, list) or len(stokes) != 4:
        return False
    return all(type(part) in (int, float) and abs(part) < _LARGEST for part in stokes)
