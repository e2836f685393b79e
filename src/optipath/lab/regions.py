"""Regions and places where methods fail."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from optipath.elements.interface import Interface
from optipath.errors import OptipathError
from optipath.faults import unknown
from optipath.materials.index_domains import FOLLOWS

if TYPE_CHECKING:
    from collections.abc import Sequence

    import networkx as nx
    import numpy.typing as npt

    from optipath.paths.path_graph import PathGraph

    Floats: TypeAlias = npt.NDArray[np.floating]
    DrawNear: TypeAlias = Callable[["Dice", float], tuple[Floats, ...]]


class Samples(NamedTuple):
    """Boundaries and angles, one a row."""

    n: Floats
    k: Floats
    cos: Floats
    sin: Floats

    @property
    def incidence(self) -> Floats:
        """The angle of incidence in radians."""
        return np.arctan2(self.sin.astype(np.float64), self.cos.astype(np.float64))


Draw: TypeAlias = Callable[["Dice"], tuple["Floats", ...]]


@dataclass(frozen=True)
class Region:
    """A part of the parameter space, drawn at random and always in the same way."""

    name: str
    draw: Draw

    def samples(self, count: int, dtype: str = "float64", seed: int = 0) -> Samples:
        """Return boundaries and angles, rounded to a precision.

        >>> REGIONS[0].samples(3).n.shape
        (3,)
        """
        random = np.random.default_rng([seed, *self.name.encode()])
        return self._drawn(Dice(count, lambda: random.random(count), np.finfo(dtype)), dtype)

    def at(self, units: Floats, dtype: str = "float64") -> Samples:
        """Return the sample of numbers within 0 .. 1, units (dimensions, count).

        >>> REGIONS[0].at(np.full((REGIONS[0].dimensions, 2), 0.5)).n
        array([2.55, 2.55])
        """
        rows = iter(units)
        return self._drawn(Dice(units.shape[1], lambda: next(rows), np.finfo(dtype)), dtype)

    @property
    def dimensions(self) -> int:
        """How many random numbers a sample is made of."""
        dice = Dice(1, lambda: np.full(1, 0.5), np.finfo(np.float64))
        self.draw(dice)
        return dice.rolls

    def _drawn(self, dice: Dice, dtype: str) -> Samples:
        return Samples(*(np.broadcast_to(x, dice.count).astype(dtype) for x in self.draw(dice)))


class Dice:
    """Numbers for one region, made of others within 0 .. 1 that are rolled, and counted."""

    def __init__(self, count: int, roll: Callable[[], Floats], precision: Any) -> None:
        self.count = count
        self.precision = precision
        self.rolls = 0
        self._roll = roll

    def even(self, low: float, high: float) -> Floats:
        """Return numbers spread evenly."""
        self.rolls += 1
        numbers: Floats = low + (high - low) * self._roll()
        # What is computed from them has the digits of the precision, if that is more.
        return numbers.astype(np.result_type(self.precision.dtype, np.float64))

    def decades(self, low: float, high: float) -> Floats:
        """Return numbers whose logarithms are spread evenly."""
        return 10.0 ** self.even(np.log10(low), np.log10(high))

    def sign(self) -> Floats:
        """Return -1 or 1."""
        return np.where(self.even(0, 1) < 0.5, -1.0, 1.0)

    def some(self, numbers: Floats) -> Floats:
        """Return numbers, half of them replaced by 0."""
        return np.where(self.even(0, 1) < 0.5, 0.0, numbers)

    def extreme(self) -> Floats:
        """Return numbers whose squares overflow or underflow, and whose inverses do not."""
        # Drawn as doubles, whatever they are rounded to.
        reach = 0.93 * float(min(np.log10(self.precision.max), 308.0))
        # The smallest are so small that what is in proportion to their squares is nothing.
        return np.where(
            self.sign() > 0,
            10.0 ** self.even(0.52 * reach, reach),
            10.0 ** self.even(-reach, -0.65 * reach),
        )


def _at(angle: Floats | float) -> tuple[Floats, Floats]:
    return np.cos(angle), np.sin(angle)


def _generic(dice: Dice) -> tuple[Floats, ...]:
    angle = np.radians(dice.even(1, 89))
    return dice.even(0.1, 5), dice.some(dice.even(0.01, 8)), *_at(angle)


def _next_to(dice: Dice, tangent: Floats, distance: float | None = None) -> tuple[Floats, Floats]:
    """Return cosine and sine at a distance in rad on either side of the angle of a tangent.

    It is 1e-12, or some roundings, to 1e-1 by default.
    """
    least = max(1e-12, 64.0 * float(dice.precision.eps))
    off = dice.sign() * (dice.decades(least, 1e-1) if distance is None else distance)
    t = np.abs((tangent + np.tan(off)) / (1.0 - tangent * np.tan(off)))
    return 1.0 / np.hypot(1.0, t), t / np.hypot(1.0, t)


def _brewster(dice: Dice, distance: float | None = None) -> tuple[Floats, ...]:
    n = np.where(dice.sign() > 0, dice.even(1.05, 4), dice.even(0.25, 0.95))
    return n, np.zeros(1), *_next_to(dice, n, distance)


def _critical(dice: Dice, k: Floats) -> tuple[Floats, ...]:
    n = dice.even(0.2, 0.95)
    return n, k, *_next_to(dice, n / np.sqrt((1 - n) * (1 + n)))


def _total(dice: Dice, k: Floats) -> tuple[Floats, ...]:
    n = dice.even(0.2, 0.95)
    critical = np.arcsin(n)
    return n, k, *_at(critical + (np.pi / 2 - critical) * dice.even(0.05, 0.95))


def _inner(dice: Dice) -> tuple[Floats, Floats]:
    return _at(np.radians(dice.even(1, 89)))


def _grazing(dice: Dice) -> tuple[Floats, Floats]:
    below_90 = np.radians(dice.decades(1e-12, 1e-1))
    return np.sin(below_90), np.cos(below_90)


def _nearly_one(dice: Dice) -> Floats:
    return 1.0 + dice.sign() * dice.decades(1e-14, 1e-3)


def _alike(dice: Dice) -> tuple[Floats, ...]:
    n = _nearly_one(dice)
    return n, np.abs(n - 1.0) * dice.decades(0.1, 10), *_inner(dice)


def _large(dice: Dice) -> tuple[Floats, Floats]:
    size, phase = dice.decades(1e3, 1e8), dice.even(0.0, np.pi / 2)
    return size * np.cos(phase), size * np.sin(phase)


def _extreme(dice: Dice) -> tuple[Floats, ...]:
    size, phase = dice.extreme(), dice.even(0.1, 1.4)
    return size * np.cos(phase), dice.some(size * np.sin(phase)), *_inner(dice)


_NONE = np.zeros(1)

REGIONS: tuple[Region, ...] = (
    Region("generic", _generic),
    Region("near the normal", lambda d: (*_generic(d)[:2], *_at(d.decades(1e-12, 1e-1)))),
    Region("exactly normal", lambda d: (*_generic(d)[:2], np.ones(1), _NONE)),
    Region("grazing", lambda d: (*_generic(d)[:2], *_grazing(d))),
    Region("exactly 90 deg", lambda d: (*_generic(d)[:2], _NONE, np.ones(1))),
    Region("near Brewster's angle", _brewster),
    Region("near the critical angle", lambda d: _critical(d, _NONE)),
    Region("k = 0, n > 1", lambda d: (d.even(1.01, 4), _NONE, *_inner(d))),
    Region("k = 0, total reflection", lambda d: _total(d, _NONE)),
    Region("tiny k, n > 1", lambda d: (d.even(1.01, 4), d.decades(1e-20, 1e-3), *_inner(d))),
    Region("tiny k, total reflection", lambda d: _total(d, d.decades(1e-20, 1e-3))),
    Region("tiny k, near the critical angle", lambda d: _critical(d, d.decades(1e-20, 1e-3))),
    Region("n near 1, k = 0", lambda d: (_nearly_one(d), _NONE, *_inner(d))),
    Region("n near 1, k like n - 1", _alike),
    Region("n near 1, grazing", lambda d: (_nearly_one(d), _NONE, *_grazing(d))),
    Region("metals", lambda d: (d.even(0.05, 4), d.even(1, 9), *_inner(d))),
    Region("index of 1e3 to 1e8", lambda d: (*_large(d), *_inner(d))),
    Region("index of 1e3 to 1e8, grazing", lambda d: (*_large(d), *_grazing(d))),
    Region("n near 0", lambda d: (d.decades(1e-12, 1e-2), d.some(d.decades(1e-12, 1)), *_inner(d))),
    Region("extreme magnitudes", _extreme),
)


def in_region(path: PathGraph, region: Region, count: int, dtype: str) -> nx.MultiDiGraph:
    """Return a path with interfaces drawn from a region, but for incidences by world frames.

    >>> import optipath as op
    >>> from optipath.lab.regions import REGIONS
    >>> graph = in_region(op.load_preset("npgr026"), REGIONS[0], 5, "float64")
    >>> graph.nodes["X1"]["element"].incidence.shape
    (5,)
    """
    graph = path.graph.copy()
    for number, name in enumerate(interfaces(path)):
        node = graph.nodes[name]
        drawn = region.samples(count, dtype, seed=number)
        changes: dict[str, Any] = {"index": drawn.n + 1j * drawn.k, "outside": 1.0}
        if not node["frames"]:
            changes["incidence"] = drawn.incidence
        node["element"] = replace(node["element"], **changes)
    return graph


def interfaces(path: PathGraph) -> list[str]:
    """Return the names of interfaces that share no values with others, unlike those of stacks."""
    lit_behind = {end for _, end, (_, enters) in path.graph.edges(keys=True) if enters == "back"}
    return [
        name
        for name, element in path.graph.nodes(data="element")
        if isinstance(element, Interface)
        and name not in lit_behind
        and element.incidence_in is None
        and FOLLOWS not in (element.outside, element.incidence)
    ]


@dataclass(frozen=True)
class CriticalPlace:
    """An angle of incidence that methods fail next to. Units: draw in radians."""

    name: str
    called: str
    draw: DrawNear

    def region(self, distance: float) -> Region:
        """Return the boundaries at one distance, in radians.

        >>> samples = PLACES["grazing"].region(1e-3).samples(2)
        >>> samples.cos
        array([0.001, 0.001])
        """
        # Of one name, and so with the same media at every distance.
        return Region(self.name, lambda dice: self.draw(dice, distance))


def _near_critical(dice: Dice, distance: float) -> tuple[Floats, ...]:
    n, k = dice.even(0.2, 0.95), dice.some(dice.decades(1e-20, 1e-3))
    return n, k, *_next_to(dice, n / np.sqrt((1 - n) * (1 + n)), distance)


def _medium(dice: Dice) -> tuple[Floats, Floats]:
    return dice.even(0.1, 5), dice.some(dice.even(0.01, 8))


def _near_normal(dice: Dice, distance: float) -> tuple[Floats, ...]:
    return *_medium(dice), np.full(1, np.cos(distance)), np.full(1, np.sin(distance))


def _near_grazing(dice: Dice, distance: float) -> tuple[Floats, ...]:
    n, k, cos, sin = _near_normal(dice, distance)
    return n, k, sin, cos


_PLACES = (
    CriticalPlace("brewster", "Brewster's angle", _brewster),
    CriticalPlace("critical", "the critical angle", _near_critical),
    CriticalPlace("grazing", "grazing incidence", _near_grazing),
    CriticalPlace("normal", "the normal", _near_normal),
)
PLACES = {place.name: place for place in _PLACES}


def places_called(names: Sequence[str]) -> list[CriticalPlace]:
    """Return places by their names, each once."""
    OptipathError.raise_for([fault for name in names for fault in unknown("place", name, PLACES)])
    return [PLACES[name] for name in dict.fromkeys(names)]
