"""networkx graphs of elements: taken as the same path is, given back, or refused in a sentence."""

import json
import random
from contextlib import suppress
from copy import copy

import networkx as nx
import numpy as np
import pytest

import optipath as op
from fuzz.odd_values import NAMES, a_value
from tables import rows


def line(**elements):
    """A graph of elements one behind the other, by way of their natural ports."""
    graph = nx.DiGraph()
    for name, element in elements.items():
        graph.add_node(name, element=element)
    nx.add_path(graph, elements)
    return graph


def malus():
    return line(lamp=op.Source(2.0), filter=op.Polarizer(), eye=op.Detector())


def faults_of(graph):
    with pytest.raises(op.errors.PathError) as composing:
        op.Composer().compose(graph)
    with pytest.raises(op.errors.PathError) as reading:
        op.PathGraph.from_networkx(graph)
    assert composing.value.faults == reading.value.faults
    return composing.value.faults


def in_node(**about):
    return lambda graph: graph.nodes["filter"].update(about)


def in_edge(**about):
    return lambda graph: graph.edges["lamp", "filter"].update(about)


def in_graph(**about):
    return lambda graph: graph.graph.update(about)


def renamed(node, word):
    def change(graph):
        about = graph.nodes[node]
        about[word] = about.pop("element")

    return change


@rows(
    "change, message",
    [
        (renamed("filter", "elemnt"), "node 'filter' has an attribute 'elemnt'; did you mean 'ele"),
        (renamed("filter", "thing"), "node 'filter' has no 'element'; give one"),
        (
            in_node(element=op.Polarizer),
            "node 'filter' must be an element, as Polarizer(), not <cl",
        ),
        (in_node(element="polarizer"), "node 'filter' must be an element, as Polarizer(), not 'po"),
        (in_node(frames=[1]), "frames of 'filter' must be a Frame for each port"),
        (in_node(frames={"inn": op.Frame()}), "frames of 'filter': port 'filter.inn' does not exi"),
        (in_node(frame={"in": op.Frame()}), "has an attribute 'frame'; did you mean 'frames'?"),
        (in_edge(out_port="in"), "edge ('lamp', 'filter'): out_port 'in' is no out-port of 'lamp'"),
        (in_edge(in_port=3), "edge ('lamp', 'filter'): in_port 3 is no in-port of 'filter'"),
        (in_edge(outport="out"), "edge ('lamp', 'filter') has an attribute 'outport'; did you mea"),
        *(
            (in_edge(**{word: "out"}), f"'{word}'; did you mean 'out_port' or 'in_port'?")
            for word in ("port", "from_port", "to_port", "target-port", "inn_port")
        ),
        (in_edge(azimuht=0.1), "did you mean 'azimuth'?"),
        (in_edge(azimuth="red"), "link 'lamp.out -> filter.in' azimuth: 'red' is not a quantity"),
        (in_edge(azimuth=np.nan), "link 'lamp.out -> filter.in' azimuth is nan; give a finite an"),
        (in_edge(azimuth={}), "link 'lamp.out -> filter.in' azimuth must be a real angle"),
        (in_edge(length=-1.0), "link 'lamp.out -> filter.in' length is -1000 mm; give a real len"),
        (in_edge(length="3 deg"), "link 'lamp.out -> filter.in' length"),
        (in_edge(length=op.Parameter("d")), "length cannot be a parameter"),
        (in_edge(tap=1), "link 'lamp.out -> filter.in' tap must be True or False, not 1"),
        (in_edge(tpa=True), "did you mean 'tap'?"),
        (in_graph(loop="sum"), "the graph has an attribute 'loop'; did you mean 'loops'?"),
        (in_graph(loops="som"), "loops 'som' is unknown; did you mean 'sum'?"),
        (in_graph(description=3), "the description of a path must be a text, not 3"),
        (in_graph(cases={"a": 3}), "cases of a path must be a Case for each name"),
        (in_graph(choices={"a": 3}), "choices of a path must be as path.offer makes them"),
        (in_graph(declared="n"), "declared must be a sequence of names"),
        (lambda g: g.add_edge("eye", "filter"), "edge ('eye', 'filter') leads from 'eye', where"),
        (lambda g: g.add_edge("filter", "lamp"), "leads to 'lamp', where light begins"),
        (lambda g: g.add_node(3, element=op.Detector()), "node name 3 must be a text without a do"),
        (lambda g: g.add_node("a.b", element=op.Detector()), "graph, {'a.b': 'a-b'})"),
        (in_node(element=op.BeamSplitter()), "give out_port='reflected' or 'transmitted'"),
    ],
)
def test_what_is_wrong_with_a_graph_is_told_by_node_or_edge_and_attribute(change, message):
    graph = malus()
    change(graph)
    (fault,) = faults_of(graph)
    assert message in fault


