"""Tabulated curves: measured n and k, interpolated without overshoot."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import numpy as np

from optipath.errors import OptipathError, ValueFault
from optipath.faults import unknown
from optipath.values.arrays import locked
from optipath.values.curve import Curve, span_text
from optipath.values.domains import Domain
from optipath.values.wavelength import LONGEST_FIRST, WAVELENGTH, too_long

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping, Sequence

    import numpy.typing as npt

    Array = npt.NDArray[np.float64]


Interpolation: TypeAlias = Literal["linear", "monotone"]
Extrapolation: TypeAlias = Literal["", "nearest", "linear"]
INTERPOLATIONS: tuple[Interpolation, ...] = get_args(Interpolation)
EXTRAPOLATIONS: tuple[Extrapolation, ...] = get_args(Extrapolation)


@dataclass(frozen=True, eq=False, repr=False)
class Tabulated(Curve):
    """Numbers at sampled wavelengths in metres, exact there.

    >>> gold = Tabulated("gold", ("n",), ["500 nm", "600 nm"], [[0.9, 0.3]])
    >>> gold.evaluated(5.5e-7)[0].round(12).item()
    0.6
    """

    beyond = 'ask for extrapolate="nearest" or "linear"'
    label: str
    parts: tuple[str, ...] = field()
    wavelengths: Any
    columns: Sequence[Any]
    _: KW_ONLY
    interpolation: Interpolation = "linear"
    extrapolate: Extrapolation = ""
    unit: str = ""

    def __post_init__(self) -> None:
        label, names, rows = self.label, ("wavelengths", *self.parts), self.columns
        beyond, by = self.extrapolate, self.interpolation
        faults = unknown("interpolation", by, INTERPOLATIONS)
        faults += unknown("extrapolate", beyond, EXTRAPOLATIONS)
        places, *values = [
            _samples(label, name, row, faults)
            for name, row in zip(names, (self.wavelengths, *rows), strict=True)
        ]
        if not faults:
            faults += filter(None, [_wavelength_fault(label, places)])
            faults += [
                f"{label} has {len(places)} wavelengths and {len(column)} of {part}; give one "
                f"of each for each sample"
                for part, column in zip(self.parts, values, strict=True)
                if len(column) != len(places)
            ]
        ValueFault.raise_for(faults)
        if places[0] > places[-1]:
            places, values = places[::-1].copy(), [column[::-1].copy() for column in values]
        steps = np.diff(places)
        edges = np.repeat(places, 2)[:-1]  # Pieces meet at each sample, and halfway to the next.
        edges[1::2] += 0.5 * steps
        vars(self).update(
            wavelengths=locked(places),
            columns=tuple([locked(column) for column in values]),
            span=(0.0, np.inf) if beyond else (float(places[0]), float(places[-1])),
            unreal="beyond its samples a straight line goes on" * (beyond == "linear"),
            _nodes=locked(np.repeat(places, 2)),
            _edges=locked(edges),
            _cubics=tuple([_cubics(places, steps, each, by, beyond) for each in values]),
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        numbers = (self.wavelengths, *self.columns)
        messages = (self.label, self.parts, self.interpolation, self.extrapolate)
        return (*messages, *[column.tobytes() for column in numbers])

    @property
    def known_span(self) -> tuple[float, float]:
        """The wavelengths of the first and the last sample, in metres."""
        return float(self.wavelengths[0]), float(self.wavelengths[-1])

    def samples(self, place: int) -> Any:
        return self.columns[place]

    def is_nowhere_0(self, place: int) -> bool:
        return self.extrapolate != "linear" and bool(np.all(self.columns[place] > 0.0))

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        # Each sample reaches halfway to its neighbours, so that it is exact on either side.
        own = vars(self)
        piece = xp.searchsorted(xp.asarray(own["_edges"]), wavelength, side="right")
        step = wavelength - xp.asarray(own["_nodes"])[piece]
        results = []
        for cubic in own["_cubics"]:
            value, slope, second, third = [xp.asarray(each)[piece] for each in cubic]
            results.append(value + step * (slope + step * (second + step * third)))
        return tuple(results)


_SAMPLE = Domain("number")


def _samples(label: str, name: str, raw_value: Any, faults: list[str]) -> np.ndarray[Any, Any]:
    """Return samples as a copy of their numbers, and tell what is wrong with them."""
    owner, domain = f"{name} of {label}", WAVELENGTH if name == "wavelengths" else _SAMPLE
    array = np.zeros(0)
    with OptipathError.collecting(faults):
        array = np.array(domain.check(owner, raw_value), np.float64)
        if array.ndim != 1 or not array.size:
            faults.append(f"{owner} must be a row of real numbers, not of shape {array.shape}")
    return array


def _wavelength_fault(label: str, places: np.ndarray[Any, Any]) -> str:
    """Return what is wrong with the wavelengths of samples, or nothing."""
    steps = np.diff(places)
    if (least := float(places.min())) > LONGEST_FIRST:
        return f"the least wavelength of {label} is {too_long(least)}"
    if not np.any(turns := steps * np.sign(places[-1] - places[0]) <= 0.0):
        return ""
    return (
        f"the wavelengths of {label} neither rise nor fall throughout, as at "
        f"{places[:-1][turns][0] * 1e9:.10g} nm; sort them, each once with all that belongs to it"
    )


def _cubics(places: Array, steps: Array, values: Array, by: str, beyond: str) -> tuple[Array, ...]:
    """Return the coefficients of each piece, in steps from its sample: one before, one behind."""
    count = len(places)
    slopes, second, third = np.zeros((3, 2 * count))
    before, behind = slice(2, None, 2), slice(1, -1, 2)
    if count > 1:
        chords = np.diff(values) / steps
        slopes[before] = slopes[behind] = chords
        if by == "monotone":
            at = monotone_slopes(places, values)
            slopes[:] = np.repeat(at, 2)
            second[behind] = (3.0 * chords - 2.0 * at[:-1] - at[1:]) / steps
            second[before] = (2.0 * at[1:] + at[:-1] - 3.0 * chords) / steps
            third[before] = third[behind] = (at[:-1] + at[1:] - 2.0 * chords) / steps**2
        outside = 0.0 if beyond == "nearest" else 1.0
        slopes[0], slopes[-1] = outside * slopes[1], outside * slopes[-2]
    return tuple([locked(each) for each in (np.repeat(values, 2), slopes, second, third)])


def monotone_slopes(places: Array, values: Array) -> Array:
    """Return the slopes of a piecewise cubic through samples that overshoots none of them.

    The weighted harmonic mean of two chords, or 0 where they differ in sign; at the ends that of a
    parabola, at most 3 times the chord (F. N. Fritsch and R. E. Carlson, SIAM J. Numer. Anal. 17,
    238, 1980; F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5, 300, 1984).

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


