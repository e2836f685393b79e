"""Rings and networks out of which next to no light gets: splitters, wave plates, turns, losses."""

from itertools import islice

import numpy as np

import optipath as op
from paths import composable

PLATES = {
    "nothing": (),
    "a turn": (op.Rotator(0.3),),
    "a turn and back": (op.Rotator(0.3), op.Rotator(-0.3)),
    "a half-wave plate": (op.Retarder(np.pi, np.pi / 8),),
    "a wave plate and back": (op.Retarder(1.0, 0.2), op.Retarder(-1.0, 0.2)),
    "three wave plates": tuple(op.Retarder(2.0, angle) for angle in (0.1, 1.0, 2.0)),
    "an absorber": (op.Attenuator(1.0 - 3e-15), op.Retarder(np.pi / 2, 0.4)),
    "a polariser": (op.Rotator(1e-9), op.Polarizer(0.7, 0.0, 1.0, 0.3)),
}


def ring(leaves, state, elements=(), turned=0.0):
    """A lamp, a place where light meets, some elements, and a splitter that lets little out."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, state))
    path.add("turn", op.Rotator(turned))
    path.add("join", op.Combiner())
    path.connect("lamp.out", "turn.in")
    path.connect("turn.out", "join.in")
    path.add("split", op.BeamSplitter(leaves))
    before = "join.out"
    for number, element in enumerate(elements):
        path.add(f"e{number}", element)
        path.connect(before, f"e{number}.in")
        before = f"e{number}.out"
    path.connect(before, "split.in")
    path.connect("split.transmitted", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.reflected", "eye.in")
    return path


class Network:
    """Draws a network of splitters and interfaces, out of which a drawn share leaves at most."""

    def __init__(self, seed):
        self.rng = np.random.default_rng([seed, 7])
        self.leaves = 10.0 ** self.rng.uniform(-16, -1)
        self.path = op.PathGraph(loops="sum")
        nodes = [f"n{i}" for i in range(self.rng.integers(1, 5))]
        for name in nodes:
            self.path.add(name, self.node())
        enters = self.shuffled(nodes, ("in", "back"))
        leaves = self.shuffled(nodes, ("reflected", "transmitted"))
        sources = int(self.rng.integers(1, len(nodes) + 1))
        for i in range(sources):
            self.path.add(f"s{i}", op.Source(self.rng.uniform(0.5, 2), [1, *self.state()]))
            self.path.add(f"d{i}", op.Detector())
            self.path.connect(f"s{i}.out", enters[i])
            self.path.connect(leaves[i], f"d{i}.in")
        for i, (start, end) in enumerate(zip(leaves[sources:], enters[sources:], strict=True)):
            before = start
            for j in range(self.rng.integers(0, 3)):
                self.path.add(f"w{i}-{j}", self.plate())
                self.path.connect(before, f"w{i}-{j}.in")
                before = f"w{i}-{j}.out"
            self.path.connect(before, end)

    def shuffled(self, nodes, ports):
        return list(self.rng.permutation([f"{node}.{port}" for node in nodes for port in ports]))

    def state(self):
        drawn = self.rng.normal(size=3)
        length = (1 - 1e-15) * self.rng.choice([1.0, self.rng.random()])
        return length * drawn / np.linalg.norm(drawn)

    def node(self):
        share = self.leaves * self.rng.uniform(0.3, 1)
        turn = float(self.rng.choice([0.0, self.rng.uniform(-3, 3)]))
        match self.rng.integers(6):
            case 0 | 1:
                return op.BeamSplitter(share, turn)
            case 2 | 3:
                return op.BeamSplitter(1.0 - share, turn)
            case 4:
                return op.BeamSplitter(self.rng.uniform(0.02, 0.98), turn)
        return op.Interface(self.rng.uniform(1.01, 2.5), self.rng.uniform(0, 1.5))

    def plate(self):
        angle = float(self.rng.choice([0.0, np.pi / 4, np.pi / 8, self.rng.uniform(-3, 3)]))
        match self.rng.integers(6):
            case 0 | 1:
                return op.Rotator(angle * self.rng.choice([1.0, 1e-8]))
            case 2 | 3:
                retardance = self.rng.choice([np.pi, np.pi / 2, self.rng.uniform(-3, 3)])
                return op.Retarder(float(retardance), angle)
            case 4:
                return op.Attenuator(1.0 - self.leaves * self.rng.uniform(0.1, 1))
        return op.Polarizer(angle)


def networks(count, first=0):
    """Yield networks that can be composed: all of each is lit."""
    return islice(composable(Network, first), count)
