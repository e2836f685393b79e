"""Graphs that grow into those of longer paths: what is copied when, and what each path keeps."""

import copy
import gc
import pickle

import networkx as nx

import optipath as op
from optipath.paths.growing_graph import GrowingGraph


def steps(count):
    path, results = op.Source() >> op.Polarizer(), []
    for number in range(count):
        results.append(path)
        path = path >> op.Rotator(0.1 * number)
    return [*results, path]


def test_a_chain_that_nobody_reads_grows_without_a_copy(monkeypatch):
    copies = []
    whole = GrowingGraph._copy
    monkeypatch.setattr(GrowingGraph, "_copy", lambda self: copies.append(self) or whole(self))
    paths = steps(20)
    assert len(copies) == 1, "of the source alone"
    assert [len(path) for path in paths] == [*range(2, 23)]
    assert len(copies) == 1
    assert [*paths[3]] == ["source", "polarizer", "rotator", "rotator-2", "rotator-3"]
    assert len(copies) == 2


def test_each_path_keeps_what_it_was_whoever_grows_changes_or_goes():
    paths = steps(6)
    named = [[*map(str, path.nodes)] for path in steps(6)]
    paths[-1].replace("polarizer", op.Polarizer(0.5))
    paths[2].add("spare", op.Mirror())
    del paths[4], paths[0]
    gc.collect()
    paths[1].remove("spare")
    expected = [*named[1:4], *named[5:]]
    for path, names in zip(paths, expected, strict=True):
        for again in (path, copy.copy(path), copy.deepcopy(path), pickle.loads(pickle.dumps(path))):
            assert [*again] == names
            assert again == path
            assert nx.is_path(path.graph, names)
    assert all(path.element("polarizer") == op.Polarizer() for path in paths[:-1])
    assert paths[-1].element("polarizer") == op.Polarizer(0.5)


def test_paths_that_grow_out_of_one_are_apart():
    trunk = (op.Source() >> op.Polarizer()) >> op.Rotator(0.3)
    ends = [
        trunk >> op.Detector(),
        trunk >> op.Dump(),
        trunk >> op.Attenuator(0.5) >> op.Detector(),
    ]
    assert [[*end][3:] for end in ends] == [["detector"], ["dump"], ["attenuator", "detector"]]
    assert [*trunk] == ["source", "polarizer", "rotator"]
    view = trunk.graph
    trunk.add("more", op.Detector())
    trunk.connect("rotator", "more")
    assert [*view] == [*trunk] == ["source", "polarizer", "rotator", "more"]
    assert all("more" not in end for end in ends)
