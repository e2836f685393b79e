"""Reader: a preset file as a path: parameters, elements, links, choices and cases."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

from optipath.composer.path_values import Values
from optipath.composer.validate import validate
from optipath.composer.wiring import LOOPS
from optipath.elements.known_elements import element_class
from optipath.errors import Fault, OptipathError, PathError, PresetError, did_you_mean, shown
from optipath.kernels.kernel import called
from optipath.light.frame import Frame
from optipath.materials.quantities import ANGLE
from optipath.paths.files import schema
from optipath.paths.files.schema import FORMAT, Faults, checked_table
from optipath.paths.files.toml import parsed
from optipath.paths.files.values import decode, decode_argument, wavelength_names
from optipath.paths.path_graph import PathGraph
from optipath.values.cases import Case, name_faults
from optipath.values.curve_value import CurveValue
from optipath.values.domains import Domain
from optipath.values.parameters import Parameter, checked_name
from optipath.values.units import USUAL_UNITS, dimension_of, with_article
from optipath.values.use import checked_later
from optipath.values.wavelength import WAVELENGTH, Wavelength, falls_with_wavelength

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.elements.element import Element

    Table: TypeAlias = dict[str, Any]


_ENOUGH = 100
"""After how many faults a file is not read on: each suggestion takes its time."""


def path_of_text(text: str, source: str, about: str = "") -> PathGraph:
    """Return the path that a text describes, as `PathGraph.to_toml` writes it."""
    document = parsed(text, source)
    number = document.get("format", FORMAT)
    if number != FORMAT or isinstance(number, bool):
        raise PresetError(
            f"'{source}' has format {shown(number)}, but this version reads format {FORMAT}"
        )
    try:
        return read(document)
    except RecursionError:
        raise PresetError(f"'{source}' is too deeply nested") from None
    except OptipathError as error:
        raise PathError(*error.within("file"), about=about or source) from None


def read(document: Table) -> PathGraph:
    """Return the path that a parsed TOML document describes.

    Faults of parameters, elements and links are reported together, then those of units, of cases,
    of the whole path, and of choices.
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
        if not isinstance(table, dict) or missing.isdisjoint(_nodes(table)):
            faults.attempt(f"links[{number}]", _connect, path, table, parameters)
            faults.refuse(_ENOUGH)
    faults.refuse()
    values = Values(path.graph)
    faults += [
        f"parameter '{name}' is declared, but no element takes it"
        for name in parameters
        if name not in values.parameters
    ]
    faults += _unit_faults(values, parameters)
    faults.refuse()
    for name, table in sections["cases"].items():
        faults += name_faults(name)
        case = faults.attempt(f"cases.{name}", _case, path, table, values, parameters)
        if case is not None:
            path.cases[name] = case
        faults.refuse(_ENOUGH)
    faults.refuse()
    validate(path.graph, values)
    for name, table in document.get("choices", {}).items():
        faults.attempt(f"choices.{name}", _offer, path, name, table)
    faults.refuse()
    return path


def _unit_faults(values: Values, parameters: Mapping[str, Parameter]) -> list[Fault]:
    """Return a fault for each parameter that stands where another unit belongs, or any."""
    faults: dict[str, Fault] = {}
    for use in values.uses:
        name = use.value.name if isinstance(use.value, Parameter) else ""
        dimension = use.domain.dimension
        if name not in parameters or isinstance(use.value, CurveValue):
            continue
        if dimension_of(unit := parameters[name].unit) != dimension:
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
    checked_name(name)
    unit = table.get("unit", WAVELENGTH.unit if of_light else "")
    dimension = dimension_of(unit)
    of_light = of_light and dimension == "length"
    domain = WAVELENGTH if of_light else Domain("value", dimension, own_unit=unit)
    kind = Wavelength if of_light else Parameter
    faults = Faults()
    words = {
        word: faults.attempt(f".words.{word}", decode, raw, domain, {})
        for word, raw in table.get("words", {}).items()
    }
    limits = faults.attempt(".range", _limits, table["range"], domain) if "range" in table else {}
    faults.refuse()
    words = {word: _as_text(number, dimension) for word, number in words.items()}
    keys: Table = {"unit": unit, "words": words, "help": table.get("help", "")}
    keys |= {end: _as_text(limit, dimension) for end, limit in (limits or {}).items()}
    keys["optional"] = table.get("optional", False)
    default = None
    if "default" in table:
        bare = kind(name, None, **keys)
        default = faults.attempt(".default", decode_argument, table["default"], bare)
    faults.refuse()
    return kind(name, _as_text(default, dimension), bound=table.get("bound", False), **keys)


