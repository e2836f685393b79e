"""Samples of uncertain values: normal, correlated, and within their ranges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, listed
from optipath.sweeps.uncertainty.correlation import root_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

_ROUNDS = 64
"""How often samples outside are drawn again."""


class DrawnSamples:
    """Samples of some values, one set of random numbers for every path of a batch.

    Where a value would leave its range, all values of that sample are drawn again, path by path:
    what is left is the normal distribution cut off at the ends. The same seed gives the same
    samples, however they are cut into blocks.

    Parameters
    ----------
    uncertain : tuple of UncertainValue
        What varies.
    correlation : ndarray, shape (k, k)
        The coefficients.
    count : int
        How many there are.
    seed : int
        Of NumPy's generator PCG64.
    axes : int
        How many axes the batch has.

    Attributes
    ----------
    outside : dict of str to int
        Of how many samples, drawn first, a value was outside its range for some path.
    """

    def __init__(
        self,
        uncertain: tuple[UncertainValue, ...],
        correlation: npt.NDArray[np.float64],
        count: int,
        seed: int,
        axes: int,
    ) -> None:
        self._uncertain, self._root = uncertain, root_of(correlation)
        self.count, self._axes = count, axes
        self._generator = np.random.Generator(np.random.PCG64(seed))
        self._rounds: list[npt.NDArray[np.float64]] = []
        self.outside = dict.fromkeys([each.name for each in uncertain], 0)

    def within(self, block: slice) -> dict[str, npt.NDArray[np.float64]]:
        """Return some samples of each value, an axis of them in front of the batch.

        Parameters
        ----------
        block : slice
            Which.

        Returns
        -------
        dict of str to ndarray

        Raises
        ------
        ParameterError
            If hardly any are within their range.
        """
        found = self._drawn(0, block)
        inside = {each.name: each.allows(found[each.name]) for each in self._uncertain}
        for name, allowed in inside.items():
            outer = ~allowed.reshape(allowed.shape[0], -1).all(axis=1)
            self.outside[name] += int(np.count_nonzero(outer))
        for number in range(1, _ROUNDS):
            bad = self._bad(found)
            if not np.any(bad):
                return found
            again = self._drawn(number, block)
            found = {name: np.where(bad, again[name], found[name]) for name in found}
        if np.any(self._bad(found)):
            narrow = [each.name for each in self._uncertain if each.leaves_its_range]
            raise ParameterError(
                f"hardly any sample of {listed(narrow)} is within the range; give a smaller "
                f"uncertainty, or a value farther inside"
            )
        return found

    def _bad(self, found: dict[str, Any]) -> Any:
        return ~np.logical_and.reduce(
            np.broadcast_arrays(*[each.allows(found[each.name]) for each in self._uncertain])
        )

    def _drawn(self, number: int, block: slice) -> dict[str, Any]:
        """Return what the samples are that are drawn for some round."""
        while len(self._rounds) <= number:
            shape = self.count, len(self._uncertain)
            self._rounds.append(self._generator.standard_normal(shape) @ self._root)
        found = {}
        for place, each in enumerate(self._uncertain):
            normal = self._rounds[number][block, place].reshape(-1, *(1,) * self._axes)
            found[each.name] = each.value + each.sigma * normal
        return found
