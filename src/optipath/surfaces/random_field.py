"""Random surfaces: roughness, mesh, cosine waves and seed."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from optipath.errors import SurfaceError, shown
from optipath.materials.quantities import YES_OR_NO
from optipath.paths.files.schema import Faults
from optipath.surfaces.field_arguments import (
    Pair,
    cells_of,
    converged_cells,
    pair_of,
    period_faults,
    warn_of_coarse,
)
from optipath.values.arrays import refuse_too_large
from optipath.values.precision import Array, is_whole, whole_number

_CELL, _WAVE = 32, 128
"""How many bytes a cell and a wave take, with what is made of them."""


def random_field(
    alpha: Any, alpha_y: Any, size: Any, cells: Any, waves: Any, seed: Any, *, periodic: Any
) -> tuple[Array, Pair, bool, Pair]:
    """Draw the surface of `HeightField.beckmann`: heights, size, whether periodic, alpha."""
    faults = Faults()
    rough = pair_of("alpha", alpha if alpha_y is None else (alpha, alpha_y), faults)
    sides = pair_of("size", size, faults)
    is_periodic = bool(faults.attempt("", YES_OR_NO.check, "periodic", periodic))
    if not faults and is_periodic:
        faults += period_faults(rough, sides)
    mesh = converged_cells(rough, sides) if cells is None else cells_of(cells, faults)
    if not (isinstance(seed, np.random.SeedSequence) or is_whole(seed, 0)):
        faults.append(
            f"seed must be a whole number of 0 or more, or a numpy.random.SeedSequence, not "
            f"{shown(seed)}"
        )
    faults += whole_number("waves", waves)
    if faults:
        raise SurfaceError(*faults)
    fewer = "take fewer cells, or a smaller field"
    refuse_too_large(mesh, _CELL, fewer, SurfaceError, "mesh of {:.3g} cells")
    refuse_too_large((waves,), _WAVE, "take fewer waves", SurfaceError, "sum of {:.3g} waves")
    warn_of_coarse(rough, sides, mesh)
    x, y = (
        np.arange(count + (not is_periodic)) * (side / count)
        for count, side in zip(mesh, sides, strict=True)
    )
    drawn = RandomWaves.drawn(rough, int(waves), seed, sides if is_periodic else None)
    return drawn.heights(x, y), sides, is_periodic, rough


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
        random = np.random.Generator(np.random.PCG64(seed))
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
