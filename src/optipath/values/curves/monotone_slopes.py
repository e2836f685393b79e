"""Slopes at samples by which cubics between them rise and fall no more than the samples do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]


def monotone_slopes(places: Array, values: Array) -> Array:
    """Return the slopes of a piecewise cubic through samples that overshoots none of them.

    Between two chords it is their weighted harmonic mean, or 0 where one rises and the other
    falls; at the ends that of a parabola, no more than 3 times the chord (F. N. Fritsch and
    R. E. Carlson, SIAM J. Numer. Anal. 17, 238, 1980; F. N. Fritsch and J. Butland, SIAM J. Sci.
    Stat. Comput. 5, 300, 1984).

    Shapes: places (n,); values (n,); returns (n,).

    Examples
    --------
    >>> monotone_slopes(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 1.0]))
    array([1.5, 0. , 0. ])
    """
    steps = np.diff(places)
    chords = np.diff(values) / steps
    if len(chords) == 1:
        return np.repeat(chords, 2)
    before, after = chords[:-1], chords[1:]
    first, second = 2.0 * steps[1:] + steps[:-1], steps[1:] + 2.0 * steps[:-1]
    turns = ~(np.sign(before) * np.sign(after) > 0.0)
    one, other = np.where(turns, 1.0, before), np.where(turns, 1.0, after)
    inner = np.where(turns, 0.0, (first + second) / (first / one + second / other))
    begin = _at_end(steps[0], steps[1], chords[0], chords[1])
    end = _at_end(steps[-1], steps[-2], chords[-1], chords[-2])
    return np.concatenate([[begin], inner, [end]])


def _at_end(step: Any, next_step: Any, chord: Any, next_chord: Any) -> float:
    slope = ((2.0 * step + next_step) * chord - step * next_chord) / (step + next_step)
    if np.sign(slope) != np.sign(chord):
        return 0.0
    if np.sign(chord) != np.sign(next_chord) and abs(slope) > 3.0 * abs(chord):
        return 3.0 * float(chord)
    return float(slope)
