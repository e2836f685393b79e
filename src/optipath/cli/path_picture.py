"""A path drawn as a graph: boxes in the order of travel, arrows for links, a legend below."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import networkx as nx

from optipath.cli.graph_layers import graph_layers
from optipath.cli.layer_places import Extent, layer_places
from optipath.cli.node_box import SMALL, node_box
from optipath.cli.picture_legend import legend_of
from optipath.cli.svg_words import FACE, add_text, drawable, lines_of, text_width
from optipath.composer.wiring import Wiring
from optipath.paths.drawing import draw, value_text

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.cli.graph_layers import GraphLayers, Item
    from optipath.cli.node_box import NodeBox
    from optipath.composer.wiring import Link
    from optipath.paths.path_graph import PathGraph

_MARGIN, _NARROWEST, _GAP = 24.0, 760.0, 22.0
_LABEL, _ROUTE, _LANE = 20.0, 34.0, 12.0  # The heights of labels, bends and lanes of the way back.
_PASSING = Extent(9.0, 9.0)
_TITLE = 16.0

# As of paper, and dark where the viewer is; the page has a ground of its own in both.
_STYLE = """
text { font-family: FACE; fill: #222222; white-space: pre }
.page { fill: #ffffff } .name, .title { font-weight: bold } .faint { fill: #5c5c5c }
.box { fill: #f4f6f8; stroke: #5c5c5c } .source { fill: #fdf3d9 } .end { fill: #e1effa }
.link { fill: none; stroke: #222222; stroke-width: 1.5 } .tap { stroke-dasharray: 5 4 }
.head { fill: #222222 }
@media (prefers-color-scheme: dark) {
text { fill: #e8e8e8 } .faint { fill: #b0b0b0 } .page { fill: #16191d }
.box { fill: #23282e; stroke: #b0b0b0 } .source { fill: #3d3418 } .end { fill: #1b3347 }
.link { stroke: #e8e8e8 } .head { fill: #e8e8e8 } }
""".replace("FACE", FACE)


def path_picture(path: PathGraph, name: str, case: str | None = None) -> str:
    """Return the drawing of a path, as SVG.

    Nodes stand below all that send light to them; a tap is dashed, light that goes round is led
    back at the right. Each text has the width that is reckoned with, whatever the typeface.

    Examples
    --------
    >>> import optipath as op
    >>> path_picture(op.load_preset("malus"), "malus")[:42]
    '<svg xmlns="http://www.w3.org/2000/svg" wi'
    """
    name += f", case {case}" if case else ""
    layers, boxes, labels = _laid_out(path)
    items = [item for row in layers.rows for item in row]
    extents = {one: boxes[one].extent if isinstance(one, str) else _PASSING for one in items}
    ends = {link: (boxes[link[0]].leaving[link], boxes[link[1]].entering[link]) for link in labels}
    places = layer_places(layers, extents, _GAP, ends)
    right = max((place + extents[item].right for item, place in places.items()), default=0.0)
    legend = legend_of(path, case)
    graph_width = right + _LANE * 1.5 * len(layers.back)
    width = max(_NARROWEST, graph_width + 2 * _MARGIN, legend.width + 2 * _MARGIN)
    page = _page(path, name)
    below = _heading(page, name, path.description, width)
    shift = (width - graph_width) / 2
    places = {item: place + shift for item, place in places.items()}
    below = _Drawn(page, layers, boxes, labels, places, right + shift).draw(below)
    below = legend.draw(page, _MARGIN, below + _MARGIN) + _MARGIN
    page.set("width", f"{width:g}")
    page.set("height", f"{below:g}")
    page.set("viewBox", f"0 0 {width:g} {below:g}")
    indent(page, "")
    return tostring(page, "unicode") + "\n"


def _laid_out(path: PathGraph) -> tuple[GraphLayers, dict[str, NodeBox], dict[Link, _Labels]]:
    wiring = Wiring(path.graph)
    order = _order(wiring)
    links = sorted(path.graph.edges(keys=True))
    labels = {link: _Labels(path, link) for link in links}
    layers = graph_layers(order, links)
    place = {item: number for row in layers.rows for number, item in enumerate(row)}

    def at(link: Link, end: int) -> tuple[float, Link]:
        way = layers.ways.get(link, ())
        return (float(place[way[end]]) if way else float("inf")), link

    boxes = {}
    for name in order:
        leaving = sorted((one for one in links if one[0] == name), key=lambda one: at(one, 1))
        entering = sorted((one for one in links if one[1] == name), key=lambda one: at(one, -2))
        element = wiring.elements[name]
        boxes[name] = node_box(
            name,
            element,
            [port for port in element.outputs if f"{name}.{port}" in wiring.outlets],
            [(one, labels[one].leaves) for one in leaving],
            [(one, labels[one].enters) for one in entering],
        )
    return layers, boxes, labels


def _order(wiring: Wiring) -> list[str]:
    """Return the nodes so that links lead onwards, but for those with which light goes round."""
    travelled = [name for name, _ in wiring.order]
    place = {one: at for at, one in enumerate(dict.fromkeys([*travelled, *wiring.elements]))}
    rounds = nx.condensation(wiring.graph)
    members = {one: sorted(rounds.nodes[one]["members"], key=place.__getitem__) for one in rounds}
    order = nx.lexicographical_topological_sort(rounds, key=lambda one: place[members[one][0]])
    return [name for one in order for name in members[one]]


class _Labels:
    """What is written where a link leaves and where it enters."""

    def __init__(self, path: PathGraph, link: Link) -> None:
        data, (leaves, enters) = path.graph.edges[link], link[2]
        self.tap = bool(data.get("tap"))
        azimuth = data["azimuth"]
        turn = "" if azimuth is None else f", turned by {value_text(azimuth, 'deg')}"
        self.leaves = drawable(leaves + ", a tap" * self.tap)
        self.enters = drawable(enters + turn)


class _Drawn:
    """The graph, drawn row by row."""

    def __init__(
        self,
        page: Element,
        layers: GraphLayers,
        boxes: Mapping[str, NodeBox],
        labels: Mapping[Link, _Labels],
        places: Mapping[Item, float],
        right: float,
    ) -> None:
        self.page, self.layers, self.boxes, self.labels = page, layers, boxes, labels
        self.places, self.right = places, right
        self.layer = layers.layer
        self.tops: list[float] = []
        self.bottoms: list[float] = []
        self.bends: list[float] = []

    def draw(self, top: float) -> float:
        """Draw all below a height; return where it ends."""
        back, layer, count = self.layers.back, self.layer, len(self.layers.rows)
        # The lanes in which links come back, below each row and above it.
        down = [[one for one in back if layer[one[0]] == row] for row in range(count)]
        up = [[one for one in back if layer[one[1]] == row] for row in range(count)]
        below = top + (_LABEL + _LANE * (len(up[0]) + 1) if up[0] else 0.0)
        for number, row in enumerate(self.layers.rows):
            heights = [self.boxes[item].height for item in row if isinstance(item, str)]
            self.tops.append(below)
            self.bottoms.append(below + max(heights))
            is_last = number + 1 == count
            lanes = len(down[number]) + len([] if is_last else up[number + 1])
            self.bends.append(_ROUTE + _LANE * lanes)
            below = self.bottoms[-1] + 2 * _LABEL + self.bends[-1]
        below = self.bottoms[-1] + (_LABEL + _LANE * (len(down[-1]) + 1) if down[-1] else 0.0)
        for link, way in self.layers.ways.items():
            self._onwards(link, way)
        for number, link in enumerate(back, 1):
            under = self.bottoms[layer[link[0]]] + _LABEL
            under += _LANE * (down[layer[link[0]]].index(link) + 1)
            over = self.tops[layer[link[1]]] - _LABEL
            over -= _LANE * (up[layer[link[1]]].index(link) + 1)
            self._back(link, under, over, self.right + _LANE * 1.5 * number)
        for name, box in self.boxes.items():
            self._box(name, box)
        return below

    def _ends(self, link: Link) -> tuple[tuple[float, float], tuple[float, float]]:
        start, end = link[0], link[1]
        leaves = self.places[start] + self.boxes[start].leaving[link]
        enters = self.places[end] + self.boxes[end].entering[link]
        bottom = self.tops[self.layer[start]] + self.boxes[start].height
        return (leaves, bottom), (enters, self.tops[self.layer[end]])

    def _onwards(self, link: Link, way: Sequence[Item]) -> None:
        (x, y), (enters, top) = self._ends(link)
        first = self.layer[way[0]]
        drawn = f"M{x:g} {y:g}"
        for number, item in enumerate(way[1:], first):
            begin = self.bottoms[number] + _LABEL
            end = begin + self.bends[number]
            there = enters if item == way[-1] else self.places[item]
            middle = (begin + end) / 2
            drawn += f"V{begin:g}C{x:g} {middle:g} {there:g} {middle:g} {there:g} {end:g}"
            x = there
        self._link(link, f"{drawn}V{top:g}")

    def _back(self, link: Link, under: float, over: float, column: float) -> None:
        (x, y), (enters, top) = self._ends(link)
        self._link(link, f"M{x:g} {y:g}V{under:g}H{column:g}V{over:g}H{enters:g}V{top:g}")

    def _link(self, link: Link, drawn: str) -> None:
        labels = self.labels[link]
        kind = "link tap" if labels.tap else "link"
        SubElement(self.page, "path", {"d": drawn, "class": kind, "marker-end": "url(#head)"})
        (x, bottom), (enters, top) = self._ends(link)
        add_text(self.page, labels.leaves, x + 6, bottom + 14, SMALL, "faint")
        add_text(self.page, labels.enters, enters + 6, top - 10, SMALL, "faint")

    def _box(self, name: str, box: NodeBox) -> None:
        x, y = self.places[name] - box.width / 2, self.tops[self.layer[name]]
        size = {"width": f"{box.width:g}", "height": f"{box.height:g}", "rx": "6"}
        SubElement(
            self.page, "rect", {"x": f"{x:g}", "y": f"{y:g}", **size, "class": f"box {box.role}"}
        )
        box.draw(self.page, x, y)
        for told, height, length in box.outlet_places(y):
            begin = x + box.width
            drawn = f"M{begin:g} {height:g}H{begin + length:g}"
            attributes = {"d": drawn, "class": "link", "marker-end": "url(#head)"}
            SubElement(self.page, "path", attributes)
            add_text(self.page, told, begin + length + 6, height + 4, SMALL, "faint")


def _page(path: PathGraph, name: str) -> Element:
    labelled = {"role": "img", "aria-labelledby": "title description"}
    page = Element("svg", {"xmlns": "http://www.w3.org/2000/svg", "width": "0", "height": "0"})
    page.attrib |= labelled
    SubElement(page, "title", {"id": "title"}).text = f"The path {drawable(name)}"
    told = [drawable(line) for line in (path.description, *draw(path).splitlines())]
    SubElement(page, "desc", {"id": "description"}).text = "\n".join(told)
    SubElement(page, "style").text = _STYLE
    head = {"id": "head", "viewBox": "0 0 10 10", "refX": "9", "refY": "5", "orient": "auto"}
    marker = SubElement(page, "marker", {**head, "markerWidth": "7", "markerHeight": "7"})
    SubElement(marker, "path", {"d": "M0 1L10 5L0 9z", "class": "head"})
    SubElement(page, "rect", {"width": "100%", "height": "100%", "class": "page"})
    return page


def _heading(page: Element, name: str, description: str, width: float) -> float:
    below = _MARGIN
    for text, size, kind in ((name, _TITLE, "title"), (description, SMALL + 1, "ink")):
        for line in lines_of(text, int((width - 2 * _MARGIN) / text_width("x", size))):
            below += size * 1.4
            add_text(page, line, _MARGIN, below, size, kind)
    return below + _MARGIN
