"""Random paths of all elements, with constants, arrays and parameters among their values."""

from dataclasses import replace

import numpy as np

import optipath as op


class Draw:
    """Draws a path and the values of its parameters from a seed; without arrays, one path."""

    def __init__(self, seed, *, arrays=True):
        self.rng = np.random.default_rng(seed)
        self.arrays = arrays
        self.values = {}

    def chance(self, share):
        return self.rng.random() < share

    def number(self, low, high):
        """A constant, an array, or a parameter that is given either."""
        drawn = float(self.rng.uniform(low, high))
        if self.chance(0.2):
            drawn = float(self.rng.choice([low, high, (low + high) / 2]))
        if self.chance(0.6):
            return drawn
        if self.chance(0.4):
            return self.rng.uniform(low, high, 3) if self.arrays else drawn
        name = f"p{len(self.values)}"
        many = self.chance(0.5) and self.arrays
        self.values[name] = self.rng.uniform(low, high, 3) if many else drawn
        return op.Parameter(name)

    def turn(self):
        if self.chance(0.3):
            return 0.0
        if self.chance(0.4):
            return float(self.rng.choice([np.pi / 4, np.pi / 2, np.pi]))
        return self.number(-3, 3)

    def index(self):
        if self.chance(0.3):
            return op.Material(self.number(0.3, 3), self.number(0, 3))
        n, k = self.rng.uniform(0.3, 3), self.rng.uniform(0, 4)
        return float(n) if self.chance(0.5) else complex(n, k)

    def matrix(self):
        if self.chance(0.5):
            foil = np.diag([1.0, *self.rng.uniform(0, 1, 3)])
            physical = op.Mueller(foil).nearest_physical().matrix
            return physical / max(1.0, physical[0, 0] + np.linalg.norm(physical[0, 1:]))
        return op.Polarizer(0.0, 0.0, float(self.rng.uniform(0.3, 1)), 0.2).mueller().matrix

    def element(self):
        match self.rng.integers(14):
            case 0 | 1 | 2:
                incidence, outside = self.number(0, np.pi / 2), float(self.rng.choice([1.0, 1.5]))
                return op.Interface(self.index(), incidence, outside, self.turn())
            case 3:
                ideal = self.chance(0.5)
                leaks = () if ideal else (self.number(0, 1), self.number(0, 1))
                return op.Polarizer(self.turn(), self.turn(), *leaks)
            case 4:
                return op.Rotator(self.turn())
            case 5:
                return self.retarder()
            case 6:
                return op.Attenuator(self.number(0, 1))
            case 7:
                return op.MuellerElement(self.matrix(), azimuth=self.turn())
            case 8:
                return op.Mirror(self.amplitude(), self.amplitude(), self.turn())
            case 9:
                return self.diattenuator()
            case 10:
                return op.Depolarizer(self.number(0, 1))
            case 11:
                return self.medium()
            case 12:
                layers = [self.number(1, 2.5) for _ in range(self.rng.integers(1, 4))]
                lossy = {}
                if isinstance(layers[0], float) and int(1e6 * layers[0]) % 2:
                    layers[0] += 1e-5j
                    lossy = {"lengths": [1e-3] * len(layers), "wavelength": 550e-9}
                indices = [1.0, *layers, self.index()]
                return op.LayerStack(indices, self.number(0, 1.5), self.turn(), **lossy)
        return op.BeamSplitter(float(self.rng.uniform(0, 1)), self.turn())

    def retarder(self):
        if self.chance(0.3):
            return op.EllipticalRetarder(*(self.number(-3, 3) for _ in range(3)), self.turn())
        return op.Retarder(self.turn(), self.turn(), self.turn())

    def diattenuator(self):
        transmittances = self.number(0, 1), self.number(0, 1)
        if self.chance(0.3):
            return op.CircularDiattenuator(*transmittances)
        return op.Diattenuator(*transmittances, self.turn(), self.turn())

    def amplitude(self):
        """A constant, an array, or a parameter; real, or of any phase."""
        if self.chance(0.4):
            return self.number(-1, 1)
        drawn = self.rng.uniform(0, 1, 3) * np.exp(1j * self.rng.uniform(-3, 3, 3))
        drawn = drawn if self.chance(0.4) and self.arrays else complex(drawn[0])
        if self.chance(0.7):
            return drawn
        name = f"p{len(self.values)}"
        self.values[name] = drawn
        return op.Parameter(name)

    def medium(self):
        if self.chance(0.4):
            return self.general_medium()
        length, absorption = self.number(0, 0.1), self.number(0, 30)
        either = (self.number(-40, 40), 0.0)
        turns, retardance = either if self.chance(0.5) else either[::-1]
        rates = {
            "retardance": retardance,
            ("rotation", "dextrorotation")[len(self.values) % 2]: turns,
        }
        return op.Medium(length, absorption, angle=self.turn(), azimuth=self.turn(), **rates)

    def general_medium(self):
        """One whose dichroism is never more than its absorption."""
        length, absorption = self.number(0, 0.1), self.number(20, 30)
        names = "dichroism", "circular_dichroism", "retardance", "rotation", "depolarization"
        ranges = (-14, 14), (-14, 14), (-40, 40), (-40, 40), (0, 20)
        rates = {
            name: self.number(*ends)
            for name, ends in zip(names, ranges, strict=True)
            if self.chance(0.6)
        }
        axes = {"dichroic_angle": self.turn()} if self.chance(0.5) else {}
        return op.Medium(
            length, absorption, angle=self.turn(), azimuth=self.turn(), **rates, **axes
        )

    def source(self):
        intensity = float(self.rng.uniform(0.5, 100))
        if self.chance(0.6):
            return op.Source(intensity)
        state = self.rng.normal(size=3)
        state *= self.rng.random() / np.linalg.norm(state)
        state[2] *= self.chance(0.5)
        return op.Source(intensity, [1.0, *state])

    def path(self, *, loops=False):
        """A path of which some light gets out again from every ring."""
        while True:
            self.values = {}
            path = self.any_path(loops=loops)
            try:
                path.check()
            except op.errors.PathError as error:
                if "reaches no detector" in str(error):
                    continue
            return path

    def any_path(self, *, loops=False):
        """A path that parts and meets; every light ends in a detector or a dump.

        With loops, some light goes back into beam splitters that it may come from. Boundaries
        stand at any angle, in the medium that light comes in; of those that absorb, interfaces at
        angles at which a wave comes out.
        """
        path, lights, splitters, media = op.PathGraph(loops="sum"), [], [], {}
        for number in range(self.rng.integers(1, 3)):
            path.add(f"s{number}", self.source())
            lights.append(f"s{number}.out")
            media[f"s{number}.out"] = 1.0
        for number in range(self.rng.integers(1, 9)):
            if len(lights) > 1 and self.chance(0.2):
                path.add(f"c{number}", op.Combiner())
                met = []
                for azimuth in (None, float(self.rng.uniform(-1, 1))):
                    light = lights.pop(self.rng.integers(len(lights)))
                    path.connect(light, f"c{number}.in", azimuth=azimuth)
                    met.append(media[light])
                lights.append(f"c{number}.out")
                media[lights[-1]] = met[0] if are_one(*met) else None
                continue
            if loops and splitters and len(lights) > 1 and self.chance(0.5):
                light = lights.pop(self.rng.integers(len(lights)))
                splitter = splitters.pop()
                if media[light] == media[f"{splitter}.reflected"]:
                    path.connect(light, f"{splitter}.back", azimuth=self.turn())
                    continue
                lights.append(light)
            element = self.element()
            if loops and self.chance(0.4):
                element = op.BeamSplitter(self.number(0.1, 0.9), self.turn())
                splitters.append(f"e{number}")
            light = lights.pop(self.rng.integers(len(lights)))
            element = standing_in(element, media[light])
            path.add(f"e{number}", element)
            path.connect(light, f"e{number}.in")
            for way in sorted({coupling.leaves for coupling in element.couplings()}):
                lights.append(f"e{number}.{way}")
                is_behind = way == "transmitted" and isinstance(
                    element, op.Interface | op.LayerStack
                )
                media[lights[-1]] = element.index if is_behind else media[light]
        readings = ["stokes", "linear", "intensity", "intensity"]
        for number, light in enumerate(lights):
            ends = op.Detector(str(self.rng.choice(readings)))
            if number and self.chance(0.2):
                ends = op.Dump()
            path.add(f"d{number}", ends)
            path.connect(light, f"d{number}.in")
        # A splitter may stand in place of the element that they were drawn for.
        self.values = {name: self.values[name] for name in path.parameters}
        return path


