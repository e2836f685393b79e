"""Random paths, each with a batch of values for its parameters, many of these at an edge."""

import numpy as np

import optipath as op
from random_paths import Draw

SEVERAL = 7


class BatchDraw(Draw):
    """Draws a path of which most values are parameters, and `SEVERAL` values for each."""

    def __init__(self, seed):
        super().__init__(seed, arrays=False)

    def given(self, values):
        name = f"p{len(self.values)}"
        self.values[name] = values
        return op.Parameter(name)

    def number(self, low, high):
        if self.chance(0.4):
            return float(self.rng.uniform(low, high))
        edges = np.clip([low, high, 0.0, -0.0, 1e-9, np.pi / 4, np.pi / 2], low, high)
        values = self.rng.uniform(low, high, SEVERAL)
        values = np.where(self.rng.random(SEVERAL) < 0.4, self.rng.choice(edges, SEVERAL), values)
        return self.given(np.full(SEVERAL, values[0]) if self.chance(0.2) else values)

    def index(self):
        """n and k, one number of both, or a real one; some have no absorption."""
        n, k = self.rng.uniform(0.3, 3, SEVERAL), self.rng.uniform(0, 3, SEVERAL)
        if self.chance(0.5):
            return op.Material(self.number(0.3, 3), self.number(0, 3))
        return self.given(n + 1j * k * (self.rng.random(SEVERAL) < 0.6) if self.chance(0.7) else n)

    def amplitude(self):
        """Of any phase; some are complex numbers without an imaginary part."""
        if self.chance(0.4):
            return self.number(-1, 1)
        values = self.rng.uniform(0, 1, SEVERAL) * np.exp(1j * self.rng.uniform(-3, 3, SEVERAL))
        return self.given(np.where(self.rng.random(SEVERAL) < 0.4, abs(values), values))

    def batch(self, *, loops=False):
        """A path, and the values of its parameters, not none."""
        while True:
            path = self.path(loops=loops)
            if self.values:
                return path, self.values


def at(values, place):
    """One of the values of each parameter, as plain numbers; points in space as an array."""
    chosen = {name: value[place] for name, value in values.items()}
    return {n: v if np.ndim(v) else v.item() for n, v in chosen.items()}


def one_by_one(plan, values, count=SEVERAL):
    """The light at every end of each path by a run of its own, shape (count, 4)."""
    runs = [plan.run_all(**at(values, place)) for place in range(count)]
    return {name: np.array([run[name].stokes for run in runs]) for name in runs[0]}
