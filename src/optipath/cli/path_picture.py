"""A path drawn as a graph in SVG: layers, boxes, arrows and a legend."""

from __future__ import annotations

import re
from collections import defaultdict
from itertools import accumulate, pairwise
from math import inf
from statistics import fmean
from typing import TYPE_CHECKING, TypeAlias
from xml.sax.saxutils import escape

import networkx as nx
from rich.cells import cell_len, chop_cells

from optipath.composer.wiring import Wiring
from optipath.faults import printable
from optipath.paths.drawing import draw, element_values, value_text

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from optipath.composer.wiring import Link
    from optipath.paths.path_graph import PathGraph


Item: TypeAlias = "str | tuple[Link, int]"
"""What takes a place in a layer: a node by its name, or a link that passes, with the layer."""

_SMALL, _NAME, _TITLE = 12.0, 14.0, 16.0  # The sizes of letters.
_CELL = 0.6  # The width of a letter, as a part of its size.
_STEP = 17.0  # From one line to the next.
_MARGIN, _PADDING = 24.0, 10.0  # Around the page, and around the texts of a box.
_NARROWEST, _NARROWEST_BOX = 760.0, 140.0
_BOX_CELLS, _LEGEND_CELLS = 36, 98  # How many letters a line has at most.
_GAP = 22.0  # Between what stands beside each other in a layer.
_BESIDE, _APART = 6.0, 14.0  # Between a link and its label, and between a label and a link.
_LABEL, _BEND, _LANE = 20.0, 46.0, 12.0  # The heights of labels, bends and lanes of the way back.
_OUTLET, _ARROW = 18.0, 28.0  # How far outlets stand from one another, and how long they are.
_SWEEPS = 12

# As of paper, and dark where the viewer is; the page has a ground of its own in both.
_STYLE = """
text { font-family: ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, 'Liberation Mono', monospace;
fill: #222222; white-space: pre }
.page { fill: #ffffff } .name, .title { font-weight: bold } .faint { fill: #5c5c5c }
.box { fill: #f4f6f8; stroke: #5c5c5c } .source { fill: #fdf3d9 } .end { fill: #e1effa }
.link { fill: none; stroke: #222222; stroke-width: 1.5 } .tap { stroke-dasharray: 5 4 }
.head { fill: #222222 }
@media (prefers-color-scheme: dark) {
text { fill: #e8e8e8 } .faint { fill: #b0b0b0 } .page { fill: #16191d }
.box { fill: #23282e; stroke: #b0b0b0 } .source { fill: #3d3418 } .end { fill: #1b3347 }
.link { stroke: #e8e8e8 } .head { fill: #e8e8e8 } }
"""


_PAGE = """\
<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}" role="img" \
aria-labelledby="title description" viewBox="0 0 {width:g} {height:g}">
<title id="title">{title}</title>
<desc id="description">{description}</desc>
<style>{style}</style>
<marker id="head" viewBox="0 0 10 10" refX="9" refY="5" orient="auto" markerWidth="7" \
markerHeight="7">
<path d="M0 1L10 5L0 9z" class="head" />
</marker>
<rect width="100%" height="100%" class="page" />
{drawn}
</svg>
"""


def path_picture(path: PathGraph, name: str, case: str | None = None) -> str:
    """Return the drawing of a path, as SVG.

    Nodes are below all that send light to them; taps are dashed, and loops led back at the right.
    """
    name += f", case {case}" if case else ""
    graph = _Graph(path)
    width = max(_NARROWEST, graph.width + 2 * _MARGIN)
    drawn: list[str] = []
    below = _MARGIN
    for text, size, kind in ((name, _TITLE, "title"), (path.description, _SMALL + 1, "ink")):
        for line in lines_of(text, int((width - 2 * _MARGIN) / text_width("x", size))):
            below += size * 1.4
            drawn.append(_text(line, _MARGIN, below, kind, size))
    below = graph.draw(drawn, (width - graph.width) / 2, below + _MARGIN) + _MARGIN
    if rows := parameter_rows(path):
        below = _add_table(drawn, [headings(case), *rows], (22, 22, 24), below)
    named: dict[str, list[str]] = defaultdict(list)
    for one, values in path.cases.items():
        named[values.note].append(one)
    if named:
        notes = [("cases", ""), *((", ".join(names), note) for note, names in named.items())]
        most = _LEGEND_CELLS - 4 if [*named] == [""] else 22
        below = _add_table(drawn, notes, (most,), below)
    described = "\n".join(map(drawable, (path.description, *draw(path).splitlines())))
    return _PAGE.format(
        width=width,
        height=below,
        title=escape(f"The path {drawable(name)}"),
        description=escape(described),
        style=_STYLE,
        drawn="\n".join(drawn),
    )