def test_nodes_named_by_numbers_are_told_once():
    graph = nx.path_graph(1500, create_using=nx.DiGraph)
    nx.set_node_attributes(graph, op.Polarizer(), "element")
    (fault,) = faults_of(graph)
    assert fault == (
        "node name 0, as 1,499 others, must be a text without a dot; rename it, "
        "nx.relabel_nodes(graph, str)"
    )
    assert len(op.PathGraph.from_networkx(nx.relabel_nodes(graph, str))) == 1500


def test_all_that_is_wrong_is_told_at_once():
    graph = malus()
    for change in (renamed("lamp", "elemnt"), in_edge(azimuht=1), in_node(frames=2)):
        change(graph)
    assert len(faults_of(graph)) == 3


@rows(
    "graph, message",
    [
        (nx.Graph(malus()), "a networkx Graph has no directions; build an nx.MultiDiGraph or nx"),
        (nx.MultiGraph(), "a networkx MultiGraph has no directions"),
        (malus().to_undirected(), "a networkx Graph has no directions"),
    ],
)
def test_a_graph_without_directions_is_refused_with_the_cure(graph, message):
    assert message in faults_of(graph)[0]


def test_what_is_no_graph_is_refused():
    for other in (3, None, "graph", {}, op.Polarizer()):
        with pytest.raises(op.errors.PathError, match="made of a networkx graph"):
            op.PathGraph.from_networkx(other)
        with pytest.raises(op.OptipathError, match="MultiDiGraph is composed"):
            op.Composer().compose(other)


def test_attributes_of_others_are_kept_and_say_nothing():
    graph = malus()
    graph.graph |= {"name": "Malus", 3: 4, "self": 5}
    for about in (*graph.nodes.values(), *graph.edges.values()):
        about |= {
            "color": "red",
            "weight": 2.0,
            "pos": np.zeros(2),
            "label": "x",
            3: 4,
            "tag": 1,
            "key": 1,
            "attr": 2,
            "transport": 3,
            "port_of_call": 4,
        }
    path = op.PathGraph.from_networkx(graph)
    there_again = path.to_networkx()
    assert there_again.graph["name"] == "Malus"
    assert there_again.nodes["eye"]["color"] == "red"
    assert there_again.edges["lamp", "filter", 0]["weight"] == 2.0
    assert path.trace() == op.Composer().compose(graph).run() == op.Light([1.0, 1.0, 0.0, 0.0])
    for other in (copy(path), path.bind(), path.reading("intensity"), path.reversed()):
        assert other.to_networkx().graph["name"] == "Malus"
    path.remove("eye")
    assert (path >> op.Attenuator(0.5)).nodes["filter"]["color"] == "red"
    assert path.to_networkx(text=True).nodes["filter"]["pos"] == "array([0., 0.])"


def test_every_preset_comes_back_from_networkx():
    for name in op.preset_names():
        path = op.load_preset(name)
        assert op.PathGraph.from_networkx(path.to_networkx()) == path, name


def test_a_graph_and_the_path_made_of_it_change_apart():
    path = op.load_preset("npgr026", case=7)
    path.replace("P", op.Polarizer())
    path.add("spare", op.Rotator(0.1), frames={"in": op.Frame()})
    graph = path.to_networkx()
    other = op.PathGraph.from_networkx(graph)
    graph.nodes["spare"]["frames"]["out"] = op.Frame().turned(0.3)
    graph.nodes["P"]["element"] = op.Mirror()
    graph.graph["choices"].clear()
    graph.graph["cases"].clear()
    graph.edges["L", "P", 0]["azimuth"] = 0.3
    assert path == other
    assert path.choices
    assert path.cases


def test_a_choice_that_does_not_fit_is_named():
    graph = nx.relabel_nodes(op.load_preset("npgr026").to_networkx(), {"L": "lamp"})
    with pytest.raises(op.errors.PathError, match="choice 'place': place 'light': node 'L'"):
        op.PathGraph.from_networkx(graph)