def standing_in(element, medium):
    """A boundary in the medium that light comes in, at an angle of its own; others as they are."""
    if not isinstance(element, op.Interface | op.LayerStack):
        return element
    if medium is None:
        return op.Attenuator(0.5)
    if isinstance(element, op.Interface) and passes(medium):
        angle = min(element.incidence, 1.0) if isinstance(element.incidence, float) else 0.5
        angle = angle if absorption(medium) else element.incidence
        return replace(element, outside=medium, incidence=angle, parallel=False)
    if absorption(medium):
        return op.Attenuator(0.5)
    return replace(element, indices=[medium, *element.indices[1:]], parallel=False)


def are_one(*media):
    """Whether two media are known to be one."""
    first, second = media
    return isinstance(first, float) and isinstance(second, float) and first == second


def absorption(index):
    """The known k of a medium; that of a medium which may absorb is not 0."""
    if isinstance(index, op.Material):
        return index.k if isinstance(index.k, float) else np.inf
    return np.imag(index) if isinstance(index, float | complex) else np.inf


def passes(index):
    """Whether a wave that carries power is known to come out of a medium at up to 1 rad."""
    n = index.n if isinstance(index, op.Material) else np.real(index)
    return not absorption(index) or (isinstance(n, float) and absorption(index) < 0.2 * n)
