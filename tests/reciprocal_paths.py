"""Random paths of what is reciprocal, whose light never adds up but where it goes round."""

import optipath as op
from chains import random_chains
from random_paths import Draw, standing_in


class ReciprocalPath(Draw):
    """Draws a path of one source and several detectors, each at the end of one link."""

    def __init__(self, seed):
        super().__init__(seed, arrays=False)
        self.built = op.PathGraph(loops="sum")
        self.media = {}
        self.splitters = []
        self.count = 0

    def path(self):
        """The path: a source, elements that part the light, and detectors."""
        self.built.add("s", op.Source())
        self.media["s.out"] = 1.0
        if self.chance(0.15):
            self.chain("s.out")
        for _ in range(self.rng.integers(1, 9)):
            light = list(self.media)[self.rng.integers(len(self.media))]
            if self.splitters and len(self.media) > 1 and self.chance(0.3):
                self.close_a_loop(light)
            elif self.chance(0.25):
                self.pass_from_behind(light)
            else:
                self.meet(light, self.element())
        for number, light in enumerate(self.media):
            self.built.add(f"d{number}", op.Detector())
            self.built.connect(light, f"d{number}.in", azimuth=self.link_turn())
        self.values = {name: self.values[name] for name in self.built.parameters}
        return self.built

    def link_turn(self):
        return self.turn() if self.chance(0.3) else None

    def name(self):
        self.count += 1
        return f"e{self.count}"

    def meet(self, light, element):
        """Let light meet an element in front, and go on by all its ways out."""
        medium, name = self.media.pop(light), self.name()
        if self.chance(0.2):
            element = op.BeamSplitter(self.number(0.1, 0.9), self.turn())
            self.splitters.append((name, medium))
        element = standing_in(element, medium)
        turn = None if hasattr(element, "azimuth") else self.link_turn()
        self.built.add(name, element)
        self.built.connect(light, f"{name}.in", azimuth=turn)
        for way in sorted({c.leaves for c in element.couplings() if c.enters == "in"}):
            boundary = isinstance(element, op.Interface | op.LayerStack)
            behind = boundary and way == "transmitted"
            medium_there = _real_index(element.index) if behind else medium
            if medium_there is not None:
                self.media[f"{name}.{way}"] = medium_there

    def pass_from_behind(self, light):
        """Let light come to a boundary from behind."""
        medium, name = self.media.pop(light), self.name()
        front = float(self.rng.uniform(1, 2))
        element = op.Interface(medium, self.number(0, 1.5), front, parallel=False)
        if self.chance(0.4):
            layers = [front, self.number(1, 2), medium]
            element = op.LayerStack(layers, self.number(0, 1.5), parallel=False)
        self.built.add(name, element)
        self.built.connect(light, f"{name}.back", azimuth=self.link_turn())
        self.media |= {f"{name}.reflected": front, f"{name}.transmitted": medium}

    def close_a_loop(self, light):
        """Let light come to a splitter from behind that it may come from."""
        name, medium = self.splitters.pop()
        if self.media[light] == medium:
            del self.media[light]
            self.built.connect(light, f"{name}.back", azimuth=self.link_turn())

    def chain(self, light):
        """Let light go along points in space."""
        count = int(self.rng.integers(1, 4))
        points = random_chains(int(self.rng.integers(1 << 30)), count)
        del self.media[light]
        if self.chance(0.5):
            name = self.name()
            self.built.add(name, op.Retarder(self.turn(), self.turn(), self.turn()))
            self.built.connect(light, name)
            light = f"{name}.out"
        for place in range(1, count + 1):
            name = self.name()
            index = complex(self.rng.uniform(0.3, 3), self.rng.uniform(0, 4))
            self.built.add(name, op.SpecularVertex(index, points, place))
            self.built.connect(light, name)
            light = f"{name}.reflected"
        self.media[light] = 1.0


def matrices_there_and_back(path, values):
    """The matrix from the source to each detector, reversed, and that of the reversed path."""
    back = path.reversed()
    for name in path:
        if name.startswith("d"):
            there = path.mueller("s", name, **values)
            yield there.reversed(), back.mueller(name, "s", **values)


def _real_index(index):
    """The index of a medium without absorption; None for one that absorbs."""
    return index if isinstance(index, float) else None
