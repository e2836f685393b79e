"""The work that the benchmarks share."""

import numpy as np

import optipath as op
from optipath.engines.automatic import is_installed

METAL = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12}
ENGINES = tuple(engine for engine in ("numpy", "numba", "jax") if is_installed(engine))


def assignment(**values):
    """Return the two reflections behind a horizontal filter."""
    return op.load_preset("npgr026", filter="horizontal", **values)


def angles(count, dtype="float64"):
    """Return random angles for it."""
    draw = np.random.default_rng(1).uniform
    found = {"delta": draw(0, np.pi / 2, count), "phi": draw(0, np.pi / 2, count)}
    found["rho"] = draw(-np.pi, np.pi, count)
    return {name: value.astype(dtype) for name, value in found.items()}


def chain(length):
    """Return a path of many interfaces, each with values of its own."""
    path = op.PathGraph()
    node = path.add("lamp", op.Source())
    for number in range(length):
        share = number / length
        interface = op.Interface(1.5 + 0.1 * share, 0.3 + 0.1 * share, azimuth=0.1)
        node = node >> path.add(f"e{number}", interface)
    node >> path.add("eye", op.Detector())
    return path


def finished(numbers):
    """Wait for an engine that answers before it is done."""
    getattr(numbers, "block_until_ready", bool)()