class _Graph:
    """The boxes and links of a path: where they stand from the left, and in which layer."""

    def __init__(self, path: PathGraph) -> None:
        wiring = Wiring(path.graph)
        order, links = _order(wiring), sorted(path.graph.edges(keys=True))
        self.rows, self.ways = graph_layers(order, links)
        self.back = [link for link in links if link not in self.ways]
        self.layer = {item: number for number, row in enumerate(self.rows) for item in row}
        self.taps = {link for link in links if path.graph.edges[link].get("tap")}
        self.labels: dict[Link, tuple[str, str]] = {}
        for link in links:
            azimuth, (leaves, enters) = path.graph.edges[link]["azimuth"], link[2]
            turn = "" if azimuth is None else f", turned by {value_text(azimuth, 'deg')}"
            tap = ", a tap" if link in self.taps else ""
            self.labels[link] = drawable(leaves + tap), drawable(enters + turn)
        self.boxes = {name: self._box(name, wiring) for name in order}
        self.places = self._places()
        self.right = max(place + self._right(item) for item, place in self.places.items())
        self.width = self.right + 1.5 * _LANE * len(self.back)

    def _box(self, name: str, wiring: Wiring) -> _Box:
        place = {item: number for row in self.rows for number, item in enumerate(row)}

        def beside(end: int) -> dict[Link, str]:
            """Return the labels of the links that begin (0) or end here (1), from left to right."""
            several = [link for link in self.labels if link[end] == name]
            # As what they go to, or come from, stands in the next layer; loops come last.
            near = {one: self.ways[one][1 - 3 * end] for one in several if one in self.ways}
            several.sort(key=lambda one: place[near[one]] if one in near else len(place))
            return {link: self.labels[link][end] for link in several}

        return _Box(name, wiring, beside(0), beside(1))

    def _left(self, item: Item) -> float:
        return self.boxes[item].width / 2 if isinstance(item, str) else 9.0

    def _right(self, item: Item) -> float:
        return self.boxes[item].right if isinstance(item, str) else 9.0

    def _places(self) -> dict[Item, float]:
        """Return the middle of each item: below what it comes from, or as far left as it can."""
        above: dict[Item, list[tuple[Item, float]]] = defaultdict(list)
        for link, way in self.ways.items():
            shifts = [0.0] * (len(way) - 1)
            shifts[0] = self.boxes[link[0]].leaving[link]
            shifts[-1] -= self.boxes[link[1]].entering[link]
            for (upper, lower), shift in zip(pairwise(way), shifts, strict=True):
                above[lower].append((upper, shift))
        places: dict[Item, float] = {}
        for row in self.rows:
            end = -inf
            for item in row:
                wanted = [places[one] + shift for one, shift in above[item]] or [0.0]
                places[item] = max(fmean(wanted), end + self._left(item))
                end = places[item] + self._right(item) + _GAP
        left = min(place - self._left(item) for item, place in places.items())
        return {item: place - left for item, place in places.items()}

    def draw(self, drawn: list[str], left: float, top: float) -> float:
        """Draw all at a place; return where it ends."""
        lanes = _LABEL + _LANE * (len(self.back) + 1) if self.back else 0.0
        between = 2 * _LABEL + _BEND + _LANE * len(self.back)
        tops, bottoms = [top + lanes], []
        for row in self.rows:
            heights = [self.boxes[item].height for item in row if isinstance(item, str)]
            bottoms.append(tops[-1] + max(heights))
            tops.append(bottoms[-1] + between)
        places = {item: left + place for item, place in self.places.items()}
        for link, (leaves, enters) in self.labels.items():
            begin, end = self.layer[link[0]], self.layer[link[1]]
            x = places[link[0]] + self.boxes[link[0]].leaving[link]
            to = places[link[1]] + self.boxes[link[1]].entering[link]
            y = tops[begin] + self.boxes[link[0]].height
            way = f"M{x:g} {y:g}"
            drawn.append(_text(leaves, x + _BESIDE, y + 14, "faint"))
            drawn.append(_text(enters, to + _BESIDE, tops[end] - 10, "faint"))
            if link in self.ways:
                columns = [x, *(places[item] for item in self.ways[link][1:-1]), to]
                for number, (here, there) in enumerate(pairwise(columns), begin):
                    y, under = bottoms[number] + _LABEL, tops[number + 1] - _LABEL
                    middle = (y + under) / 2
                    way += f"V{y:g}C{here:g} {middle:g} {there:g} {middle:g} {there:g} {under:g}"
            else:
                lane = 1 + self.back.index(link)
                column = left + self.right + 1.5 * _LANE * lane
                y, over = bottoms[begin] + _LABEL + _LANE * lane, tops[end] - _LABEL - _LANE * lane
                way += f"V{y:g}H{column:g}V{over:g}H{to:g}"
            drawn.append(
                _arrow(f"{way}V{tops[end]:g}", "link tap" if link in self.taps else "link")
            )
        for name, box in self.boxes.items():
            box.draw(drawn, places[name] - box.width / 2, tops[self.layer[name]])
        return bottoms[-1] + lanes


