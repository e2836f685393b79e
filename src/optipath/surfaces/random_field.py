"""Random surfaces: roughness, mesh, cosine waves and seed."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from optipath.errors import SurfaceError
from optipath.surfaces.field_arguments import (
    cells_of,
    converged_cells,
    length_faults,
    pair_of,
    period_faults,
    period_or_not,
    seed_of,
    warn_of_coarse,
)
from optipath.values.arrays import enough_for
from optipath.values.precision import Array, whole_number

_CELL, _WAVE = 32, 128
"""How many bytes a cell and a wave take, with what is made of them."""
_FEWER = "take fewer cells, or a smaller field"


class RandomField(NamedTuple):
    """A random surface to be drawn."""

    alpha: tuple[float, float]
    size: tuple[float, float]
    cells: tuple[int, int]
    waves: int
    seed: np.random.SeedSequence
    periodic: bool

    @classmethod
    def of(
        cls,
        alpha: Any,
        alpha_y: Any,
        size: Any,
        cells: Any,
        waves: Any,
        seed: Any,
        *,
        periodic: Any,
    ) -> RandomField:
        """Read what `HeightField.beckmann` is given."""
        faults = length_faults("alpha", alpha, " (HeightField.flat() is a flat surface)")
        if alpha_y is not None:
            faults += length_faults("alpha_y", alpha_y)
        sides = pair_of("size", size, faults)
        faults += period_or_not(periodic)
        rough = (1.0, 1.0)
        if not faults:
            rough = float(alpha), float(alpha if alpha_y is None else alpha_y)
            faults += period_faults(rough, sides) if periodic else []
        meshed = converged_cells(rough, sides) if cells is None else cells_of(cells, faults)
        sequence = seed_of(seed, faults)
        faults += whole_number("waves", waves)
        if faults:
            raise SurfaceError(*faults)
        return cls(rough, sides, meshed, int(waves), sequence, bool(periodic))

    def heights(self) -> Array:
        """Draw the surface, and return the heights of its vertices. Shape (rows, columns)."""
        with (
            enough_for(self.cells, _CELL, _FEWER, SurfaceError, "mesh of {:.3g} cells"),
            enough_for(
                (self.waves,), _WAVE, "take fewer waves", SurfaceError, "sum of {:.3g} waves"
            ),
        ):
            warn_of_coarse(self.alpha, self.size, self.cells)
            period = self.size if self.periodic else None
            x, y = (
                np.arange(cells + (not self.periodic)) * (side / cells)
                for cells, side in zip(self.cells, self.size, strict=True)
            )
            return RandomWaves.drawn(self.alpha, self.waves, self.seed, period).heights(x, y)


_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
_AT_ONCE = 1 << 20


class RandomWaves(NamedTuple):
    """Waves ``amplitude * cos(phase + x_number * x + y_number * y)``, a component of an array each.

    Shapes: x_number, y_number, phase (n,); amplitude (n,), a component of an array each.
    """

    x_number: Array
    y_number: Array
    phase: Array
    amplitude: Array

    @classmethod
    def drawn(
        cls,
        alpha: tuple[float, float],
        waves: int,
        seed: int | np.random.SeedSequence,
        period: tuple[float, float] | None = None,
    ) -> RandomWaves:
        """Draw waves whose sum has heights of variance 1 and slopes of variance alpha^2 / 2.

        E. Heitz, "Generating procedural Beckmann surfaces" (2015): with U1, U2, U3 uniform, the
        phase is 2 pi U1, and the wave vector r (alpha_x cos t, alpha_y sin t), t = 2 pi U2, r =
        sqrt(-ln U3). For each surface to have these variances itself, U2 and U3 are spread evenly
        along a spiral of golden angles, periodic waves of equal wave vector are merged, and powers
        are weighted by a polynomial of the squared wave vector.

        >>> drawn = RandomWaves.drawn((0.3, 0.3), 1000, seed=1, period=(200.0, 200.0))
        >>> slopes = (drawn.amplitude * drawn.x_number) ** 2 / 2
        >>> round(float(slopes.sum()), 12) == 0.3**2 / 2
        True
        """
        sequence = (
            seed if isinstance(seed, np.random.SeedSequence) else np.random.SeedSequence(seed)
        )
        random = np.random.Generator(np.random.PCG64(sequence))
        order = np.arange(waves)
        turn = 2.0 * np.pi * (random.random() + order * _GOLDEN)
        length = np.sqrt(-np.log((order + 0.5) / waves))
        # In units of alpha, in which the spectrum is round.
        vectors = length * np.array([np.cos(turn), np.sin(turn)])
        powers = np.full(waves, 1.0 / waves)
        if period is not None:
            steps = 2.0 * np.pi / np.multiply(alpha, period)[:, np.newaxis]
            vectors, powers = _whole_waves(vectors, powers, steps)
        else:
            vectors = vectors[:, np.argsort(vectors[0], kind="stable")]
        powers = _weighted(vectors, powers)
        phase = 2.0 * np.pi * random.random(powers.size)
        x_number, y_number = vectors * np.reshape(alpha, (2, 1))
        return cls(x_number, y_number, phase, np.sqrt(2.0 * powers))

    def heights(self, x: Array, y: Array) -> Array:
        """Return the heights (len(y), len(x)) where lines of equal x and of equal y meet.

        ``heights[i, j] = sum C[i, m] cos(f[m] x[j]) - S[i, m] sin(f[m] x[j])``, where C and S are
        sums over the waves of one component f along x: products, and no cosines.
        """
        numbers, first = np.unique(self.x_number, return_index=True)
        along = np.multiply.outer(numbers, x)
        cosines, sines = np.cos(along), np.sin(along)
        result = np.empty((y.size, x.size))
        rows = max(1, _AT_ONCE // self.phase.size)
        for begin in range(0, y.size, rows):
            part = slice(begin, begin + rows)
            angle = self.phase + np.multiply.outer(y[part], self.y_number)
            C = np.add.reduceat(self.amplitude * np.cos(angle), first, axis=1)
            S = np.add.reduceat(self.amplitude * np.sin(angle), first, axis=1)
            # A matrix product of BLAS has other bits with other numbers of threads.
            result[part] = np.einsum("im,mj->ij", C, cosines) - np.einsum("im,mj->ij", S, sines)
        return result


def _whole_waves(vectors: Array, powers: Array, steps: Array) -> tuple[Array, Array]:
    """Return wave vectors of whole numbers of waves, each once, in order, and their powers."""
    whole = np.rint(vectors / steps)
    # A wave and that of the opposite wave vector are one.
    whole = np.where((whole[0] < 0) | ((whole[0] == 0) & (whole[1] < 0)), -whole, whole)
    whole, place = np.unique(whole, axis=1, return_inverse=True)
    powers = np.bincount(place.ravel(), powers)
    # What has no wave in the period is no roughness, but a shift of the whole surface.
    rough = whole.any(axis=0)
    return whole[:, rough] * steps, powers[rough]


def _weighted(vectors: Array, powers: Array) -> Array:
    """Return powers nearly as given, whose sum is 1, and 1/2 with squares of the vectors."""
    moments = np.stack([np.ones_like(powers), *(2.0 * vectors**2)])
    wrong = 1.0 - np.einsum("in,n->i", moments, powers)
    products = np.einsum("in,jn,n->ij", moments, moments, powers)
    weights = 1.0 + np.einsum("in,i->n", moments, np.linalg.lstsq(products, wrong)[0])
    # Of a few waves, which cannot have the variances, none has a power below 0.
    results: Array = np.maximum(weights, 0.0) * powers
    return results
