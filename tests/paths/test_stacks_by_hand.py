"""Random stacks written face by face: right ones are a LayerStack, and wrong ones are refused."""

from dataclasses import replace

import numpy as np
import pytest

import optipath as op

STRAIGHT = [op.Medium(0.1), op.Attenuator(1.0), op.Rotator(0.0), op.Combiner(), op.Retarder(0.0)]
SEEDS = range(40)


class Hand:
    """A stack of random media, whose faces are written in one of several right ways."""

    def __init__(self, seed):
        self.rng = rng = np.random.default_rng(seed)
        self.indices = [1.0, *rng.uniform(1.0, 2.0, rng.integers(1, 5)), 1.0]
        self.theta = float(rng.uniform(0.0, 1.4))
        self.values = {}
        self.faces = []
        for before, behind in zip(self.indices, self.indices[1:], strict=False):
            own = float(np.arcsin(np.sin(self.theta) / before))
            ways = [
                op.Interface(behind, self.theta, outside=before, incidence_in=1.0),
                op.Interface(behind, own, outside=before),
                op.Interface(op.Material(behind), self.given(own), outside=self.given(before)),
            ]
            if self.faces:
                ways.append(op.Interface(behind, op.FOLLOWS, outside=op.FOLLOWS))
            self.faces.append(ways[rng.integers(len(ways))])

    def given(self, value):
        """A constant, an array, or a parameter that is given it."""
        way = self.rng.integers(3)
        if way < 2:
            return (value, np.full(2, value))[way]
        name = f"p{len(self.values)}"
        self.values[name] = value
        return op.Parameter(name)

    def path(self):
        rng, path = self.rng, op.PathGraph(loops="sum")
        path.add("lamp", op.Source())
        light, back = "lamp.out", ""
        for number, face in enumerate(self.faces):
            for place in range(rng.integers(3) if number else 0):
                between = f"between {number}{place}"
                path.add(between, STRAIGHT[rng.integers(len(STRAIGHT))])
                path.connect(light, f"{between}.in")
                light = f"{between}.out"
            path.add(f"face {number}", face)
            path.connect(light, f"face {number}.in")
            if number:
                path.connect(f"face {number}.reflected", back)
            light, back = f"face {number}.transmitted", f"face {number}.back"
        path.add("T", op.Detector())
        path.connect(light, "T.in")
        return path


def traced(hand):
    path = hand.path()
    # A face may be written in another way than the one that they were drawn for.
    return path.trace(**{name: hand.values[name] for name in path.parameters})


@pytest.mark.parametrize("seed", SEEDS)
def test_faces_written_rightly_are_the_stack(seed):
    hand = Hand(seed)
    whole = op.LayerStack(hand.indices, hand.theta).mueller("in", "transmitted").matrix[:, 0]
    light = traced(hand)
    expected = np.broadcast_to(whole, light.stokes.shape)
    np.testing.assert_allclose(light.stokes, expected, rtol=0, atol=2e-14)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("wrong", ["outside", "index", "incidence"])
def test_one_wrong_medium_or_angle_is_refused(seed, wrong):
    hand = Hand(seed)
    # A face that follows another has nothing of its own that could be wrong but its index.
    own = [n for n, face in enumerate(hand.faces) if n and face.outside is not op.FOLLOWS]
    number = hand.rng.choice(own) if own and wrong != "index" else 0
    if not number and wrong != "index":
        pytest.skip("all faces follow")
    face = hand.faces[number]
    change = 1.0 + 10.0 ** hand.rng.uniform(-6, -1)
    if wrong == "incidence":
        angle = (
            hand.theta
            if face.incidence_in is not None
            else np.arcsin(np.sin(hand.theta) / hand.indices[number])
        )
        hand.faces[number] = replace(face, incidence=float(angle / change))
    elif wrong == "outside":
        hand.faces[number] = replace(face, outside=hand.indices[number] * change)
    else:
        hand.faces[0] = replace(face, index=hand.indices[1] * change)
        if len(hand.faces) > 1 and hand.faces[1].outside is op.FOLLOWS:
            before = hand.indices[1]
            hand.faces[1] = replace(hand.faces[1], outside=before)
    with pytest.raises(op.OptipathError, match=r"is lit from n|n sin\(incidence\)"):
        traced(hand)
