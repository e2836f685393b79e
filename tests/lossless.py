"""Random networks in which no light gets lost: interfaces, beam splitters, wave plates."""

from itertools import islice

import numpy as np

import optipath as op
from paths import composable


class Network:
    """Draws a network of four-port elements whose every port is linked, from a seed."""

    def __init__(self, seed, size, sources):
        self.rng = np.random.default_rng(seed)
        self.path = op.PathGraph(loops="sum")
        nodes = [self.node(f"n{i}") for i in range(size)]
        enters = self.shuffled(f"{name}.{port}" for name in nodes for port in ("in", "back"))
        leaves = self.shuffled(
            f"{name}.{port}" for name in nodes for port in ("reflected", "transmitted")
        )
        self.emitted = 0.0
        for i in range(sources):
            intensity = self.rng.uniform(0.5, 2)
            self.emitted += intensity
            self.path.add(f"s{i}", op.Source(intensity, [1, *self.rng.uniform(-0.5, 0.5, 3)]))
            self.link(f"s{i}.out", enters[i])
            self.path.add(f"d{i}", op.Detector() if i == 0 else op.Dump())
            self.link(leaves[i], f"d{i}.in")
        for i, (start, end) in enumerate(zip(leaves[sources:], enters[sources:], strict=True)):
            if self.rng.random() < 0.5:
                self.link(start, end)
            else:
                self.path.add(f"w{i}", self.plate())
                self.link(start, f"w{i}.in")
                self.link(f"w{i}.out", end)

    def shuffled(self, names):
        return list(self.rng.permutation(list(names)))

    def node(self, name):
        angle = self.rng.uniform(0, np.pi / 2)
        if self.rng.random() < 0.4:
            self.path.add(name, op.BeamSplitter(self.rng.uniform(0.02, 0.98)))
        else:
            n, outside = self.rng.uniform(1, 2.5, 2)
            self.path.add(name, op.Interface(n, angle, outside))
        return name

    def plate(self):
        if self.rng.random() < 0.5:
            return op.Rotator(self.rng.uniform(-3, 3))
        return op.Retarder(self.rng.uniform(-3, 3), self.rng.uniform(-3, 3))

    def link(self, start, end):
        turn = self.rng.uniform(-3, 3) if self.rng.random() < 0.3 else None
        self.path.connect(start, end, turn)


def networks(count, first=0, size=(1, 9)):
    """Yield networks that can be composed: all of each is lit."""

    def made(seed):
        rng = np.random.default_rng([seed, 1])
        nodes = int(rng.integers(*size))
        return Network(seed, nodes, int(rng.integers(1, nodes + 1)))

    return islice(composable(made, first), count)
