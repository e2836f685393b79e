"""What is in the drawing of a path: the boxes of its texts and nodes, and which of them collide."""

from itertools import combinations
from typing import NamedTuple
from xml.etree import ElementTree as ET

SPACE = "{http://www.w3.org/2000/svg}"


class Box(NamedTuple):
    """A rectangle, and what it is of."""

    told: str
    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other):
        """Whether two boxes share more than an edge."""
        across = self.left < other.right - 0.01 and other.left < self.right - 0.01
        return across and self.top < other.bottom - 0.01 and other.top < self.bottom - 0.01

    def holds(self, other):
        """Whether another box is within this one."""
        across = self.left <= other.left and other.right <= self.right
        return across and self.top <= other.top and other.bottom <= self.bottom


def page_of(svg):
    """The page, the boxes of its texts, and those of its nodes."""
    root = ET.fromstring(svg)  # noqa: S314 - our own
    page = Box("page", 0.0, 0.0, float(root.get("width")), float(root.get("height")))
    texts, nodes = [], []
    for one in root.iter(f"{SPACE}text"):
        x, y, size = (float(one.get(name)) for name in ("x", "y", "font-size"))
        width = float(one.get("textLength"))
        texts.append(Box(one.text, x, y - 0.8 * size, x + width, y + 0.2 * size))
    for one in root.iter(f"{SPACE}rect"):
        if one.get("x") is not None:
            x, y, width, height = (float(one.get(name)) for name in ("x", "y", "width", "height"))
            nodes.append(Box("node", x, y, x + width, y + height))
    return page, texts, nodes


def faults_of(svg):
    """What leaves the page, and what lies over something else, by its texts."""
    page, texts, nodes = page_of(svg)
    faults = [box.told for box in (*texts, *nodes) if not page.holds(box)]
    for group in (texts, nodes):
        faults += [(a.told, b.told) for a, b in combinations(group, 2) if a.overlaps(b)]
    faults += [
        text.told
        for text in texts
        for node in nodes
        if node.overlaps(text) and not node.holds(text)
    ]
    return faults
