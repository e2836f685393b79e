"""Reading a preset: from a parsed TOML document to a path, all faults at once."""

from __future__ import annotations

from typing import Any

import numpy as np

from optipath.cases import Case
from optipath.composer import structure_faults, value_faults
from optipath.domains import Domain
from optipath.elements import Element, element_class
from optipath.errors import OptipathError, PathError, did_you_mean
from optipath.frames import Frame
from optipath.parameters import Parameter
from optipath.path_graph import PathGraph
from optipath.preset_format import decode, decode_given, schema
from optipath.units import dimension_of

_AZIMUTH = Domain("azimuth", "angle")


def read(document: dict[str, Any]) -> PathGraph:
    """Return the path that a document describes.

    Raises
    ------
    PathError
        With every fault: keys, kinds, units, values, ports, links, and the path itself.
    """
    return _Reader(document).read()


class _Reader:
    """Goes through a document once and keeps the faults it meets."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.document = document
        self.faults: list[str] = []
        self.parameters: dict[str, Parameter] = {}
        self.used: set[str] = set()
        self.is_whole = True
        """Whether every node and link could be made, so that their structure says something."""

    def read(self) -> PathGraph:
        """Return the path, or raise with every fault."""
        self.faults += schema.type_faults("the preset", self.document, schema.TOP)
        if "format" not in self.document:
            self.faults.append(f"the preset: 'format' is missing; add format = {schema.FORMAT}")
        for name, table in self._tables("parameters"):
            self.parameters[name] = self._parameter(name, table)
        path = PathGraph(str(self.document.get("description", "")))
        for name, table in self._tables("elements"):
            self._add_element(path, name, table)
        for number, table in enumerate(self._links()):
            self._add_link(path, f"links[{number}]", table)
        for name, table in self._tables("cases"):
            path.cases[name] = self._case(f"cases.{name}", table)
        self._finish(path)
        return path

    def _finish(self, path: PathGraph) -> None:
        for name in self.parameters.keys() - self.used:
            self.faults.append(f"parameter '{name}' is declared, but no element takes it")
        if not self.faults:
            path.check()
            return
        self.faults += value_faults(path.graph)
        if self.is_whole:
            self.faults += structure_faults(path.graph)
        raise PathError(*dict.fromkeys(self.faults))

    def _tables(self, section: str) -> list[tuple[str, dict[str, Any]]]:
        found = []
        tables = self.document.get(section, {})
        for name, table in tables.items() if isinstance(tables, dict) else ():
            if isinstance(table, dict):
                found.append((name, table))
            else:
                self.is_whole = False
                self.faults.append(f"{section}.{name} must be a table, not {table!r}")
        return found

    def _links(self) -> list[dict[str, Any]]:
        links = self.document.get("links", [])
        if not isinstance(links, list) or not all(isinstance(link, dict) for link in links):
            self.is_whole = False
            self.faults.append("links must be tables, each headed [[links]]")
            return []
        return links

    def _attempt(self, where: str, action: Any, *arguments: Any, instead: Any = None) -> Any:
        try:
            return action(*arguments)
        except OptipathError as fault:
            self.faults += [f"{where}: {sentence}" for sentence in fault.faults]
            return instead

    def _parameter(self, name: str, table: dict[str, Any]) -> Parameter:
        where = f"parameters.{name}"
        wrong = schema.type_faults(where, table, schema.PARAMETER)
        self.faults += wrong
        unknown = Parameter(name if name.isidentifier() else "unknown")
        if wrong or not name.isidentifier():
            self._attempt(where, Parameter, name)
            return unknown
        unit = table.get("unit", "")
        dimension = self._attempt(where, dimension_of, unit)
        if dimension is None:
            return unknown
        keys = {key: table[key] for key in ("help", "optional", "bound") if key in table}
        bare = Domain("value", dimension)
        limits = table.get("range", [-np.inf, np.inf])
        if len(limits) != 2:
            self.faults.append(f"{where}: 'range' must have two ends, not {len(limits)}")
            return unknown
        before = len(self.faults)
        low, high = (self._attempt(f"{where}.range", decode, end, bare, {}) for end in limits)
        words = {
            word: self._attempt(f"{where}.words.{word}", decode, raw, bare, {})
            for word, raw in table.get("words", {}).items()
        }
        if len(self.faults) > before:
            return unknown
        keys |= {"unit": unit, "minimum": low, "maximum": high, "words": words}
        empty = self._attempt(where, lambda: Parameter(name, **{**keys, "bound": False}))
        if empty is None or "default" not in table:
            return self._attempt(where, lambda: Parameter(name, **keys), instead=unknown)
        default = self._attempt(f"{where}.default", decode_given, table["default"], empty)
        if default is None:
            return unknown
        return self._attempt(where, lambda: Parameter(name, default, **keys), instead=unknown)

    def _add_element(self, path: PathGraph, name: str, table: dict[str, Any]) -> None:
        where = f"elements.{name}"
        kind = table.get("kind")
        if not isinstance(kind, str):
            self.is_whole = False
            self.faults.append(f'{where}: kind is missing; add kind = "..."')
            return
        found = self._attempt(where, element_class, kind)
        if found is None:
            self.is_whole = False
            return
        element = self._element(where, found, table)
        frames = self._frames(where, table.get("frames", {}))
        if element is None:
            self.is_whole = False
            return
        self.used |= {parameter.name for parameter in element.parameters()}
        if self._attempt(where, path.add, name, element, frames) is None:
            self.is_whole = False

    def _element(self, where: str, kind: type[Element], table: dict[str, Any]) -> Element | None:
        domains = kind.domains()
        self.faults += schema.key_faults(where, table, ["kind", "frames", *domains])
        # A field that is missing or wrong becomes a parameter, so that the rest is checked too.
        unknown = Parameter("unknown")
        values: dict[str, Any] = {}
        for name, domain in domains.items():
            if name in table:
                at, raw = f"{where}.{name}", table[name]
                values[name] = self._attempt(
                    at, decode, raw, domain, self.parameters, instead=unknown
                )
            elif kind.needs(name):
                self.faults.append(f"{where}: '{name}' is missing; a {kind.kind} needs one")
                values[name] = unknown
        element: Element | None = self._attempt(where, lambda: kind(**values))
        return element

    def _frames(self, where: str, table: Any) -> dict[str, Frame]:
        if not isinstance(table, dict) or not all(isinstance(f, dict) for f in table.values()):
            self.faults.append(f"{where}.frames must be tables, one for each port")
            return {}
        frames = {}
        for port, axes in table.items():
            at = f"{where}.frames.{port}"
            wrong = schema.key_faults(at, axes, "xyz")
            wrong += [f"{at}: axis '{axis}' is missing" for axis in "xyz" if axis not in axes]
            self.faults += wrong
            frame = None if wrong else self._attempt(at, lambda a=axes: Frame(**a))
            if frame is not None:
                frames[port] = frame
        return frames

    def _add_link(self, path: PathGraph, where: str, table: dict[str, Any]) -> None:
        wrong = schema.type_faults(where, table, schema.LINK)
        wrong += [f"{where}: '{key}' is missing" for key in ("from", "to") if key not in table]
        self.faults += wrong
        if wrong:
            self.is_whole = False
            return
        azimuth = None
        if "azimuth" in table:
            azimuth = self._attempt(where, decode, table["azimuth"], _AZIMUTH, self.parameters)
        if isinstance(azimuth, Parameter):
            self.used.add(azimuth.name)
        before = len(self.faults)
        self._attempt(where, path.connect, table["from"], table["to"], azimuth)
        self.is_whole = self.is_whole and len(self.faults) == before

    def _case(self, where: str, table: dict[str, Any]) -> Case:
        wrong = schema.type_faults(where, table, schema.CASE)
        self.faults += wrong
        if wrong:
            return Case({})
        values = {}
        for name, raw in table.get("values", {}).items():
            if name not in self.parameters:
                cure = did_you_mean(name, self.parameters)
                self.faults.append(f"{where}: parameter '{name}' is unknown{cure}")
                continue
            at = f"{where}.{name}"
            values[name] = self._attempt(at, decode_given, raw, self.parameters[name])
            if values[name] is not None:
                self._attempt(at, self.parameters[name].resolve, values[name])
        published = self._attempt(where, _published, table.get("published", {}), instead={})
        return Case(values, published, table.get("note", ""))


def _published(table: dict[str, Any]) -> dict[str, tuple[float, ...]]:
    for name, stokes in table.items():
        numbers = isinstance(stokes, list) and all(type(s) in (int, float) for s in stokes)
        if not numbers or len(stokes) != 4:
            raise PathError(f"published.{name} must be four numbers, not {stokes!r}")
    return {name: tuple(float(s) for s in stokes) for name, stokes in table.items()}