def test_lengths_of_links_are_kept_in_metres_and_change_no_light():
    graph = malus()
    in_edge(length="5 mm", azimuth="30 deg", tap=np.False_)(graph)
    there_again = op.PathGraph.from_networkx(graph).to_networkx()
    about = there_again.edges["lamp", "filter", 0]
    assert about == {
        "out_port": "out",
        "in_port": "in",
        "length": 0.005,
        "azimuth": np.radians(30.0),
    }
    assert nx.shortest_path_length(there_again, "lamp", "filter", weight="length") == 0.005
    assert op.Composer().compose(graph).run() == op.Light([1.0, 1.0, 0.0, 0.0])


def test_the_graph_of_a_path_is_taken_with_edges_that_networkx_adds():
    path = op.Source() >> op.BeamSplitter().named("bs")
    graph = path.graph.copy()
    graph.add_node("eye", element=op.Detector())
    graph.add_edge("bs", "eye", out_port="transmitted")
    (end,) = op.Composer().compose(graph).run_all()
    assert end == "eye"
    path.add("eye", op.Detector())
    path.connect("bs.transmitted", "eye")
    assert op.PathGraph.from_networkx(graph) == path


def test_a_path_whose_ports_are_said_has_other_attributes_like_them():
    graph = malus()
    in_edge(out_port="out", in_port="in", outport=3, port=4)(graph)
    path = op.PathGraph.from_networkx(graph)
    for again in (path.graph, path.to_networkx()):
        assert op.PathGraph.from_networkx(again) == path


def test_texts_of_arrays_of_names_go_into_graphml():
    graph = malus()
    nx.set_node_attributes(graph, dict(zip(graph, np.array(["a", "b", "c"]), strict=True)), "group")
    text = op.PathGraph.from_networkx(graph).to_networkx(text=True)
    read = nx.parse_graphml("\n".join(nx.generate_graphml(text)))
    assert [*read.nodes(data="group")] == [("lamp", "a"), ("filter", "b"), ("eye", "c")]


def test_a_second_link_between_two_ports_is_refused():
    graph = nx.MultiDiGraph(malus())
    graph.add_edge("lamp", "filter", out_port="out")
    assert faults_of(graph) == (
        "link 'lamp.out -> filter.in' is there already; remove the second one",
    )


def test_views_of_nodes_and_links_are_as_networkx_has_them():
    path = op.PathGraph.from_networkx(malus())
    assert path.nodes["filter"]["element"] == op.Polarizer()
    assert next(iter(path.nodes(data="element"))) == ("lamp", op.Source(2.0))
    links = [("lamp", "filter", ("out", "in")), ("filter", "eye", ("out", "in"))]
    assert [*path.edges(keys=True)] == links
    assert [tap for *_, tap in path.edges(data="tap")] == [False, False]
    assert len(path) == len(path.nodes) == 3
    assert "filter" in path
    assert [*path] == [*path.nodes]
    with pytest.raises(nx.NetworkXError, match="Frozen"):
        path.graph.add_node("other")


def test_texts_of_a_path_go_into_graphml_and_json_and_back(tmp_path):
    for name in op.preset_names():
        graph = op.load_preset(name).to_networkx(text=True)
        nx.write_graphml(graph, tmp_path / "path.graphml")
        read = nx.read_graphml(tmp_path / "path.graphml", force_multigraph=True)
        assert dict(read.nodes(data=True)) == dict(graph.nodes(data=True)), name
        assert [*read.edges(data=True)] == [*graph.edges(data=True)], name
        about = nx.node_link_graph(json.loads(json.dumps(nx.node_link_data(graph))))
        assert dict(about.nodes(data=True)) == dict(graph.nodes(data=True)), name
    about = op.load_preset("npgr026").to_networkx(text=True).nodes["X1"]
    assert about == {
        "element": "interface",
        "index": "$n1 + $k1 i",
        "incidence": "$delta",
        "azimuth": "-$rho",
    }


