"""Approximation: a cheaper model where a certificate allows it, and the exact one elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.running.found import Found
from optipath.plan.running.pieces import pieces

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.plan.execution import Execution
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.plan.whole_path import WholePath

    Array = np.ndarray[Any, Any]

_MOST = 0.5
"""From which share of paths that need the exact model it is run for all."""


class Approximation:
    """Runs a model that is not exact, path by path, as far as a tolerance allows.

    Parameters
    ----------
    whole : WholePath
        Computes the bounds.
    exact : Execution
        Runs the exact model.
    cheap : Execution or None
        Runs the cheaper model; None for the scalar one, which comes with the bounds.
    model : str
        The name of the cheaper model.
    tolerance : float
        How large its error may be, as a share of the intensity.
    """

    def __init__(
        self,
        whole: WholePath,
        exact: Execution,
        cheap: Execution | None,
        model: str,
        tolerance: float,
    ) -> None:
        self.whole = whole
        self.exact = exact
        self.cheap = cheap
        self.model = model
        self.tolerance = tolerance

    def lights(self, parameters: Mapping[str, Any]) -> dict[str, Found]:
        """Return the light at every detector."""
        if self.exact.is_for_jax(parameters):
            return self.exact.lights(parameters)
        return self._of(self.whole.given(parameters), parameters)

    def stream(
        self, size: int, parameters: Mapping[str, Any]
    ) -> Iterator[tuple[Any, dict[str, Found]]]:
        """Yield the index of a part of the batch, and the light at every end for it."""
        if self.exact.is_for_jax(parameters):
            yield from self.exact.stream(size, parameters)
            return
        given = self.whole.given(parameters)
        for piece in pieces(given.batch, size):
            yield piece.where, self._of(given.part(piece.where), parameters)

    def _of(self, given: ResolvedInputs, parameters: Mapping[str, Any]) -> dict[str, Found]:
        scalar, error = self.whole.errors(self.model, given, parameters)
        beyond = ~(error <= self.tolerance)
        share = np.count_nonzero(beyond) / max(beyond.size, 1)
        if share == 1.0:
            return self.exact.lights_of(given, parameters)
        if self.cheap is None:
            cheap = {n: Found((total, np.nan, np.nan, np.nan), 0) for n, total in scalar.items()}
        else:
            cheap = self.cheap.lights_of(given, parameters)
        if not share:
            return cheap
        if share > _MOST:
            whole = self.exact.lights_of(given, parameters)
            return {n: _mixed(cheap[n], whole[n], beyond, beyond) for n in cheap}
        some = self.exact.lights_of(given.part((beyond,)), parameters)
        return {n: _mixed(cheap[n], some[n], beyond, ...) for n in cheap}


def _mixed(cheap: Found, exact: Found, beyond: Array, of_exact: Any) -> Found:
    """Return one light with that of another in some places."""
    stokes, exponent = (np.array(part) for part in cheap.whole(beyond.shape))
    other, power = exact.whole(beyond.shape if of_exact is beyond else (beyond.sum(),))
    stokes[beyond], exponent[beyond] = other[of_exact], power[of_exact]
    return Found(stokes, exponent)
