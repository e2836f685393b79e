"""Photons over a smooth surface of a few waves, by small steps: no mesh, no code of the library.

Intensities alone, without polarisation. What is met is found where the height above the surface
changes sign, to the last digits by halving; a photon is reflected by the mean of Fresnel's shares.
"""

import numpy as np

STEPS, HALVINGS = 200, 40


class Waves:
    """A periodic surface of cosines, its period 1 along x and y."""

    def __init__(self, waves, amplitude):
        """Waves are rows of (whole number along x, along y, phase)."""
        along_x, along_y, self.phases = np.transpose(waves)
        self.vectors = 2 * np.pi * np.stack([along_x, along_y], axis=-1)
        self.amplitude = amplitude
        self.highest = amplitude * len(waves)

    def heights(self, places):
        return self.amplitude * np.cos(places[..., :2] @ self.vectors.T + self.phases).sum(axis=-1)

    def normals(self, places):
        waves = np.sin(places[..., :2] @ self.vectors.T + self.phases)
        slopes = -self.amplitude * waves @ self.vectors
        normals = np.concatenate([-slopes, np.ones((*slopes.shape[:-1], 1))], axis=-1)
        return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def shares(waves, index, incidence, photons, numbers, most=20):
    """The shares that go up and down after 1, 2, ... events, each of shape (most,)."""
    places = np.column_stack([numbers.random((photons, 2)), np.full(photons, waves.highest)])
    ways = np.tile([np.sin(incidence), 0.0, -np.cos(incidence)], (photons, 1))
    sides = np.ones(photons)
    up, down = np.zeros(most), np.zeros(most)
    for number in range(most):
        met, places = next_places(waves, places, ways, sides)
        up[number - 1] += np.sum(~met & (sides > 0))
        down[number - 1] += np.sum(~met & (sides < 0))
        places, ways, sides = places[met], ways[met], sides[met]
        ways, sides = reflected_or_refracted(waves, index, places, ways, sides, numbers)
    return up / photons, down / photons


def next_places(waves, places, ways, sides):
    """Whether photons meet the surface again, and where."""
    towards = np.where(ways[:, 2] > 0, waves.highest, -waves.highest)
    lengths = (towards - places[:, 2]) / ways[:, 2]
    begin, end, met = np.zeros(len(places)), np.zeros(len(places)), np.zeros(len(places), bool)
    # The first step leaves the surface that a photon comes from.
    for step in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        there = places + (step * lengths)[:, np.newaxis] * ways
        crossed = ~met & (sides * (there[:, 2] - waves.heights(there)) < 0)
        begin[~met], end[crossed] = end[~met], (step * lengths)[crossed]
        end[~met & ~crossed] = (step * lengths)[~met & ~crossed]
        met |= crossed
    for _ in range(HALVINGS):
        middle = 0.5 * (begin + end)
        there = places + middle[:, np.newaxis] * ways
        below = sides * (there[:, 2] - waves.heights(there)) < 0
        begin, end = np.where(below, begin, middle), np.where(below, middle, end)
    return met, places + begin[:, np.newaxis] * ways


def reflected_or_refracted(waves, index, places, ways, sides, numbers):
    """Directions and sides behind an event."""
    normals = sides[:, np.newaxis] * waves.normals(places)
    n1, n2 = np.where(sides > 0, 1.0, index), np.where(sides > 0, index, 1.0)
    cos = -np.sum(normals * ways, axis=-1)
    behind = 1.0 - (n1 / n2) ** 2 * (1.0 - cos**2)
    other = np.sqrt(np.maximum(behind, 0.0))
    of_s = ((n1 * cos - n2 * other) / (n1 * cos + n2 * other)) ** 2
    of_p = ((n2 * cos - n1 * other) / (n2 * cos + n1 * other)) ** 2
    back = (numbers.random(len(cos)) < 0.5 * (of_s + of_p)) | (behind <= 0.0)
    reflected = ways + (2 * cos)[:, np.newaxis] * normals
    refracted = (n1 / n2)[:, np.newaxis] * ways + (n1 / n2 * cos - other)[:, np.newaxis] * normals
    return np.where(back[:, np.newaxis], reflected, refracted), np.where(back, sides, -sides)