@dataclass(frozen=True, eq=False, repr=False)
class PageCurve(Curve):
    """Several curves as one, at the wavelengths at which all of them are known.

    >>> n = Tabulated("n", ("n",), [4e-7, 8e-7], [[1.5, 1.3]])
    >>> k = Tabulated("k", ("k",), [5e-7, 9e-7], [[0.0, 0.4]])
    >>> PageCurve("paint", [n, k]).span
    (5e-07, 8e-07)
    """

    label: str
    curves: Sequence[Curve]
    _: KW_ONLY
    within: tuple[float, float] | None = None
    place: str = ""
    source: str = ""
    asked: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        curves, within = self.curves, self.within
        lows, highs = zip(*[curve.span for curve in curves], strict=True)
        low, high = max(lows), min(highs)
        if low > high:
            spans = [f"{' and '.join(c.parts)} within {span_text(c.span)}" for c in curves]
            wrong = f"has {', and '.join(spans)}, where no wavelength is in both"
            raise ValueFault(f"{self.label} {wrong}")
        vars(self).update(
            parts=tuple([part for curve in curves for part in curve.parts]),
            span=(max(low, within[0]), min(high, within[1])) if within else (low, high),
            beyond="give k, or name another page" if within else "name another page",
        )

    @property
    def content(self) -> tuple[Hashable, ...]:
        return (self.label, self.span, *[(type(one).__name__, one.content) for one in self.curves])

    def unreal_of(self, place: int) -> str:
        return [c.unreal_of(at) for c in self.curves for at in range(len(c.parts))][place]

    def is_nowhere_0(self, place: int) -> bool:
        return [c.is_nowhere_0(at) for c in self.curves for at in range(len(c.parts))][place]

    def numbers(self, xp: Any, wavelength: Any, *arguments: Any) -> tuple[Any, ...]:
        return tuple([part for curve in self.curves for part in curve.numbers(xp, wavelength)])
