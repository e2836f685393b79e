"""Rough samples that are small, and quick to draw and to walk over; and what flat faces reflect."""

import numpy as np

import optipath as op
from optipath.surfaces import HeightField

BASES = {"glass": 1.5, "diamond": 2.4, "silver": 0.5 + 2.1j, "mirror": 1j, "weak": 3.9 + 0.02j}


def rough(alpha, alpha_y=None, seed=0):
    """A field of 10.5 correlation lengths, with 16 cells a length."""
    size = 21.0 / alpha, 21.0 / (alpha_y or alpha)
    return HeightField.beckmann(alpha, alpha_y, size=size, cells=168, waves=200, seed=seed)


def drawn_sample(seed):
    """A sample of one to three layers of any roughness from 0.1 to 1, and an incidence."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 4))
    above = [float(n) for n in rng.choice([1.3, 1.5, 1.8, 2.4], count - 1)]
    base = BASES[sorted(BASES)[seed % len(BASES)]]
    fields = [rough(float(alpha), seed=seed) for alpha in 0.1 ** rng.random(count)]
    sample = op.Sample([*zip([*above, base], fields, strict=True)])
    return sample, float(rng.choice([0.0, 0.5, 1.0, 1.3, 1.57]))


def polarised(seed):
    """A Stokes vector that is polarised by 100 %, any way."""
    vector = np.random.default_rng(seed).normal(size=3)
    return [1.0, *(vector * (1.0 - 1e-15) / np.linalg.norm(vector))]


def fresnel(n1, n2, angle):
    """What a face reflects of s and p (M. Born, E. Wolf, Principles of Optics, eq. 1.5.21)."""
    c1, c2 = np.cos(angle), np.sqrt(1.0 - (n1 * np.sin(angle) / n2) ** 2)
    pairs = (n1 * c1, n2 * c2), (n2 * c1, n1 * c2)
    return np.array([((a - b) / (a + b)) ** 2 for a, b in pairs])


def rounds(upper, lower):
    """What two faces reflect of light that goes to and fro between them: a geometric series."""
    return upper + (1.0 - upper) ** 2 * lower / (1.0 - upper * lower)
