"""The work that the benchmarks share."""

import numpy as np
import pytest

import optipath as op
from optipath.engines.choice import is_installed

METAL = {"n1": 1.12, "k1": 2.16, "n2": 0.608, "k2": 2.12}
ENGINES = tuple(engine for engine in ("numpy", "numba", "jax") if is_installed(engine))
COMPILED = [engine for engine in ENGINES if engine != "jax"]
needs_numba = pytest.mark.skipif("numba" not in ENGINES, reason="needs Numba")


def long(*values):
    """Return what is measured with ``-m long`` alone."""
    return [pytest.param(value, marks=pytest.mark.long) for value in values]


def assignment(**values):
    """Return the two reflections behind a horizontal filter."""
    return op.load_preset("npgr026", filter="horizontal", **values)


def angles(count, dtype="float64"):
    """Return random angles for it."""
    draw = np.random.default_rng(1).uniform
    found = {"delta": draw(0, np.pi / 2, count), "phi": draw(0, np.pi / 2, count)}
    found["rho"] = draw(-np.pi, np.pi, count)
    return {name: value.astype(dtype) for name, value in found.items()}


def traced(refracted, indices, seed):
    """Return vertices of chains of rays, (count, m + 2, 3); both arguments are (count, m)."""
    rng = np.random.default_rng(seed)
    count, here = len(indices), np.zeros((len(indices), 3))
    k, medium, points = unit(rng.normal(size=(count, 3))), np.ones(count), [here]
    for bent, n in zip(refracted.T, indices.T, strict=True):
        points.append(here := here + k)
        s = np.sin(1.3) * np.where(bent, np.minimum(n / medium, 1.0), 1.0) * rng.random(count)
        s, c = s[:, None], np.sqrt(1.0 - s * s)[:, None]
        normal = s * unit(np.cross(k, rng.normal(size=(count, 3)))) - c * k
        r = (medium / n)[:, None]
        onward = r * k + (r * c - np.sqrt(1.0 - np.minimum(r * s, 1.0) ** 2)) * normal
        k = unit(np.where(bent[:, None], onward, k + 2.0 * c * normal))
        medium = np.where(bent, n, medium)
    return np.stack([*points, here + k], axis=1)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def finished(numbers):
    """Wait for an engine that answers before it is done."""
    getattr(numbers, "block_until_ready", bool)()