class _Box:
    """What is drawn of a node: texts, outlets, and where links leave and enter, from its middle."""

    def __init__(
        self, name: str, wiring: Wiring, leaving: Mapping[Link, str], entering: Mapping[Link, str]
    ) -> None:
        element = wiring.elements[name]
        self.texts = [(line, _NAME, "name") for line in lines_of(name, _BOX_CELLS - 4)]
        for kind, texts in (("faint", [element.kind]), ("ink", element_values(element))):
            self.texts += [(line, _SMALL, kind) for t in texts for line in lines_of(t, _BOX_CELLS)]
        outlets = [port for port in element.outputs if f"{name}.{port}" in wiring.outlets]
        self.outlets = [f"{drawable(port)}: leaves the path" for port in outlets]
        inner = element.inputs and element.outputs
        self.role = "inner" if inner else "end" if element.inputs else "source"
        self.leaving, self.entering = _slots(leaving), _slots(entering)
        slots = [*self.leaving.values(), *self.entering.values()]
        widths = [text_width(line, size) for line, size, _ in self.texts]
        widths += [2 * abs(place) for place in slots]
        self.width = max(_NARROWEST_BOX, 2 * _PADDING + max(widths))
        lines = 2 * _PADDING + _STEP * len(self.texts)
        self.height = max(lines, _OUTLET * (len(self.outlets) + 1))
        starts = [self.width / 2 + _ARROW] * len(outlets) + slots
        labels = [*self.outlets, *leaving.values(), *entering.values()]
        beside = [
            start + _BESIDE + text_width(label) for start, label in zip(starts, labels, strict=True)
        ]
        self.right = max(self.width / 2, *beside)
        """How far it reaches from its middle, with what is written beside."""

    def draw(self, drawn: list[str], x: float, y: float) -> None:
        """Draw it at a place."""
        size = f'width="{self.width:g}" height="{self.height:g}" rx="6"'
        drawn.append(f'<rect x="{x:g}" y="{y:g}" {size} class="box {self.role}" />')
        for number, (line, letters, kind) in enumerate(self.texts):
            below = y + _PADDING + _STEP * number + 0.9 * letters
            drawn.append(_text(line, x + _PADDING, below, kind, letters))
        for number, message in enumerate(self.outlets, 1):
            height, begin = y + _OUTLET * number, x + self.width
            drawn.append(_arrow(f"M{begin:g} {height:g}H{begin + _ARROW:g}", "link"))
            drawn.append(_text(message, begin + _ARROW + _BESIDE, height + 4, "faint"))


def _slots(labels: Mapping[Link, str]) -> dict[Link, float]:
    """Return where links stand beside one another, with room for what is written at each."""
    if len(labels) == 1:
        return dict.fromkeys(labels, 0.0)
    rooms = [_BESIDE + text_width(label) + _APART for label in labels.values()]
    return dict(zip(labels, accumulate(rooms, initial=-sum(rooms) / 2), strict=False))


def _order(wiring: Wiring) -> list[str]:
    """Return the nodes so that links lead onwards, but for those with which light goes round."""
    travelled = [name for name, _ in wiring.order]
    place = {one: at for at, one in enumerate(dict.fromkeys([*travelled, *wiring.elements]))}
    rounds = nx.condensation(wiring.graph)
    members = {one: sorted(rounds.nodes[one]["members"], key=place.__getitem__) for one in rounds}
    order = nx.lexicographical_topological_sort(rounds, key=lambda one: place[members[one][0]])
    return [name for one in order for name in members[one]]


