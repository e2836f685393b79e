"""Chains of vertices in space, and the same paths built of interfaces in world frames."""

import numpy as np
import pytest

import optipath as op
from optipath.engines.choice import is_installed
from tables import slow_except

ENGINES = [engine for engine in ("numpy", "numba", "jax") if is_installed(engine)]
COMPILED = [engine for engine in ENGINES if engine != "jax"]
by_engine = pytest.mark.parametrize("engine", slow_except(["numpy"], ENGINES))
MATERIALS = (1.5, 1.12 + 2.16j, 0.608 + 2.12j, 0.66, 0.2 + 3.4j)


def random_chains(seed, reflections, batch=(), *, extreme=False):
    """Points of chains; some next to normal and to grazing incidence, where it is extreme."""
    rng = np.random.default_rng(seed)
    incidences = rng.uniform(0.05, 1.5, (reflections, *batch))
    if extreme:
        small = 10.0 ** rng.uniform(-6.0, -1.0, incidences.shape)
        kind = rng.integers(6, size=incidences.shape)
        incidences = np.where(kind == 0, small, np.where(kind == 1, np.pi / 2 - small, incidences))
    turns = rng.uniform(-np.pi, np.pi, (reflections - 1, *batch))
    points = op.vertices_from_angles(list(incidences), list(turns))
    return points @ random_rotation(rng).T + rng.normal(size=3)


def random_rotation(rng):
    """A proper rotation of the world."""
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def interfaces_in_space(points, materials, intensity=1.0):
    """The path of a chain, each surface an interface whose frames are given."""
    path = op.PathGraph()
    legs = np.diff(points, axis=-2)
    legs = legs / np.linalg.norm(legs, axis=-1, keepdims=True)
    kept, previous = None, None
    for number, material in enumerate(materials):
        arriving, leaving = legs[..., number, :], legs[..., number + 1, :]
        meets = op.plane_of_incidence(arriving, leaving - arriving, kept)
        frames = {"in": meets.arriving, "reflected": meets.reflected}
        element = op.Interface(material, meets.incidence)
        if previous is None:
            source = path.add("light", op.Source(intensity), {"out": meets.arriving})
            previous = source
        previous = previous >> path.add(f"surface{number + 1}", element, frames)
        kept = meets.reflected
    previous >> path.add("eye", op.Detector())
    return path
