"""A path drawn as a graph in SVG: layers, boxes, arrows and a legend."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeAlias
from xml.etree.ElementTree import Element as Tag
from xml.etree.ElementTree import SubElement, indent, tostring

import networkx as nx
from rich.cells import cell_len, chop_cells

from optipath.composer.wiring import Wiring
from optipath.errors import printable
from optipath.paths.drawing import draw, element_values, value_text

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.composer.wiring import Link
    from optipath.elements.element import Element
    from optipath.paths.path_graph import PathGraph
    from optipath.values.parameters import Parameter

    Labels: TypeAlias = Sequence[tuple["Link", str]]


Item: TypeAlias = "str | tuple[Link, int]"
"""What takes a place in a layer: a node by its name, or a link that passes, with the layer."""

_SWEEPS = 8


@dataclass(frozen=True)
class GraphLayers:
    """Layers of nodes, from the first that light passes to the last."""

    rows: list[list[Item]]
    ways: dict[Link, list[Item]]
    back: list[Link]

    @property
    def layer(self) -> dict[Item, int]:
        """The number of the layer of each item."""
        return {item: number for number, row in enumerate(self.rows) for item in row}


def graph_layers(order: Sequence[str], links: Sequence[Link]) -> GraphLayers:
    """Return the layers of a graph.

    Each node is behind all that send it light; few links cross (barycenters: Sugiyama, Tagawa and
    Toda, IEEE Trans. SMC 11, 109, 1981).

    >>> links = [("a", "b", ("out", "in")), ("b", "c", ("out", "in")), ("a", "c", ("left", "in"))]
    >>> graph_layers(["a", "b", "c"], links).rows
    [['a'], ['b', (('a', 'c', ('left', 'in')), 1)], ['c']]
    """
    place = {name: number for number, name in enumerate(order)}
    onwards = [link for link in links if place[link[0]] < place[link[1]]]
    layer = _layer_of(order, onwards)
    rows: list[list[Item]] = [[] for _ in range(1 + max(layer.values(), default=0))]
    for name in order:
        rows[layer[name]].append(name)
    ways: dict[Link, list[Item]] = {}
    for link in onwards:
        passed: list[Item] = [
            (link, number) for number in range(layer[link[0]] + 1, layer[link[1]])
        ]
        for number, item in enumerate(passed, layer[link[0]] + 1):
            rows[number].append(item)
        ways[link] = [link[0], *passed, link[1]]
    back = [link for link in links if place[link[0]] >= place[link[1]]]
    return GraphLayers(_in_order(rows, ways), ways, back)


def _layer_of(order: Sequence[str], onwards: Sequence[Link]) -> dict[str, int]:
    layer = dict.fromkeys(order, 0)
    ends: dict[str, list[str]] = {name: [] for name in order}
    for start, end, _ in onwards:
        ends[start].append(end)
    for name in order:
        for end in ends[name]:
            layer[end] = max(layer[end], layer[name] + 1)
    # Where nothing comes from above, a node stands next to what it sends light to.
    reached = {end for _, end, _ in onwards}
    for name in order:
        if name not in reached and ends[name]:
            layer[name] = min(layer[end] for end in ends[name]) - 1
    return layer


def _neighbours(ways: Mapping[Link, Sequence[Item]], step: int) -> dict[Item, list[Item]]:
    """Return what each item is linked with in the layer before (-1) or behind it (1)."""
    results: dict[Item, list[Item]] = {}
    for way in ways.values():
        for one, next_one in pairwise(way):
            here, there = (one, next_one) if step > 0 else (next_one, one)
            results.setdefault(here, []).append(there)
    return results


def _in_order(rows: list[list[Item]], ways: Mapping[Link, Sequence[Item]]) -> list[list[Item]]:
    for sweep in range(_SWEEPS):
        down = sweep % 2 == 0
        linked = _neighbours(ways, -1 if down else 1)
        place: dict[Item, float] = {}
        for row in rows if down else reversed(rows):
            near = {item: [place[one] for one in linked.get(item, ())] for item in row}
            here = {item: (number + 0.5) / len(row) for number, item in enumerate(row)}
            row.sort(key=lambda one: sum(near[one]) / len(near[one]) if near[one] else here[one])
            place |= {item: (number + 0.5) / len(row) for number, item in enumerate(row)}
    return rows


_PLACE_SWEEPS = 12


class Extent(NamedTuple):
    """How far something reaches from its middle."""

    left: float
    right: float


def layer_places(
    layers: GraphLayers,
    extents: Mapping[Item, Extent],
    gap: float,
    ends: Mapping[Link, tuple[float, float]],
) -> dict[Item, float]:
    """Return the middle of each item: near those that it is linked with, and over none beside.

    >>> from optipath.cli.path_picture import graph_layers
    >>> links = [("a", "b", ("out", "in")), ("a", "c", ("left", "in"))]
    >>> extents = dict.fromkeys("abc", Extent(10, 10))
    >>> layer_places(graph_layers("abc", links), extents, 4, dict.fromkeys(links, (0, 0)))
    {'a': 22.0, 'b': 10.0, 'c': 34.0}
    """
    places: dict[Item, float] = {item: 0.0 for row in layers.rows for item in row}
    linked = {step: _linked(layers, ends, step) for step in (-1, 1)}
    for sweep in range(_PLACE_SWEEPS):
        # At last downwards, so that a chain hangs straight from where it begins.
        step = -1 if sweep % 2 else 1
        for row in layers.rows if step < 0 else reversed(layers.rows):
            near = [
                [places[one] + shift for one, shift in linked[step].get(item, [(item, 0.0)])]
                for item in row
            ]
            wanted = [_mean(each) for each in near]
            places |= zip(row, _apart(wanted, [extents[item] for item in row], gap), strict=True)
    left = min((place - extents[item].left for item, place in places.items()), default=0.0)
    return {item: place - left for item, place in places.items()}


def _linked(
    layers: GraphLayers, ends: Mapping[Link, tuple[float, float]], step: int
) -> dict[Item, list[tuple[Item, float]]]:
    """Return what each item hangs on in the layer before (-1) or behind (1), and how far beside."""
    results: dict[Item, list[tuple[Item, float]]] = {}
    for link, way in layers.ways.items():
        leaves, enters = ends[link]
        offsets = [leaves, *[0.0] * (len(way) - 2), enters]
        for (above, left), (below, right) in pairwise(zip(way, offsets, strict=True)):
            if step < 0:
                results.setdefault(below, []).append((above, left - right))
            else:
                results.setdefault(above, []).append((below, right - left))
    return results


def _apart(wanted: Sequence[float], extents: Sequence[Extent], gap: float) -> list[float]:
    """Return places nearest to those wanted (least squares) without overlap.

    Isotonic regression by pooling adjacent violators, of places less the room before them.
    """
    room = [0.0]
    for before, after in pairwise(extents):
        room.append(room[-1] + before.right + gap + after.left)
    pools: list[list[float]] = []
    for place, taken in zip(wanted, room, strict=True):
        pools.append([place - taken])
        while len(pools) > 1 and _mean(pools[-2]) > _mean(pools[-1]):
            last = pools.pop()
            pools[-1] += last
    level = [_mean(pool) for pool in pools for _ in pool]
    return [one + taken for one, taken in zip(level, room, strict=True)]


def _mean(numbers: Sequence[float]) -> float:
    return sum(numbers) / len(numbers)


NAME, SMALL = 14.0, 12.0
"""The sizes of letters."""

_CELLS = 36  # How many letters a line of a box has at most.
_NARROWEST, _PADDING = 120.0, 10.0
_NAME_STEP, _STEP = 18.0, 16.0
_OUTLET, _ARROW = 18.0, 28.0  # How far outlets stand from one another, and how long they are.
_BESIDE, _APART = 6.0, 14.0  # Between a link and its label, and between a label and a link.


@dataclass(frozen=True)
class NodeBox:
    """What is drawn of a node."""

    name: list[str]
    kind: list[str]
    values: list[str]
    role: str
    outlets: list[str]
    leaving: dict[Link, float]
    entering: dict[Link, float]
    width: float
    height: float
    extent: Extent

    def draw(self, parent: Tag, x: float, y: float) -> None:
        """Add the texts to a drawing."""
        below = y + _PADDING
        for lines, size, step, kind in (
            (self.name, NAME, _NAME_STEP, "name"),
            (self.kind, SMALL, _STEP, "faint"),
            (self.values, SMALL, _STEP, "ink"),
        ):
            for line in lines:
                add_text(parent, line, x + _PADDING, below + size * 0.9, size, kind)
                below += step

    def outlet_places(self, y: float) -> list[tuple[str, float, float]]:
        """Return each outlet with its height, and how long its arrow is."""
        return [
            (message, y + _OUTLET * (number + 1), _ARROW)
            for number, message in enumerate(self.outlets)
        ]


def node_box(
    name: str, element: Element, outlets: Sequence[str], leaving: Labels, entering: Labels
) -> NodeBox:
    """Return the box of a node."""
    texts = lines_of(name, _CELLS - 4), lines_of(element.kind, _CELLS)
    values = [line for each in element_values(element) for line in lines_of(each, _CELLS)]
    messages = [f"{drawable(port)}: leaves the path" for port in outlets]
    below, above = _slots(leaving), _slots(entering)
    widths = [text_width(line, NAME) for line in texts[0]]
    widths += [text_width(line, SMALL) for line in (*texts[1], *values)]
    reach = max((abs(place) for place in (*below.values(), *above.values())), default=0.0)
    width = max(_NARROWEST, *widths, 2 * reach) + 2 * _PADDING
    height = 2 * _PADDING + _NAME_STEP * len(texts[0]) + _STEP * (len(texts[1]) + len(values))
    labelled = [
        place + _BESIDE + text_width(label, SMALL)
        for slots, labels in ((below, leaving), (above, entering))
        for (_, label), place in zip(labels, slots.values(), strict=True)
    ]
    others = [_ARROW + _BESIDE + text_width(one, SMALL) for one in messages]
    return NodeBox(
        *texts,
        values,
        "inner" if element.inputs and element.outputs else "end" if element.inputs else "source",
        messages,
        below,
        above,
        width,
        max(height, _OUTLET * (len(messages) + 1)),
        Extent(width / 2, max(width / 2 + max(others, default=0.0), *labelled, 0.0)),
    )


def _slots(labels: Labels) -> dict[Link, float]:
    """Return where links stand beside one another, with room for what is written at each."""
    if len(labels) == 1:
        return {labels[0][0]: 0.0}
    rooms = [_BESIDE + text_width(label, SMALL) + _APART for _, label in labels]
    begin = -sum(rooms) / 2
    return {link: begin + sum(rooms[:number]) for number, (link, _) in enumerate(labels)}


_WIDEST, _LAST, _LEGEND_CELLS, _BETWEEN = (22, 22, 24), 40, 98, 2  # In letters.
_STEP, _APART = 16.0, 4.0


@dataclass(frozen=True)
class PictureLegend:
    """Tables of texts, one under the other."""

    tables: list[list[tuple[list[str], ...]]]
    columns: list[list[int]]

    @property
    def width(self) -> float:
        """How wide the widest table is."""
        cells = (sum(columns) + _BETWEEN * (len(columns) - 1) for columns in self.columns)
        return text_width(" ", SMALL) * max(cells, default=0)

    def draw(self, parent: Tag, x: float, y: float) -> float:
        """Add the tables to a drawing; return where they end."""
        letter = text_width(" ", SMALL)
        for rows, columns in zip(self.tables, self.columns, strict=True):
            for number, row in enumerate(rows):
                for place, cell in enumerate(row):
                    left = x + letter * (sum(columns[:place]) + _BETWEEN * place)
                    kind = "name" if number == 0 else "ink" if place else "name"
                    for line, text in enumerate(cell):
                        add_text(parent, text, left, y + SMALL + _STEP * line, SMALL, kind)
                y += _STEP * max(map(len, row)) + _APART
            y += _STEP
        return y


def legend_of(path: PathGraph, case: str | None = None) -> PictureLegend:
    """Return the legend of a path."""
    result = PictureLegend([], [])
    if rows := parameter_rows(path):
        _add(result, [headings(case), *rows], _WIDEST)
    named: dict[str, list[str]] = {}
    for name, each in path.cases.items():
        named.setdefault(each.note, []).append(name)
    if named:
        alone = [*named] == [""]
        notes = [(", ".join(names), note) for note, names in named.items()]
        _add(result, [("cases", ""), *notes], [_LEGEND_CELLS if alone else _WIDEST[0]])
    return result


def _add(legend: PictureLegend, rows: Sequence[tuple[str, ...]], widest: Sequence[int]) -> None:
    """Add a table whose last column takes the room that the others leave."""
    others = [[lines_of(row[place], most) for row in rows] for place, most in enumerate(widest)]
    columns = [max(cell_len(line) for cell in each for line in cell) for each in others]
    rest = max(_LAST, _LEGEND_CELLS - sum(columns) - _BETWEEN * len(columns))
    last = [lines_of(row[-1], rest) for row in rows]
    legend.tables.append([*zip(*others, last, strict=True)])
    widest_last = max((cell_len(line) for cell in last for line in cell), default=0)
    legend.columns.append([*columns, widest_last])


Row = tuple[str, str, str, str]
"""The name, the default, the range, and what it is."""


def headings(case: str | None) -> Row:
    """Return what stands above the columns: of a path with the values of a case no defaults.

    >>> headings(None)[1], headings("8")[1]
    ('default', 'value')
    """
    return "parameter", "default" if case is None else "value", "range", "what it is"


def parameter_rows(path: PathGraph) -> list[Row]:
    """Return the rows of a path.

    >>> import optipath as op
    >>> parameter_rows(op.load_preset("malus"))[0]
    ('angle', '30 deg', '-360 deg .. 360 deg', 'turn of the analyser against the polariser')
    """
    rows = [_row(parameter) for parameter in path.parameters.values()]
    for name, choice in path.choices.items():
        described = "; ".join(filter(None, [choice.help, ", ".join(choice.behind)]))
        rows.append((name, choice.place(path.graph), "", described))
    return rows


def _row(parameter: Parameter) -> Row:
    described = "; ".join(filter(None, [parameter.help, ", ".join(parameter.all_words)]))
    default = ("bound to " if parameter.bound else "") + parameter.default_text()
    return parameter.name, default, parameter.range_text(), described


FACE = "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, 'Liberation Mono', monospace"
"""Typefaces whose letters have one width."""

_CELL = 0.6  # The width of a letter, as a part of its height.
_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def text_width(text: str, size: float) -> float:
    """Return how wide a text is drawn."""
    return cell_len(text) * _CELL * size


def add_text(parent: Tag, text: str, x: float, y: float, size: float, kind: str) -> None:
    """Add a text of one line, stretched or squeezed to the width that is reckoned with."""
    if not text:
        return
    SubElement(
        parent,
        "text",
        {
            "x": f"{x:g}",
            "y": f"{y:g}",
            "class": kind,
            "font-size": f"{size:g}",
            "textLength": f"{text_width(text, size):g}",
            "lengthAdjust": "spacingAndGlyphs",
        },
    ).text = text


def drawable(text: str) -> str:
    r"""Return a text on one line, with the codes of characters that XML has no place for.

    >>> print(drawable("a\n b"))
    a b
    """
    tame = printable(" ".join(text.split()))
    return _NO_XML.sub(lambda result: f"U+{ord(result[0]):04X}", tame)


def lines_of(text: str, cells: int) -> list[str]:
    """Return a text in lines of at most so many cells; words that are longer are broken.

    >>> lines_of("a polariser of reflected light", 12)
    ['a polariser', 'of reflected', 'light']
    """
    lines: list[str] = []
    for word in drawable(text).split():
        joined = f"{lines[-1]} {word}" if lines else word
        if lines and cell_len(joined) <= cells:
            lines[-1] = joined
        else:
            lines += chop_cells(word, cells)
    return lines


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

    Nodes are below all that send light to them; taps are dashed, and loops led back at the right.

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
        page: Tag,
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
        for message, height, length in box.outlet_places(y):
            begin = x + box.width
            drawn = f"M{begin:g} {height:g}H{begin + length:g}"
            attributes = {"d": drawn, "class": "link", "marker-end": "url(#head)"}
            SubElement(self.page, "path", attributes)
            add_text(self.page, message, begin + length + 6, height + 4, SMALL, "faint")


def _page(path: PathGraph, name: str) -> Tag:
    labelled = {"role": "img", "aria-labelledby": "title description"}
    page = Tag("svg", {"xmlns": "http://www.w3.org/2000/svg", "width": "0", "height": "0"})
    page.attrib |= labelled
    SubElement(page, "title", {"id": "title"}).text = f"The path {drawable(name)}"
    messages = [drawable(line) for line in (path.description, *draw(path).splitlines())]
    SubElement(page, "desc", {"id": "description"}).text = "\n".join(messages)
    SubElement(page, "style").text = _STYLE
    head = {"id": "head", "viewBox": "0 0 10 10", "refX": "9", "refY": "5", "orient": "auto"}
    marker = SubElement(page, "marker", {**head, "markerWidth": "7", "markerHeight": "7"})
    SubElement(marker, "path", {"d": "M0 1L10 5L0 9z", "class": "head"})
    SubElement(page, "rect", {"width": "100%", "height": "100%", "class": "page"})
    return page


def _heading(page: Tag, name: str, description: str, width: float) -> float:
    below = _MARGIN
    for text, size, kind in ((name, _TITLE, "title"), (description, SMALL + 1, "ink")):
        for line in lines_of(text, int((width - 2 * _MARGIN) / text_width("x", size))):
            below += size * 1.4
            add_text(page, line, _MARGIN, below, size, kind)
    return below + _MARGIN
