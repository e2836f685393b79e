"""Reader: a preset file as a path: parameters, elements, links, choices and cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.composer import checked
from optipath.composer.plain_graph import LINK_VALUES
from optipath.composer.wiring import LOOPS
from optipath.elements.known_elements import element_class
from optipath.errors import OptipathError, PathError, PresetError
from optipath.faults import Fault, did_you_mean, shown
from optipath.kernels.kernel import called
from optipath.light.frame import Frame
from optipath.paths.files import schema
from optipath.paths.files.schema import FORMAT, Faults, checked_table, each_key, parsed
from optipath.paths.files.values import decode, decode_argument, text_or_number, wavelength_names
from optipath.paths.path_graph import PathGraph
from optipath.values.cases import Case, name_faults
from optipath.values.parameters import Parameter
from optipath.values.units import USUAL_UNITS, dimension_of, with_article
from optipath.values.use import checked_later
from optipath.values.wavelength import WAVELENGTH, Wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.composer.path_values import Values
    from optipath.elements.element import Element
    from optipath.values.use import Use

    Table: TypeAlias = dict[str, Any]


_ENOUGH = 100
"""After how many faults a file is not read on: each suggestion takes its time."""


def path_of_text(text: str, source: str, about: str = "") -> PathGraph:
    """Return the path that a text describes, as `PathGraph.to_toml` writes it."""
    document = parsed(text, source)
    number = document.get("format", FORMAT)
    if number != FORMAT or isinstance(number, bool):
        wrong = f"has format {shown(number)}, but this version reads format {FORMAT}"
        raise PresetError(f"'{source}' {wrong}")
    try:
        return read(document)
    except RecursionError:
        raise PresetError(f"'{source}' is too deeply nested") from None
    except OptipathError as error:
        raise PathError(*error.within("file"), about=about or source) from None


def read(document: Table) -> PathGraph:
    """Return the path that a parsed TOML document describes.

    Faults of parameters, elements and links are reported together, then those of units, of the
    whole path, of cases, and of choices.
    """
    faults = Faults(schema.type_faults("the preset", document, schema.TOP))
    if "format" not in document:
        faults.append(f"the preset: 'format' is missing; add format = {FORMAT}")
    sections = {name: document.get(name, {}) for name in ("parameters", "elements", "cases")}
    if sections["elements"] == {}:
        faults.append("the preset has no elements; add a table [elements.NAME] for each")
    faults.refuse()
    description, loops = document.get("description", ""), document.get("loops", LOOPS[0])
    path = PathGraph(description, declared=tuple(sections["parameters"]), loops=loops)
    parameters = _parameters(sections, faults)
    for name, table in sections["elements"].items():
        faults.attempt(f"elements.{name}", _add, path, name, table, parameters)
        faults.refuse(_ENOUGH)
    missing = sections["elements"].keys() - {*path}
    for number, table in enumerate(document.get("links", ())):
        ends = [table.get(key) for key in ("from", "to")] if isinstance(table, dict) else []
        if missing.isdisjoint([str(end).partition(".")[0] for end in ends]):
            faults.attempt(f"links[{number}]", _connect, path, table, parameters)
            faults.refuse(_ENOUGH)
    faults.refuse()
    values = path._values  # noqa: SLF001 - which stay with the path
    faults += _unit_faults(values, parameters)
    faults.refuse()
    checked(values)
    idle = [name for name in parameters if name not in values.parameters]
    faults += [f"parameter '{name}' is declared, but no element takes it" for name in idle]
    _read_cases(path, sections["cases"], {**values.parameters, **parameters}, values, faults)
    faults.refuse()
    for name, table in document.get("choices", {}).items():
        faults.attempt(f"choices.{name}", _offer, path, name, table)
    faults.refuse()
    return path


def _unit_faults(values: Values, parameters: Mapping[str, Parameter]) -> list[Fault]:
    """Return a fault for each parameter that stands where another unit belongs, or any."""
    faults: dict[str, Fault] = {}
    for use in values.parameter_uses:
        name, dimension = use.value.name, use.domain.dimension
        if name in parameters and dimension_of(unit := parameters[name].unit) != dimension:
            request = with_article(dimension) if dimension else "a pure number"
            usual = f'"{USUAL_UNITS[dimension]}" or another' if dimension else '""'
            faults[name] = Fault(
                f"parameter '{name}' is in {unit or 'no unit'}, but {use.owner} takes {request}",
                f"write unit = {usual}, and its values in it",
            )
    return [*faults.values()]


def _parameters(sections: Mapping[str, Table], faults: Faults) -> dict[str, Parameter]:
    """Return the parameters that are declared, by name; bare ones in place of faulty ones."""
    result = {}
    of_light = wavelength_names(sections["elements"])
    for name, table in sections["parameters"].items():
        parameter = faults.attempt(f"parameters.{name}", _parameter, name, table, name in of_light)
        if parameter is not None or name.isidentifier():
            result[name] = parameter or Parameter(name)
    return result


def _parameter(name: str, table: Any, of_light: bool) -> Parameter:  # noqa: FBT001
    """Return the parameter that a table declares, of the light's wavelength or of another."""
    checked_table(table, schema.PARAMETER)
    unit = table.get("unit", WAVELENGTH.unit if of_light else "")
    kind = Wavelength if of_light and dimension_of(unit) == "length" else Parameter
    faults = Faults()
    keys: Table = {"help": ""} | {k: table[k] for k in ("help", "optional", "bound") if k in table}
    keys["words"] = {
        word: faults.attempt(f".words.{word}", text_or_number, raw, unit)
        for word, raw in table.get("words", {}).items()
    }
    if "range" in table:
        if len(ends := table["range"]) != 2:
            faults.append(Fault(f"'range' must have two ends, not {len(ends)}", place=".range"))
        limits = faults.attempt(".range", lambda: [text_or_number(end, unit) for end in ends])
        keys |= zip(("minimum", "maximum"), limits or (), strict=False)
    default = table.get("default")
    if isinstance(default, (list, dict)):
        bare = kind(name, None, unit, **keys)
        default = faults.attempt(".default", decode_argument, default, bare)
    elif default is not None:
        default = faults.attempt(".default", text_or_number, default, unit)
    faults.refuse()
    result = kind(name, default, unit, **keys)
    if result.unit != unit:
        wrong = f"parameter '{name}' has values in {result.unit}, but no unit"
        raise PresetError(Fault(wrong, f'write unit = "{result.unit}"'))
    return result


