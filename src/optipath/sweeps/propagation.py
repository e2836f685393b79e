"""Propagation: light with its uncertainty and where it comes from, as a table."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.faults import listed
from optipath.light.quantities import QUANTITIES
from optipath.sweeps.first_order import FLAT, LARGEST
from optipath.sweeps.light_figures import STOKES, figures_of, place_of
from optipath.values.arrays import Unchanging, locked, same

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.light_figures import FigureName, UncertainValue

    Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Propagation(Unchanging):
    """Light, its standard uncertainty, and what contributes how much.

    Quantities are named as attributes of `Light`, ``"intensity"``, ``"dop"``, ``"dolp"``,
    ``"aop"``, ``"ellipticity"``, ``"psi"`` and ``"delta"``, or ``"S0"`` to ``"S3"``; angles are in
    radians; another name is a `ParameterError`. What is not defined is NaN, and `notes` say why.
    Arrays are read-only. Two are equal if all fields are, of which NaN equals NaN.

    Attributes
    ----------
    light : Light
        At the best estimates, of shape (...).
    mean : ndarray, shape (..., 4)
        The mean of the Stokes vectors: that of the samples, or, to the first order, of the light.
    covariance : ndarray, shape (..., 4, 4)
        Of the Stokes vector.
    uncertain : tuple of UncertainValue
        What was given with an uncertainty.
    method : str
        How it was found, such as ``"gradients by JAX"``.
    notes : tuple of str
        What is doubtful, a sentence each; none where all is well.
    uncertainties : ndarray, shape (..., 10)
        The standard uncertainty of S0 to S3, dop, dolp, aop, ellipticity, psi and delta.
    shares, left : ndarray, shape (..., 10, k)
        What `contributions_to` and `nonlinearity_of` return, by quantity and value.
    """

    light: Light
    mean: Array
    covariance: Array
    uncertain: tuple[UncertainValue, ...]
    method: str
    notes: tuple[str, ...]
    uncertainties: Array
    shares: Array
    left: Array

    def __post_init__(self) -> None:
        """Lock the arrays."""
        for each in fields(self):
            locked(getattr(self, each.name))

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [each.name for each in fields(self)]
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)

    __hash__ = None  # type: ignore[assignment]

    @property
    def uncertainty(self) -> Array:
        """The standard uncertainty of the Stokes vector, shape (..., 4)."""
        return self.uncertainties[..., :STOKES]

    def uncertainty_of(self, quantity: FigureName) -> Array:
        """Return the standard uncertainty of a quantity, shape (...).

        Examples
        --------
        >>> import optipath as op
        >>> malus = op.load_preset("malus")
        >>> found = malus.propagate(angle=("30 deg", "0.1 deg"), method="differences")
        >>> print(found.uncertainty_of("intensity").round(6))
        0.000756
        """
        return self.uncertainties[..., place_of(quantity)]

    @property
    def contributions(self) -> dict[str, Array]:
        """The share of each value in the variance of the Stokes vector, by name, shape (..., 4)."""
        return self._by_name(self.shares[..., :STOKES, :])

    def contributions_to(self, quantity: FigureName) -> dict[str, Array]:
        """Return the share of each value in the variance of a quantity, by name, shape (...).

        To the first order they add up to 1, or are all 0 where nothing varies; where values are
        correlated a share may be negative. Of samples each is what is left when that value
        varies alone (JCGM 101:2008, annex B): the rest is what values do together.
        """
        return self._by_name(self.shares[..., place_of(quantity), :])

    def nonlinearity_of(self, quantity: FigureName) -> dict[str, Array]:
        """Return what the first order leaves of a quantity, by the value, shape (...).

        The change that slopes do not say, where a value is a standard uncertainty away from its
        best estimate, and with it another one, as a share of the uncertainty of the quantity.
        Infinite where slopes say that nothing varies, as at an extremum; 0 of samples.
        """
        return self._by_name(self.left[..., place_of(quantity), :])

    def is_doubtful(self, quantity: FigureName) -> npt.NDArray[np.bool_]:
        """Return where the first order is doubtful, shape (...): more than a tenth is left."""
        doubtful = self.left[..., place_of(quantity), :] > LARGEST
        return np.asarray(doubtful.any(axis=-1))

    def __str__(self) -> str:
        """Return a table: quantities, uncertainties, shares; of a batch, from where to where."""
        values, names = figures_of(self.light), [each.name for each in self.uncertain]
        rows = [["", "value", "uncertainty", *names]]
        for place, quantity in enumerate(QUANTITIES):
            unit, factor = (" deg", _DEGREES) if quantity.unit == "rad" else ("", 1.0)
            value, spread = (n[..., place] * factor for n in (values, self.uncertainties))
            units = [unit if np.any(np.isfinite(n)) else "" for n in (value, spread)]
            texts = [_value(value, spread) + units[0], _span(spread, _digits) + units[1]]
            of_each = [_share(self.shares[..., place, each]) for each in range(len(names))]
            rows.append([quantity.variable, *texts, *of_each])
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = [
            "  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])])
            for row in rows
        ]
        shape = f", shape {self.light.shape}" if self.light.shape else ""
        head = f"{self.method}{shape}: {'; '.join(map(str, self.uncertain))}"
        return "\n".join([head, *lines, *self.notes])

    def __repr__(self) -> str:
        names = ", ".join(each.name for each in self.uncertain)
        return f"<Propagation of {names}: {self.method}, shape {self.light.shape}>"

    def _by_name(self, numbers: Array) -> dict[str, Array]:
        return {each.name: numbers[..., place] for place, each in enumerate(self.uncertain)}


def _same(first: Any, second: Any) -> bool:
    """Tell whether two fields are equal; what is not defined is equal to itself."""
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return np.array_equal(first, second, equal_nan=True)
    return same(first, second)


_DEGREES = 180.0 / math.pi


def _value(values: Any, spread: Any) -> str:
    """Write a value to the digit that its uncertainty has (JCGM 100:2008, sec. 7.2.6)."""
    if values.size != 1:
        return _span(values, "{:.4g}".format)
    value, one = float(values.item()), float(spread.item())
    places = _places(one) if math.isfinite(value) else -1
    return f"{value:.{places}f}" if 0 <= places <= 15 else f"{value:.6g}"


def _digits(number: float) -> str:
    """Write an uncertainty with two digits."""
    if number == 0.0 or not math.isfinite(number):
        return f"{number:g}"
    return f"{number:.{_places(number)}f}" if 0 <= _places(number) <= 6 else f"{number:.1e}"


def _places(number: float) -> int:
    """Return after how many decimal places the second digit of a number is; -1 if it has none."""
    if not math.isfinite(number) or number <= 0.0:
        return -1
    return 1 - math.floor(math.log10(float(f"{number:.1e}")))


def _share(shares: Any) -> str:
    return _span(100.0 * shares, "{:.0f}".format) + " %" * bool(np.any(np.isfinite(shares)))


def _span(numbers: Any, text: Any) -> str:
    """Write one number, or from where to where numbers are."""
    there = numbers[np.isfinite(numbers)] if numbers.size != 1 else np.ravel(numbers)
    if not there.size:
        return "nan"
    ends = [text(float(end)) for end in (there.min(), there.max())]
    return ends[0] if ends[0] == ends[1] else " .. ".join(ends)


_CURE = "method='monte-carlo' needs no slopes"


def notes_of_first_order(
    light: Light, uncertain: tuple[UncertainValue, ...], uncertainties: Any, left: Any
) -> list[str]:
    """Return what is doubtful to the first order, by what is left (..., 10, k)."""
    notes = [
        f"{each.name} is closer to the ends of its range, {each.range_text}, than its uncertainty, "
        f"and a normal distribution would leave it; {_CURE}, and stays inside"
        for each in uncertain
        if each.leaves_its_range
    ]
    for place, each in enumerate(uncertain):
        of_one = left[..., place]
        flat, curved = of_one > FLAT, (of_one > LARGEST) & (of_one <= FLAT)
        if np.any(flat):
            notes.append(
                f"doubtful along {each.name}: {_named(flat)}: no slope here, as at an extremum, "
                f"and yet a change within the uncertainty; {_CURE}"
            )
        if np.any(curved):
            most = f"{100.0 * np.max(of_one[curved]):.2g} %"
            notes.append(
                f"doubtful along {each.name}: {_named(curved)}: changes within the uncertainty "
                f"are not as the slope says, by up to {most} of the result; {_CURE}"
            )
    if np.any(corner := ~np.isnan(figures_of(light)) & np.isnan(uncertainties)):
        notes.append(
            f"nan: {_named(corner)}: a corner, as the degree of polarisation has in unpolarised "
            f"light, or a slope that is no number; {_CURE}"
        )
    return notes


def _named(where: Any) -> str:
    """Return the quantities for which something holds, and for how many values it does."""
    paths = where.reshape(-1, len(QUANTITIES))
    names = [
        each.variable for each, some in zip(QUANTITIES, paths.any(axis=0), strict=True) if some
    ]
    count = int(paths.any(axis=1).sum())
    return listed(names) + (f" (of {count} in {len(paths)} paths)" if len(paths) > 1 else "")


def notes_of_lost_figures(missing: Any) -> list[str]:
    """Return notes on figures (..., 10) that some samples do not have."""
    if not np.any(missing):
        return []
    return [f"nan: {_named(missing)}: some samples do not have it, as circular light has no AoP"]