def _as_text(value: Any, dimension: str) -> Any:
    """Return an angle that has been read as a text again: a plain number might be one of degrees.

    >>> _as_text(0.5, "angle"), _as_text(0.5, "length")
    ('0.5 rad', 0.5)
    """
    is_angle = dimension == "angle" and type(value) is float and math.isfinite(value)
    return f"{value} rad" if is_angle else value


def _limits(raw: list[Any], domain: Domain) -> Table:
    """Return the limits of a parameter, the lower one first where photon energies rise."""
    if len(raw) != 2:
        raise PresetError(f"'range' must have two ends, not {len(raw)}")
    ends = [decode(end, domain, {}) for end in raw]
    if domain is WAVELENGTH and all(map(falls_with_wavelength, raw)):
        ends.sort()
    return dict(zip(("minimum", "maximum"), ends, strict=True))


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
    checked_table(table, known, filter(of_kind.needs, domains))
    faults = Faults()
    values = {
        name: faults.attempt(f".{name}", decode, table[name], domain, parameters)
        for name, domain in domains.items()
        if name in table
    }
    frames = {
        port: faults.attempt(f".frames.{port}", _frame, axes)
        for port, axes in table.get("frames", {}).items()
    }
    faults.refuse()
    return called(f"element class {of_kind.__name__}", lambda: of_kind(**values)), frames  # type: ignore[return-value] # no None without faults


def _frame(axes: Any) -> Frame:
    return Frame(**checked_table(axes, ("x", "y", "z", "rounding"), "xyz"))


def _nodes(table: Table) -> list[str]:
    """Return the nodes at both ends of a link."""
    return [str(table.get(key)).partition(".")[0] for key in ("from", "to")]


def _connect(path: PathGraph, table: Any, parameters: Mapping[str, Parameter]) -> None:
    checked_table(table, schema.LINK, ("from", "to"))
    faults, azimuth = Faults(), None
    if "azimuth" in table:
        azimuth = faults.attempt(".azimuth", decode, table["azimuth"], ANGLE, parameters)
    tap = table.get("tap", False)
    faults.attempt("", path.connect, table["from"], table["to"], azimuth, tap=tap)
    faults.refuse()


def _offer(path: PathGraph, name: str, table: Any) -> None:
    checked_table(table, schema.CHOICE, ("element", "behind"))
    path.offer(name, table["element"], table["behind"], table.get("help", ""))


def _case(path: PathGraph, table: Any, values: Values, parameters: Mapping[str, Parameter]) -> Case:
    """Return the case that a table describes."""
    checked_table(table, schema.CASE)
    faults, known = Faults(), {**values.parameters, **parameters}
    results = {}
    for name, raw in table.get("values", {}).items():
        if name not in known:
            faults.append(Fault(f"parameter '{name}' is unknown{did_you_mean(name, known)}"))
            continue
        value = faults.attempt(f".{name}", decode_argument, raw, known[name], values.uses)
        if value is not None:
            faults.attempt(f".{name}", known[name].resolve, value)
            faults += [
                Fault.of(doubt).under(f".{name}")
                for use in values.uses
                if isinstance(use.value, Parameter) and use.value.name == name
                if (doubt := use.doubt(value))
            ]
            results[name] = value
    published = table.get("published", {})
    ends = [name for name in path if not path.element(name).outputs]
    for name, stokes in published.items():
        if name not in ends:
            cure = did_you_mean(name, ends)
            faults.append(Fault(f"'{name}' is no detector{cure}", place=".published"))
        elif not _is_stokes(stokes):
            reason = f"{shown(stokes)} must be four finite numbers"
            faults.append(Fault(reason, place=f".published.{name}"))
    faults.refuse()
    return Case(results, published, table.get("note", ""))


def _is_stokes(stokes: Any) -> bool:
    return (
        isinstance(stokes, list)
        and len(stokes) == 4
        and all(type(part) in (int, float) and abs(part) < 1e308 for part in stokes)
    )