def _add(path: PathGraph, name: str, table: Any, parameters: Mapping[str, Parameter]) -> None:
    path.add(name, *read_element(table, parameters))


@checked_later()  # With the whole path, by the names of its nodes.
def read_element(
    table: Any, parameters: Mapping[str, Parameter]
) -> tuple[Element, dict[str, Frame]]:
    """Return the element that a table describes, and the world frames of its ports."""
    kind = table.get("kind") if isinstance(table, dict) else None
    if not isinstance(kind, str):
        raise PresetError('its kind is missing; write kind = "..."')
    of_kind = element_class(kind)
    domains = of_kind.domains()
    known = {"kind": str, "frames": dict} | dict.fromkeys(domains, object)
    checked_table(table, known, of_kind.needed())
    given = {name: table[name] for name in domains if name in table}
    values = each_key(given, lambda name, raw: decode(raw, domains[name], parameters))
    frames = each_key(table.get("frames", {}), _frame, ".frames")
    return called(f"element class {of_kind.__name__}", lambda: of_kind(**values)), frames


def _frame(port: str, axes: Any) -> Frame:
    del port
    return Frame(**checked_table(axes, ("x", "y", "z", "rounding"), "xyz"))


def _connect(path: PathGraph, table: Any, parameters: Mapping[str, Parameter]) -> None:
    checked_table(table, schema.LINK, ("from", "to"))
    faults, keys = Faults(), {"tap": table.get("tap", False)}
    for name, domain in LINK_VALUES.items():
        if name in table:
            keys[name] = faults.attempt(f".{name}", decode, table[name], domain, parameters)
    faults.attempt("", path.connect, table["from"], table["to"], **keys)
    faults.refuse()


def _offer(path: PathGraph, name: str, table: Any) -> None:
    checked_table(table, schema.CHOICE, ("element", "behind"))
    path.offer(name, table["element"], table["behind"], table.get("help", ""))


def _read_cases(
    path: PathGraph, tables: Table, known: Mapping[str, Parameter], values: Values, faults: Faults
) -> None:
    """Add the cases that tables describe; what several of them give is decoded once."""
    ends = [name for name in path if not path.element(name).outputs]
    decoded: dict[tuple[str, str], Any] = {}
    for case, table in tables.items():
        faults += name_faults(case)
        place, before = f"cases.{case}", len(faults)
        if faults.attempt(place, checked_table, table, schema.CASE) is None:
            continue
        arguments = table.get("values", {})
        for name, raw in arguments.items():
            if name not in known:
                unknown = f"parameter '{name}' is unknown{did_you_mean(name, known)}"
                faults.append(Fault(unknown, place=place))
            elif (name, repr(raw)) not in decoded:
                at, uses = f"{place}.{name}", values.parameter_uses
                read = faults.attempt(at, _argument, raw, known[name], uses)
                decoded[name, repr(raw)] = read
        published = table.get("published", {})
        for name, stokes in published.items():
            if name not in ends:
                wrong = f"'{name}' is no detector{did_you_mean(name, ends)}"
                faults.append(Fault(wrong, place=f"{place}.published"))
            elif not _is_stokes(stokes):
                wrong = f"{shown(stokes)} must be four finite numbers"
                faults.append(Fault(wrong, place=f"{place}.published.{name}"))
        if len(faults) == before:
            given = {name: decoded[name, repr(raw)] for name, raw in arguments.items()}
            numbers = {name: tuple(map(float, stokes)) for name, stokes in published.items()}
            path.cases[case] = Case(given, numbers, table.get("note", ""))
        faults.refuse(_ENOUGH)


def _argument(raw: Any, parameter: Parameter, uses: list[Use]) -> Any:
    """Return what a case gives for a parameter, which is allowed wherever that stands."""
    value = decode_argument(raw, parameter, uses)
    parameter.resolve(value)
    return value


def _is_stokes(stokes: Any) -> bool:
    four = isinstance(stokes, list) and len(stokes) == 4
    are_numbers = four and {*map(type, stokes)} <= {int, float}
    return are_numbers and [abs(each) < 1e308 for each in stokes] == [True] * 4