def graph_layers(
    order: Sequence[str], links: Sequence[Link]
) -> tuple[list[list[Item]], dict[Link, list[Item]]]:
    """Return the layers of a graph, and the items that each link passes that leads onwards.

    Each node is behind all that send it light; few links cross (barycenters: Sugiyama, Tagawa and
    Toda, IEEE Trans. SMC 11, 109, 1981).
    """
    place = {name: number for number, name in enumerate(order)}
    onwards = [link for link in links if place[link[0]] < place[link[1]]]
    graph = nx.DiGraph(link[:2] for link in onwards)
    graph.add_nodes_from(order)
    layer = {n: at for at, names in enumerate(nx.topological_generations(graph)) for n in names}
    # Where nothing comes from above, a node stands next to what it sends light to.
    for name in order:
        if graph.succ[name] and not graph.pred[name]:
            layer[name] = min(layer[later] for later in graph.succ[name]) - 1
    rows: list[list[Item]] = [[] for _ in range(1 + max(layer.values(), default=0))]
    for name in order:
        rows[layer[name]].append(name)
    ways: dict[Link, list[Item]] = {}
    items: nx.DiGraph[Item] = nx.DiGraph()
    items.add_nodes_from(order)
    for link in onwards:
        passed = [(link, at) for at in range(layer[link[0]] + 1, layer[link[1]])]
        for item in passed:
            rows[item[1]].append(item)
        ways[link] = [link[0], *passed, link[1]]
        nx.add_path(items, ways[link])
    for sweep in range(_SWEEPS):
        near, turned = (items.succ, rows[::-1]) if sweep % 2 else (items.pred, rows)
        middle: dict[Item, float] = {}
        for row in turned:
            here = {item: (number + 0.5) / len(row) for number, item in enumerate(row)}
            row.sort(
                key=lambda one: fmean(middle[n] for n in near[one]) if near[one] else here[one]
            )
            middle |= {item: (number + 0.5) / len(row) for number, item in enumerate(row)}
    return rows, ways


def headings(case: str | None) -> tuple[str, str, str, str]:
    """Return what stands above the rows: of a path with the values of a case no defaults."""
    return "parameter", "default" if case is None else "value", "range", "what it is"


def parameter_rows(path: PathGraph) -> list[tuple[str, str, str, str]]:
    """Return the name of each parameter, its default, its range, and what it is."""
    rows = []
    for name, each in path.parameters.items():
        described = "; ".join(filter(None, [each.help, ", ".join(each.all_words)]))
        default = ("bound to " if each.bound else "") + each.default_text()
        rows.append((name, default, each.range_text(), described))
    for name, choice in path.choices.items():
        described = "; ".join(filter(None, [choice.help, ", ".join(choice.behind)]))
        rows.append((name, choice.place(path.graph), "", described))
    return rows


def _add_table(
    drawn: list[str], rows: Sequence[tuple[str, ...]], most: Sequence[int], y: float
) -> float:
    """Add a table whose last column takes the room that the others leave; return where it ends."""
    *first, last = zip(*rows, strict=True)
    columns = [[lines_of(c, cells) for c in each] for each, cells in zip(first, most, strict=True)]
    widths = [max(cell_len(line) for c in each for line in c) + 2 for each in columns]
    columns.append([lines_of(c, _LEGEND_CELLS - sum(widths)) for c in last])
    lefts = [_MARGIN + text_width(" ") * width for width in accumulate(widths, initial=0)]
    for number, row in enumerate(zip(*columns, strict=True)):
        for left, lines in zip(lefts, row, strict=True):
            kind = "name" if number == 0 or left == _MARGIN else "ink"
            for at, line in enumerate(lines):
                drawn.append(_text(line, left, y + _SMALL + _STEP * at, kind))
        y += _STEP * max(map(len, row)) + 4
    return y + _STEP


def text_width(text: str, size: float = _SMALL) -> float:
    """Return how wide a text is drawn."""
    return cell_len(text) * _CELL * size


def _text(text: str, x: float, y: float, kind: str, size: float = _SMALL) -> str:
    """Return a text of one line, stretched or squeezed to the width that is reckoned with."""
    return (
        f'<text x="{x:g}" y="{y:g}" class="{kind}" font-size="{size:g}" '
        f'textLength="{text_width(text, size):g}" lengthAdjust="spacingAndGlyphs">'
        f"{escape(text)}</text>"
    )


def _arrow(way: str, kind: str) -> str:
    return f'<path d="{way}" class="{kind}" marker-end="url(#head)" />'


_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def drawable(text: str) -> str:
    """Return a text on one line, with the codes of characters that XML has no place for."""
    tame = printable(" ".join(text.split()))
    return _NO_XML.sub(lambda result: f"U+{ord(result[0]):04X}", tame)


def lines_of(text: str, cells: int) -> list[str]:
    """Return a text in lines of at most so many cells; words that are longer are broken."""
    lines: list[str] = []
    for word in drawable(text).split():
        joined = f"{lines[-1]} {word}" if lines else word
        if lines and cell_len(joined) <= cells:
            lines[-1] = joined
        else:
            lines += chop_cells(word, cells)
    return lines
