"""A path drawn in characters: nodes in the order of travel, links between them."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.wiring import Wiring
from optipath.elements.vertex_chain import VerticesByAngles
from optipath.faults import shown
from optipath.materials.index_domains import FOLLOWS
from optipath.materials.material import Material
from optipath.values.curve_value import CurveValue
from optipath.values.parameters import Parameter
from optipath.values.units import format_quantity

if TYPE_CHECKING:
    import networkx as nx

    from optipath.composer.composer import Path
    from optipath.elements.element import Element


_FEW = 4
"""As many numbers as light has."""


def draw(path: Path) -> str:
    """Return the drawing.

    >>> import optipath as op
    >>> print(draw(op.load_preset("malus")).splitlines()[0])
    lamp       source     intensity=$intensity
    """
    graph = path.graph
    wiring = Wiring(graph)
    travelled = [name for name, _ in wiring.order]
    order = list(dict.fromkeys([*travelled, *wiring.elements]))
    name_width = max(map(len, order))
    kind_width = max(len(element.kind) for element in wiring.elements.values())
    lines = []
    for name in order:
        element = wiring.elements[name]
        described = f"{name.ljust(name_width)}  {element.kind.ljust(kind_width)}  "
        lines.append((described + "  ".join(element_values(element))).rstrip())
        for link in sorted(graph.out_edges(name, keys=True)):
            _, end, (leaves, enters) = link
            azimuth, tap = graph.edges[link]["azimuth"], graph.edges[link].get("tap")
            turn = "" if azimuth is None else f"  turned by {value_text(azimuth, 'deg')}"
            lines.append(f"  | {leaves} --> {end}.{enters}{turn}{'  (a tap)' * bool(tap)}")
        leaving = [port for port in element.outputs if f"{name}.{port}" in wiring.outlets]
        lines += [f"  | {port} --> leaves the path" for port in leaving]
    return "\n".join(lines)


def element_values(element: Element) -> list[str]:
    """Return the values of an element that are not the usual ones, each with its name."""
    return [f"{name}={text}" for name, text in _texts(element).items()]


def _texts(element: Element) -> dict[str, str]:
    domains = element.domains()
    result = {}
    for f in fields(element):  # type: ignore[arg-type]
        value = getattr(element, f.name)
        if value is None or (isinstance(value, (int, float, str)) and value == f.default):
            continue
        result[f.name] = value_text(value, domains[f.name].unit)
    return result


_UNITS = {"azimuth": "deg", "length": "mm"}


def with_texts(graph: nx.MultiDiGraph) -> nx.MultiDiGraph:
    """Return a plain graph whose values are texts, in place; the kind of an element is its text."""
    for name in {"declared", "cases", "choices"} & graph.graph.keys():
        graph.graph[name] = ", ".join(map(str, graph.graph[name]))
    for link in graph.edges.values():
        units = {name: unit for name, unit in _UNITS.items() if name in link}
        link |= {name: value_text(link[name], unit) for name, unit in units.items()}
    for node in graph.nodes.values():
        element = node["element"]
        node |= {"element": element.kind or type(element).__name__, **_texts(element)}
        if "frames" in node:
            node["frames"] = str(node["frames"])
    for about in (graph.graph, *graph.nodes.values(), *graph.edges.values()):
        odd = {name: one for name, one in about.items() if not isinstance(one, (int, float))}
        about |= {n: str(one) if isinstance(one, str) else shown(one) for n, one in odd.items()}
    return graph


def value_text(value: Any, unit: str) -> str:
    """Return a value of an element as a drawing shows it: ``$name`` for a parameter."""
    if value is FOLLOWS:
        return value.word
    if isinstance(value, CurveValue):
        return value.formula_of(value.spoken)
    if isinstance(value, Parameter):
        return value.formula_of(f"${value.name}")
    if isinstance(value, Material):
        n, k = value.n, value.k
        if isinstance(n, CurveValue) and isinstance(k, CurveValue) and n.curve == k.curve:
            return str(n.curve.label)
        return f"{value_text(value.n, '')} + {value_text(value.k, '')} i"
    if isinstance(value, VerticesByAngles):
        names = ("incidences", "turns")
        texts = [f"{name} {value_text(getattr(value, name), 'deg')}" for name in names]
        return ", ".join([*texts, *["backwards"] * value.backwards])
    if isinstance(value, tuple):
        return "[" + ", ".join(value_text(one, unit) for one in value) + "]"
    if isinstance(value, np.ndarray):
        if not value.ndim or (value.ndim == 1 and value.size <= _FEW):
            return value_text(tuple(value.tolist()) if value.ndim else value.item(), unit)
        matrix = f"a {' x '.join(map(str, value.shape))} matrix"
        return matrix if value.ndim == 2 else f"array of shape {value.shape}"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return format_quantity(value, unit)
    return str(value)
