"""Certificate: how far an intensity can be from what it would be without polarisation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, ValueFault
from optipath.kernels.carriers.intensities import Boosts, boosted, largest_error, ratio_bounds
from optipath.kernels.primitives import NUMPY
from optipath.light.polarization_state import underflows
from optipath.values.arrays import ComparedByFields, check_broadcast, entries_of
from optipath.values.domains import Domain

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt


_DOP = Domain("degree of polarisation", minimum=0.0, maximum=1.0)
_DIATTENUATION = Domain("diattenuation", minimum=-1.0, maximum=1.0)


@dataclass(frozen=True, eq=False)
class Certificate(ComparedByFields):
    """Bounds of the true intensity over that of the scalar model, for each path of a batch.

    Attributes
    ----------
    scalar : ndarray, shape (...)
        The intensity without polarisation: each element dims light by its mean, a stack of
        layers by that of the whole stack.
    lower, upper : ndarray, shape (...)
        The true intensity is within ``lower * scalar .. upper * scalar``.
    """

    scalar: npt.NDArray[Any]
    lower: npt.NDArray[Any]
    upper: npt.NDArray[Any]

    @property
    def error(self) -> npt.NDArray[Any]:
        """The largest error that the scalar model can have, as a share of either intensity.

        Infinite where light is so faint that its scalar intensity has lost digits.
        """
        return self.error_of("scalar")

    def error_of(self, model: str) -> npt.NDArray[Any]:
        """Return the largest error of a model by name that drops components."""
        error = largest_error(NUMPY, self.lower, self.upper, model)
        return np.where(underflows(self.scalar), np.inf, error)


def intensity_bounds(
    source_dop: npt.ArrayLike, diattenuations: Sequence[npt.ArrayLike]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Return bounds of the true intensity of a chain over that without polarisation.

    With u = artanh(source DoP), d_i = artanh(diattenuation of element i), it is
    cosh(eta) / (cosh u prod cosh d_i), where max(0, 2 max - sum) <= eta <= sum over {u, d_i}:
    the tightest bounds that can be had without knowing how the elements stand to each other.
    They hold for elements that do not depolarise.

    Parameters
    ----------
    source_dop : array_like, shape (...)
        The degree of polarisation of the source, 0 to 1.
    diattenuations : sequence of array_like, shape (...)
        (Fs - Fp) / (Fs + Fp) of each element, -1 to 1, such as B / A of a reflection.

    Returns
    -------
    lower, upper : ndarray, shape (...)

    Raises
    ------
    ParameterError
        If a number is out of its range.

    Examples
    --------
    Unpolarised light on two polarisers passes at most twice as often as on two grey filters:

    >>> lower, upper = intensity_bounds(0.0, [1.0, 1.0])
    >>> print(lower, upper)
    0.0 2.0
    """
    several = entries_of("diattenuations", "numbers", diattenuations, ParameterError)
    arguments = {"source_dop": (source_dop, _DOP)}
    arguments |= {f"diattenuations[{i}]": (d, _DIATTENUATION) for i, d in enumerate(several)}
    numbers: dict[str, npt.NDArray[Any]] = {}
    faults: list[str] = []
    for name, (value, domain) in arguments.items():
        with ValueFault.collecting(faults):
            numbers[name] = domain.check(name, value)
    ParameterError.raise_for(faults)
    check_broadcast({name: number.shape for name, number in numbers.items()})
    first, *others = map(np.abs, numbers.values())
    boosts = reduce(lambda result, t: boosted(NUMPY, result, t), others, Boosts(first))
    lower, upper = ratio_bounds(NUMPY, boosts)
    return np.asarray(lower), np.asarray(upper)