def random_graph(seed):
    """A directed graph of a generator of networkx, of elements by texts, some ports left out."""
    rng = random.Random(seed)  # noqa: S311 - reproducible
    count = rng.randrange(2, 9)
    makers = [
        lambda: nx.gnp_random_graph(count, 0.3, directed=True, seed=seed),
        lambda: nx.gn_graph(count, seed=seed),
        lambda: nx.scale_free_graph(count, seed=seed),
        lambda: nx.path_graph(count, create_using=nx.MultiDiGraph),
        lambda: nx.balanced_tree(2, 2, create_using=nx.DiGraph),
        lambda: nx.grid_2d_graph(2, 3, create_using=nx.DiGraph),
        lambda: nx.DiGraph([(u, v) for u, v in nx.gnp_random_graph(count, 0.5, seed=seed).edges]),
        lambda: nx.reverse_view(nx.gnr_graph(count, 0.3, seed=seed)),
    ]
    graph = nx.relabel_nodes(rng.choice(makers)(), str)
    graph = graph.copy()
    graph.graph = {"loops": "sum"} if rng.random() < 0.7 else {}
    middle = [
        op.Polarizer(0.3),
        op.Rotator(0.2),
        op.BeamSplitter(),
        op.Interface(1.5, 0.4),
        op.Combiner(),
        op.Mirror(),
        op.Attenuator(0.5),
        op.Retarder(op.Parameter("r", 0.4), azimuth=0.2),
    ]
    for name, about in graph.nodes.items():
        enters, leaves = graph.in_degree(name), graph.out_degree(name)
        about["element"] = rng.choice(middle)
        if not enters or not leaves:
            about["element"] = op.Detector() if enters else op.Source()
    taken = set()
    for *edge, about in graph.edges(data=True):
        about.clear()
        ends = [graph.nodes[name]["element"] for name in edge[:2]]
        choices = [port for port in ends[0].outputs if (edge[0], port) not in taken]
        leaves, enters = rng.choice(choices or ["out"]), rng.choice(ends[1].inputs or ["in"])
        taken.add((edge[0], leaves))
        if leaves != ends[0].natural or rng.random() < 0.5:
            about["out_port"] = leaves
        if rng.random() < 0.5 or "in" not in ends[1].inputs:
            about["in_port"] = enters
        if rng.random() < 0.3:
            about["azimuth"] = rng.choice([0.3, "20 deg", op.Parameter("a", 0.1), 1])
        if rng.random() < 0.1:
            about["tap"] = True
    return graph


def built(graph):
    """The path that is made of a graph by hand."""
    path = op.PathGraph(**graph.graph)
    for name, about in graph.nodes.items():
        path.add(name, about["element"])
    for start, end, about in graph.edges(data=True):
        ends = start, end
        names = [
            f"{n}.{p}" if (p := about.get(k)) else n
            for n, k in zip(ends, ("out_port", "in_port"), strict=True)
        ]
        path.connect(*names, about.get("azimuth"), tap=about.get("tap", False))
    return path


def outcome(compose):
    """The light at every end, to the last bit, or the sentences of a refusal."""
    try:
        return {name: light.stokes.tobytes() for name, light in compose().run_all().items()}
    except op.OptipathError as fault:
        return fault.faults


def test_graphs_of_generators_compose_to_what_the_same_path_does():
    composed = 0
    for seed in range(300):
        graph = random_graph(seed)
        got = outcome(lambda graph=graph: op.Composer().compose(graph))
        try:
            path = built(graph)
        except op.OptipathError:
            assert isinstance(got, tuple), seed  # Refused by its ports, in other words.
            continue
        assert got == outcome(path.compose), seed
        assert op.PathGraph.from_networkx(graph) == path
        composed += isinstance(got, dict)
    assert composed > 50


def mutilated(rng):
    """A graph in which one to three attributes are missing, misspelt or of another type."""
    graph = nx.MultiDiGraph(random_graph(rng.randrange(300)))
    places = [graph.graph, *graph.nodes.values(), *graph.edges.values()]
    for _ in range(rng.randrange(1, 4)):
        about = rng.choice(places)
        known = [
            *about,
            "frames",
            "element",
            "azimuth",
            "tap",
            "length",
            "in_port",
            "loops",
            "cases",
        ]
        word = rng.choice(known)
        match rng.randrange(4):
            case 0:
                about.pop(word, None)
            case 1:
                at = rng.randrange(len(word))
                about[word[:at] + rng.choice(["", "x", word[at] * 2]) + word[at + 1 :]] = about.pop(
                    word, 1
                )
            case _:
                with suppress(Exception):  # Not all of them are values.
                    about[word] = eval(a_value(rng), dict(NAMES))  # noqa: S307 - our own texts
    if rng.random() < 0.1:
        graph.add_node(rng.choice([3, (1, 2), "", "a.b", 0.5, frozenset()]), element=op.Polarizer())
    return graph


@pytest.mark.filterwarnings("ignore")
def test_mutilated_graphs_are_taken_or_refused_in_a_sentence():
    rng = random.Random(7)  # noqa: S311 - reproducible
    for _ in range(500):
        graph = mutilated(rng)
        for read in (op.PathGraph.from_networkx, op.Composer().compose):
            with suppress(op.errors.PathError):
                read(graph)
