"""The drawing of a path: what is cut, what collides, and what it says."""

import re
from itertools import combinations, pairwise, product
from typing import NamedTuple
from xml.etree import ElementTree as ET

import pytest

import optipath as op
from optipath.cli.path_picture import path_picture
from optipath.values.cases import Case

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
        x, y, size, width = (float(one.get(n)) for n in ("x", "y", "font-size", "textLength"))
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
    across = [(t, n) for t, n in product(texts, nodes) if n.overlaps(t) and not n.holds(t)]
    return faults + [text.told for text, _ in across]


def upright_lines(drawn):
    """The straight pieces of a link that leads onwards."""
    ways, x, y = [], 0.0, 0.0
    for piece, told in re.findall(r"([MVCH])([^MVCH]*)", drawn):
        numbers = [float(number) for number in told.split()]
        if piece == "V":
            ways.append(Box(drawn, x - 1, y, x + 1, numbers[0]))
        x = {"V": x, "H": numbers[0]}.get(piece, numbers[-2:][0])
        y = {"H": y}.get(piece, numbers[-1])
    return ways


def texts_of(svg):
    return [text.told for text in page_of(svg)[1]]


def links_of(svg):
    tags = ET.fromstring(svg).iter(f"{SPACE}path")  # noqa: S314 - our own
    return [tag.get("d") for tag in tags if "link" in tag.get("class")]


SOME = ["npgr026", "glass-slab", "ellipsometer-rough", "sky-and-window"]
EVERY = pytest.param(op.preset_names(), marks=pytest.mark.report)


@pytest.mark.parametrize("names", [SOME, EVERY], ids=["some", "every"])
def test_nothing_of_presets_is_cut_or_lies_over_something_else(names):
    for name in names:
        path = op.load_preset(name)
        svg = path_picture(path, name)
        assert faults_of(svg) == [], name
        shown = "".join("".join(texts_of(svg)).split())
        for told in [*path, *path.parameters, *path.cases]:
            assert "".join(told.split()) in shown
        assert len(page_of(svg)[2]) == len(path)
        leaves = sum(text.endswith("leaves the path") for text in texts_of(svg))
        assert len(links_of(svg)) == path.graph.number_of_edges() + leaves


def chain_of(count, name="{}", kind=op.Rotator):
    path = op.PathGraph("a <b> & 'c'")
    nodes = [path.add("lamp", op.Source())]
    nodes += [path.add(name.format(number), kind(0.1)) for number in range(count)]
    nodes.append(path.add("eye", op.Detector()))
    for one, other in pairwise(nodes):
        one >> other
    return path


def test_a_chain_hangs_straight_and_long_texts_in_any_letters_stay_in_their_boxes():
    svg = path_picture(chain_of(60), "chain")
    assert faults_of(svg) == []
    nodes = page_of(svg)[2]
    assert len(nodes) == 62
    assert len({round((node.left + node.right) / 2, 6) for node in nodes}) == 1
    for name in ("偏光子{}", "e\u0301\u0301\u0301{}", "<&>{}", "\u202e{}", "w" * 200 + "{}"):
        svg = path_picture(chain_of(3, name), name)
        assert faults_of(svg) == []
        assert "a <b> & 'c'" in texts_of(svg)
    path = op.PathGraph("word " * 100, {"a" * 90: Case({}), "b": Case({}, note="n" * 500)})
    n = op.Parameter("n" * 120, 1.5, help="h" * 300)
    stack = op.LayerStack([1.0, *[n, 1.0] * 20], incidence=0.5)
    path.add("lamp", op.Source()) >> path.add("pile", stack)
    path["pile.transmitted"] >> path.add("eye", op.Detector())
    svg = path_picture(path, "long")
    assert faults_of(svg) == []
    assert "".join(texts_of(svg)).count("$" + "n" * 30) == 20


def test_a_link_over_several_layers_passes_no_box_and_one_back_is_led_upwards():
    path = op.PathGraph()
    path.add("lamp", op.Source()) >> path.add("split", op.BeamSplitter())
    a, b = (path.add(name, op.Rotator(0.1)) for name in "ab")
    path.add("meet", op.BeamSplitter())
    path["split.reflected"] >> a >> b >> path["meet.in"]
    path["split.transmitted"] >> path["meet.back"]
    path["meet.transmitted"] >> path.add("eye", op.Detector())
    svg = path_picture(path, "ways")
    assert faults_of(svg) == []
    nodes = page_of(svg)[2]
    upright = [upright_lines(drawn) for drawn in links_of(svg)]
    assert not [line for lines in upright for line in lines if any(n.overlaps(line) for n in nodes)]
    assert max(map(len, upright)) == 4
    svg = path_picture(op.load_preset("glass-slab"), "glass-slab")
    (back,) = (drawn for drawn in links_of(svg) if "H" in drawn and drawn.count("V") == 3)
    places = [float(part.split("H")[0]) for part in back.split("V")[1:]]
    assert places[1] < places[2] < places[0]


def test_taps_turns_notes_and_cases_are_told_once_and_all_in_words(tmp_path, run):
    svg = path_picture(op.load_preset("ellipsometer-rough"), "ellipsometer-rough")
    assert 'class="link tap"' in svg
    assert {"out, a tap", "in, turned by -90 deg"} <= {*texts_of(svg)}
    texts = texts_of(path_picture(op.load_preset("npgr026"), "npgr026"))
    assert "7, 8, 9" in texts
    assert sum(text.startswith("X1 is copper") for text in texts) == 1
    assert "parameter" not in texts_of(path_picture(chain_of(1), "bare"))
    root = ET.fromstring(path_picture(op.load_preset("malus"), "malus"))  # noqa: S314 - our own
    assert (root.get("role"), root.find(f"{SPACE}title").text) == ("img", "The path malus")
    assert "| out --> " in root.find(f"{SPACE}desc").text
    cases = ("", "npgr026", "default"), ("--case 8", "npgr026, case 8", "value")
    for case, name, column in cases:
        status, out, _ = run(f"show npgr026 {case} --svg x.svg")
        assert status == 0
        texts = {*texts_of((tmp_path / "x.svg").read_text("utf-8"))}
        assert name in texts
        assert {"default", "value"} & texts == {column}
        heading = next(line for line in out.splitlines() if "range" in line)
        assert heading.split()[:2] == ["parameter", column]
