"""Certificate: how far an intensity can be from what it would be without polarisation.

Where a certificate allows it, a cheaper model is run, and the exact one elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, ValueFault, collecting
from optipath.kernels.carriers.intensities import Boosts, boosted, largest_error, ratio_bounds
from optipath.kernels.primitives import NUMPY
from optipath.light.polarization_state import underflows
from optipath.values.arrays import check_broadcast, entries_of, same_fields
from optipath.values.domains import Domain

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy.typing as npt

    from optipath.plan.questions import Question, StokesQuestion
    from optipath.plan.reading import Batch
    from optipath.plan.runner import Runner

    Array = np.ndarray[Any, Any]


_DOP = Domain("degree of polarisation", minimum=0.0, maximum=1.0)
_DIATTENUATION = Domain("diattenuation", minimum=-1.0, maximum=1.0)


@dataclass(frozen=True, eq=False)
class Certificate:
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

    __eq__ = same_fields
    __hash__ = None  # type: ignore[assignment]

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
        with collecting(faults, ValueFault):
            numbers[name] = domain.check(name, value)
    if faults:
        raise ParameterError(*faults)
    check_broadcast({name: number.shape for name, number in numbers.items()})
    first, *others = map(np.abs, numbers.values())
    boosts = reduce(lambda result, t: boosted(NUMPY, result, t), others, Boosts(first))
    lower, upper = ratio_bounds(NUMPY, boosts)
    return np.asarray(lower), np.asarray(upper)


_MOST = 0.5
"""From which share of paths that need the exact model it is run for all."""


@dataclass(eq=False, repr=False)
class Approximation:
    """Runs an inexact model path by path within a tolerance: first its errors, then the light."""

    whole: Runner
    errors: Question
    exact: Runner
    cheap: Runner | None
    tolerance: float
    _ran: tuple[Runner, ...] = ()

    @property
    def ran_by(self) -> tuple[str, ...]:
        """The engines that have given the last light; none before the first."""
        return tuple(dict.fromkeys(engine for one in self._ran for engine in one.ran_by))

    def answer(self, question: StokesQuestion, parameters: Mapping[str, Any]) -> Any:
        """Return what is asked for."""
        if self.exact.for_jax.is_requested(parameters):
            self._ran = (self.exact,)
            return self.exact.answer(question, parameters)
        return self.answer_for(question, self.read(parameters), parameters)

    def read(self, parameters: Mapping[str, Any]) -> Batch:
        """Return what is given as numbers."""
        return self.whole.read_for_bounds(parameters)

    def errors_for(self, parameters: Mapping[str, Any]) -> Array:
        """Return the largest error of the cheaper model, as a share of the intensity."""
        _, errors = self.whole.answer_for(self.errors, self.read(parameters), parameters)
        return errors  # type: ignore[no-any-return]

    def answer_for(
        self,
        question: Question,
        arguments: Batch,
        parameters: Mapping[str, Any],
        *,
        ahead: int = 0,
    ) -> dict[str, Any]:
        """Return what is asked for numbers that have been read."""

        def run(runner: Runner, numbers: Batch) -> dict[str, Any]:
            self._ran = (*self._ran, runner)
            answer = runner.answer_for(question, numbers, parameters, ahead=ahead)
            return dict(answer)

        self._ran = ()
        scalar, error = self.whole.answer_for(self.errors, arguments, parameters, ahead=ahead)
        beyond = ~(error <= self.tolerance)
        share = np.count_nonzero(beyond) / max(beyond.size, 1)
        if share == 1.0:
            return run(self.exact, arguments)
        if self.cheap is None:
            self._ran = (self.whole,)
            cheap = {n: (total, np.nan, np.nan, np.nan) for n, total in scalar.items()}
        else:
            cheap = run(self.cheap, arguments)
        if not share:
            return cheap
        if share > _MOST:
            whole = run(self.exact, arguments)
            return {n: _mixed(cheap[n], whole[n], beyond, beyond) for n in cheap}
        some = run(self.exact, arguments.part((beyond,)))
        return {n: _mixed(cheap[n], some[n], beyond, ...) for n in cheap}


def _mixed(cheap: Any, exact: Any, beyond: Array, of_exact: Any) -> Array:
    """Return one light with that of another in some places."""
    stokes = np.array(_whole(cheap, beyond.shape))
    batch = beyond.shape if of_exact is beyond else (int(beyond.sum()),)
    stokes[beyond] = _whole(exact, batch)[of_exact]
    return stokes


def _whole(stokes: Any, batch: tuple[int, ...]) -> Array:
    """Return the Stokes vectors (..., 4) of light as an array."""
    if isinstance(stokes, tuple):
        kind = np.result_type(stokes[0])
        parts = [np.broadcast_to(np.asarray(part, kind), batch) for part in stokes]
        stokes = np.stack(parts, axis=-1)
    return stokes  # type: ignore[no-any-return]
