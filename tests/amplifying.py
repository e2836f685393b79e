"""Loops of elements that amplify, of any diattenuation and depolarisation, and their radius."""

from itertools import islice

import numpy as np
from mpmath import mp

import optipath as op
from paths import composable

_TO_STOKES = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [0, 1, 1, 0], [0, 1j, -1j, 0]])


def of_jones(matrix):
    """The Mueller matrix of a Jones matrix."""
    both = np.kron(matrix, np.conj(matrix))
    return (_TO_STOKES @ both @ np.linalg.inv(_TO_STOKES)).real


def drawn(rng, gain):
    """A Mueller matrix that light allows, whose best polarised light is amplified by a gain."""
    several = rng.normal(size=(2, 2, 2)) + 1j * rng.normal(size=(2, 2, 2))
    several = [of_jones(one / np.linalg.norm(one, 2)) for one in several]
    return gain * (several[0] if rng.random() < 0.6 else 0.5 * (several[0] + several[1]))


def ring(matrix, state=(1.0, 0.3, 0.4, 0.5)):
    """A lamp, a place where light meets, an amplifier, and a splitter that lets half of it out."""
    path = op.PathGraph(loops="sum")
    path.add("lamp", op.Source(1.0, list(state))) >> path.add("join", op.Combiner())
    path.add("amplifier", op.MuellerElement(2.0 * np.asarray(matrix), physical=False))
    path.add("split", op.BeamSplitter(0.5))
    path.connect("join.out", "amplifier.in")
    path.connect("amplifier.out", "split.in")
    path.connect("split.transmitted", "join.in")
    path.add("eye", op.Detector())
    path.connect("split.reflected", "eye.in")
    return path


def radius(matrix):
    """The spectral radius of what comes back each time, in 50 digits."""
    with mp.workdps(50):
        values, _ = mp.eig(mp.matrix(matrix.tolist()))
        return float(max(abs(value) for value in values))


class Network:
    """Draws a network of splitters with amplifiers between them, and its matrix of a round trip."""

    def __init__(self, seed):
        self.rng = np.random.default_rng([seed, 11])
        nodes = [f"n{i}" for i in range(self.rng.integers(1, 4))]
        self.path = op.PathGraph(loops="sum")
        self.shares = {node: self.rng.uniform(0.05, 0.95) for node in nodes}
        for node, share in self.shares.items():
            self.path.add(node, op.BeamSplitter(share))
        enters = self.shuffled(nodes, ("in", "back"))
        leaves = self.shuffled(nodes, ("reflected", "transmitted"))
        self.links = {}
        sources = int(self.rng.integers(1, len(nodes) + 1))
        for i in range(sources):
            self.path.add(f"s{i}", op.Source(1.0, [1, *self.rng.uniform(-0.5, 0.5, 3)]))
            self.path.add(f"d{i}", op.Detector())
            self.path.connect(f"s{i}.out", enters[i])
            self.path.connect(leaves[i], f"d{i}.in")
        for i, (start, end) in enumerate(zip(leaves[sources:], enters[sources:], strict=True)):
            matrix = drawn(self.rng, self.rng.uniform(0.3, 2.5))
            self.path.add(f"w{i}", op.MuellerElement(matrix, physical=False))
            self.path.connect(start, f"w{i}.in")
            self.path.connect(f"w{i}.out", end)
            self.links[start] = end, matrix

    def shuffled(self, nodes, ports):
        return list(self.rng.permutation([f"{node}.{port}" for node in nodes for port in ports]))

    def radius(self):
        """The spectral radius: of what light at each in-port brings to all of them."""
        places = [f"{node}.{port}" for node in self.shares for port in ("in", "back")]
        whole = np.zeros((4 * len(places), 4 * len(places)))
        mirrored = np.diag([1.0, 1.0, -1.0, -1.0])
        for column, place in enumerate(places):
            node, _, enters = place.partition(".")
            share = self.shares[node]
            back, on = ("reflected", "transmitted")[:: 1 if enters == "in" else -1]
            for port, made in ((back, share * mirrored), (on, (1 - share) * np.eye(4))):
                if f"{node}.{port}" in self.links:
                    end, matrix = self.links[f"{node}.{port}"]
                    row = places.index(end)
                    block = np.s_[4 * row : 4 * row + 4, 4 * column : 4 * column + 4]
                    whole[block] += matrix @ made
        return float(np.abs(np.linalg.eigvals(whole)).max())


def networks(count, first=0):
    """Yield networks that can be composed: all of each is lit."""
    return islice(composable(Network, first), count)
