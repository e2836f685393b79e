"""Graphs of paths are read by networkx, and changed by nobody but their paths."""

import copy
import pickle

import networkx as nx
import pytest

import optipath as op
from tables import rows

LINK = "X2", "X1", ("reflected", "in")
PATH = op.load_preset("npgr026", case=7)


@rows(
    "write",
    [
        lambda path: path.nodes["P"].__setitem__("element", op.Attenuator(0.5)),
        lambda path: path.graph.nodes["P"].__setitem__("color", "red"),
        lambda path: path.nodes["P"].update(element=op.Attenuator(0.5)),
        lambda path: path.nodes["P"].update({"element": op.Attenuator(0.5)}),
        lambda path: path.nodes["P"].__ior__({"element": op.Attenuator(0.5)}),
        lambda path: path.nodes["P"].pop("element"),
        lambda path: path.nodes["P"]["frames"].__setitem__("in", op.Frame()),
        lambda path: path.edges[LINK].__setitem__("azimuth", 0.1),
        lambda path: path.graph["X2"]["X1"][LINK[2]].setdefault("length", 1.0),
        lambda path: path.graph.pred["X1"]["X2"][LINK[2]].clear(),
        lambda path: path.graph.graph.__setitem__("loops", "sum"),
        lambda path: path.graph.subgraph(["P", "X2"]).nodes["P"].popitem(),
        lambda path: nx.set_node_attributes(path.graph, op.Polarizer(), "element"),
        lambda path: nx.set_edge_attributes(path.graph, 0.1, "azimuth"),
    ],
)
def test_no_attribute_is_written_behind_the_back_of_a_path_whatever_it_is_made_of(write):
    made = [PATH.bind(n1=1.2), PATH.with_defaults(n1=1.2), PATH.reading("intensity")]
    made += [op.PathGraph.from_networkx(PATH.to_networkx()), copy.copy(PATH), copy.deepcopy(PATH)]
    for path in (PATH, *made, pickle.loads(pickle.dumps(PATH))):
        before = path.to_toml()
        with pytest.raises(op.errors.PathError, match=r"read-only; .* path\.replace\(\.\.\.\), or"):
            write(path)
        assert path.to_toml() == before


def test_reversed_paths_and_those_that_grow_are_read_only_too():
    path = op.Source() >> op.Polarizer() >> op.Detector()
    path.insert("more", op.Rotator(0.2), behind="polarizer")
    path.replace("more", op.Rotator(0.3))
    for each in (path, path.reversed(), op.Source() >> op.Rotator(0.1) >> op.Polarizer()):
        for name in each:
            with pytest.raises(op.errors.PathError, match="read-only"):
                each.nodes[name]["element"] = op.Polarizer()
        for link in each.edges:
            with pytest.raises(op.errors.PathError, match="read-only"):
                each.edges[link]["tap"] = True


def test_copies_that_networkx_makes_are_anybodys_to_change():
    graph, before = PATH.graph, PATH.to_toml()
    made = [graph.copy(), nx.MultiDiGraph(graph), nx.DiGraph(graph), PATH.to_networkx()]
    made += [graph.to_undirected(), graph.reverse(), graph.subgraph(["P", "X2"]).copy()]
    made += [nx.relabel_nodes(graph, {"P": "filter"}), nx.compose(graph, nx.MultiDiGraph())]
    made.append(nx.contracted_nodes(graph, "P", "X2"))
    for each in made:
        assert len(each) > 1
        for about in (each.graph, *each.nodes.values(), *each.edges.values()):
            about["color"] = "red"
            assert about.pop("color") == "red"
        for node in each.nodes.values():
            node["element"] = op.Polarizer()
    assert PATH.to_toml() == before
    assert type(graph) is nx.MultiDiGraph
    assert nx.is_frozen(graph)
