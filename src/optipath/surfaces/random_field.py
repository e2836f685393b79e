"""Random surfaces: roughness, mesh, cosine waves and seed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from optipath.errors import MeshWarning, SurfaceError
from optipath.faults import Cure, Fault, shown
from optipath.materials.quantities import YES_OR_NO
from optipath.paths.files.schema import Faults
from optipath.values.angles import warn
from optipath.values.arrays import refuse_too_large
from optipath.values.precision import Array, is_whole, real_number, whole_number

Pair: TypeAlias = tuple[float, float]

LARGEST = 1e30
"""The largest length, and one over the least, whose ratios to others still have squares."""

_FEWEST_LENGTHS = 10
"""How many correlation lengths a period needs, to have enough different waves."""

_CONVERGED, _SMOOTH, _OF_SMOOTH = 16, 0.3, 5
"""How many cells a correlation length needs; up to which alpha little light is scattered twice, and
how many cells do there."""

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
    if not isinstance(seed, np.random.SeedSequence):
        faults += whole_number("seed", seed, 0)
    faults += whole_number("waves", waves)
    SurfaceError.raise_for(faults)
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


def pair_of(what: str, value: Any, faults: list[str]) -> Pair:
    """Return positive numbers for x and for y, of one number or of a pair."""
    numbers = [real_number(each) or 0.0 for each in _both(value)]
    if len(numbers) == 2 and all(1.0 / LARGEST <= each <= LARGEST for each in numbers):
        return numbers[0], numbers[1]
    limits = f"{1.0 / LARGEST:g} .. {LARGEST:g}"
    faults.append(f"{what} must be a number of {limits}, or two for x and y, not {shown(value)}")
    return 1.0, 1.0


def cells_of(cells: Any, faults: list[str]) -> tuple[int, int]:
    """Return how many cells there are along x and y, of one number or of a pair."""
    numbers = _both(cells)
    if len(numbers) == 2 and all(is_whole(number, 2) for number in numbers):
        return int(numbers[0]), int(numbers[1])
    faults.append(f"cells must be a whole number from 2, or two for x and y, not {shown(cells)}")
    return 2, 2


def _both(value: Any) -> tuple[Any, ...]:
    """Return the entries of a pair, or a number twice."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return tuple(value)
    return value, value


def correlation_lengths(alpha: Pair, size: Pair) -> Pair:
    """Return how many correlation lengths, 2 / alpha, a surface of random waves has."""
    return size[0] * alpha[0] / 2.0, size[1] * alpha[1] / 2.0


def period_faults(alpha: Pair, size: Pair) -> list[str]:
    """Return the sentences for periods too short for random waves; none for long ones."""
    lengths = correlation_lengths(alpha, size)
    # A size of 20 / alpha may be less by a rounding.
    if min(lengths) * (1.0 + 1e-12) >= _FEWEST_LENGTHS:
        return []
    enough = tuple(math.ceil(2.0 * _FEWEST_LENGTHS / each) for each in alpha)
    why = (
        f"a periodic surface of {size[0]:.6g} x {size[1]:.6g} and alpha {alpha} has "
        f"{lengths[0]:.3g} x {lengths[1]:.3g} correlation lengths 2/alpha, too few for its waves; "
        f"write size={enough} or more, or periodic=False"
    )
    return [why]


def converged_cells(alpha: Pair, size: Pair, each: int = _CONVERGED) -> tuple[int, int]:
    """Return how many cells are enough for any number of events, or for so many a length."""
    # The rounding of a product is no cell more.
    along_x, along_y = (
        max(2, math.ceil(each * length * (1.0 - 1e-12)))
        for length in correlation_lengths(alpha, size)
    )
    return along_x, along_y


def warn_of_coarse(alpha: Pair, size: Pair, cells: tuple[int, int]) -> None:
    """Warn of a mesh that is too coarse for its roughness."""
    needed = _CONVERGED if max(alpha) > _SMOOTH else _OF_SMOOTH
    enough = converged_cells(alpha, size, needed)
    if cells[0] >= enough[0] and cells[1] >= enough[1]:
        return
    lengths = correlation_lengths(alpha, size)
    had = min(cells[0] / lengths[0], cells[1] / lengths[1])
    why = (
        f"a mesh of {cells[0]} x {cells[1]} cells has {had:.4g} a correlation length 2/alpha, and "
        f"needs {needed} at alpha {max(alpha):.4g}: slopes are lost, and light of several events"
    )
    ways = f"cells={enough}", f"--cells {','.join(map(str, enough))}"
    warn(Fault(why, Cure.of("{} are enough".format, *ways)), MeshWarning)


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
