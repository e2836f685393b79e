"""The box of a node in the drawing of a path: its texts, and where links leave and enter it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from optipath.cli.layer_places import Extent
from optipath.cli.svg_words import add_text, drawable, lines_of, text_width
from optipath.paths.drawing import element_values

if TYPE_CHECKING:
    from collections.abc import Sequence
    from xml.etree.ElementTree import Element as Tag

    from optipath.composer.wiring import Link
    from optipath.elements.element import Element

    Labels: TypeAlias = Sequence[tuple[Link, str]]

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
            (told, y + _OUTLET * (number + 1), _ARROW) for number, told in enumerate(self.outlets)
        ]


def node_box(
    name: str, element: Element, outlets: Sequence[str], leaving: Labels, entering: Labels
) -> NodeBox:
    """Return the box of a node."""
    texts = lines_of(name, _CELLS - 4), lines_of(element.kind, _CELLS)
    values = [line for each in element_values(element) for line in lines_of(each, _CELLS)]
    told = [f"{drawable(port)}: leaves the path" for port in outlets]
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
    beside = [_ARROW + _BESIDE + text_width(one, SMALL) for one in told]
    return NodeBox(
        *texts,
        values,
        "inner" if element.inputs and element.outputs else "end" if element.inputs else "source",
        told,
        below,
        above,
        width,
        max(height, _OUTLET * (len(told) + 1)),
        Extent(width / 2, max(width / 2 + max(beside, default=0.0), *labelled, 0.0)),
    )


def _slots(labels: Labels) -> dict[Link, float]:
    """Return where links stand beside one another, with room for what is written at each."""
    if len(labels) == 1:
        return {labels[0][0]: 0.0}
    rooms = [_BESIDE + text_width(label, SMALL) + _APART for _, label in labels]
    begin = -sum(rooms) / 2
    return {link: begin + sum(rooms[:number]) for number, (link, _) in enumerate(labels)}
