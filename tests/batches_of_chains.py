"""Batches of chains of light that differ in events, lengths and media, with what each must give."""

from contextlib import nullcontext
from dataclasses import dataclass

import numpy as np
import pytest

from histories import coherency, random_histories


@dataclass
class Batch:
    """Chains in one array each, what is behind their ends being no number.

    Points (count, m + 2, 3), the palette, ids (count, m), a text for each, the coherency
    matrices of the light behind them (count, 3, 3).
    """

    points: np.ndarray
    palette: list
    ids: np.ndarray
    texts: list
    expected: np.ndarray

    @property
    def lengths(self):
        return np.array([len(text) for text in self.texts])

    @property
    def letters(self):
        """A letter for each vertex; anything behind the end."""
        most = self.ids.shape[-1]
        return np.array([list(text.ljust(most, "?")) for text in self.texts])

    def alone(self, chain):
        """The points, materials and events of one chain by itself."""
        text = self.texts[chain]
        media = [self.palette[which] for which in self.ids[chain, : len(text)]]
        return self.points[chain, : len(text) + 2], media, text


def random_batch(seed, most=8, several=24, each=8):
    """Chains of 1 to `most` events, in any order: so many texts, each of so many chains."""
    rng = np.random.default_rng(seed)
    points = np.full((several, each, most + 2, 3), np.nan)
    indices = np.full((several, each, most), np.nan, complex)
    texts, expected = [], []
    for place in range(several):
        text = "".join(rng.choice(["R", "T"], 1 + place % most))
        some, _, materials = random_histories(1000 * seed + place, text, each)
        points[place, :, : len(text) + 2] = some
        indices[place, :, : len(text)] = np.stack(materials, -1)
        texts += [text] * each
        expected.append(coherency(some, text, materials))
    there = ~np.isnan(indices)
    palette, which = np.unique(indices[there], return_inverse=True)
    ids = np.full(indices.shape, -1)
    ids[there] = which.ravel()
    mixed = rng.permutation(several * each)
    flat = [array.reshape(-1, *array.shape[2:])[mixed] for array in (points, ids)]
    media = [index if index.imag else index.real for index in palette.tolist()]
    return Batch(
        flat[0], media, flat[1], [texts[i] for i in mixed], np.concatenate(expected)[mixed]
    )


def quickly(engine):
    """A context in which an engine runs what is run once: JAX step by step, not compiled."""
    return pytest.importorskip("jax").disable_jit() if engine == "jax" else nullcontext()
