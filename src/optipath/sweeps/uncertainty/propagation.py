"""Light with its uncertainty, and where that comes from."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.sweeps.uncertainty.light_figures import STOKES, place_of
from optipath.sweeps.uncertainty.linearity import LARGEST
from optipath.sweeps.uncertainty.propagation_text import text_of_propagation
from optipath.values.arrays.read_only import Unchanging, locked, same

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

    Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Propagation(Unchanging):
    """Light, its standard uncertainty, and what contributes how much.

    Quantities are named as attributes of `Light`, ``"intensity"``, ``"dop"``, ``"dolp"``,
    ``"aop"``, ``"ellipticity"``, ``"psi"`` and ``"delta"``, or ``"S0"`` to ``"S3"``; angles are in
    radians. What is not defined is NaN, and `notes` say why. Arrays are read-only. Two are equal
    if all fields are, of which NaN equals NaN.

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

    def uncertainty_of(self, quantity: str) -> Array:
        """Return the standard uncertainty of a quantity, shape (...).

        Raises
        ------
        ParameterError
            If there is none of that name.

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

    def contributions_to(self, quantity: str) -> dict[str, Array]:
        """Return the share of each value in the variance of a quantity, by name, shape (...).

        To the first order they add up to 1, or are all 0 where nothing varies; where values are
        correlated a share may be negative. Of samples each is what is left when that value
        varies alone (JCGM 101:2008, annex B): the rest is what values do together.

        Raises
        ------
        ParameterError
            If there is no quantity of that name.
        """
        return self._by_name(self.shares[..., place_of(quantity), :])

    def nonlinearity_of(self, quantity: str) -> dict[str, Array]:
        """Return what the first order leaves of a quantity, by the value, shape (...).

        The change that slopes do not say, where a value is a standard uncertainty away from its
        best estimate, and with it another one, as a share of the uncertainty of the quantity.
        Infinite where slopes say that nothing varies, as at an extremum; 0 of samples.

        Raises
        ------
        ParameterError
            If there is no quantity of that name.
        """
        return self._by_name(self.left[..., place_of(quantity), :])

    def is_doubtful(self, quantity: str) -> npt.NDArray[np.bool_]:
        """Return where the first order is doubtful, shape (...): more than a tenth is left.

        Raises
        ------
        ParameterError
            If there is no quantity of that name.
        """
        doubtful = self.left[..., place_of(quantity), :] > LARGEST
        return np.asarray(doubtful.any(axis=-1))

    def __str__(self) -> str:
        """Return a table: quantities, uncertainties, shares; of a batch, from where to where."""
        shown = self.light, self.uncertain, self.uncertainties, self.shares
        return "\n".join([text_of_propagation(self.method, *shown), *self.notes])

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
