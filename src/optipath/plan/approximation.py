"""Approximation: a cheaper model where a certificate allows it, and the exact one elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.plan.reading import pieces

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.plan.questions import Question
    from optipath.plan.reading import Batch
    from optipath.plan.runner import Runner

    Array = np.ndarray[Any, Any]


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

    def answer(self, question: Question, parameters: Mapping[str, Any]) -> Any:
        """Return what is asked for."""
        if self.exact.for_jax.is_requested(parameters):
            self._ran = (self.exact,)
            return self.exact.answer(question, parameters)
        return self._of(question, self.whole.read_for_bounds(parameters), parameters)

    def stream(
        self, question: Question, size: int, parameters: Mapping[str, Any]
    ) -> Iterator[tuple[Any, Any]]:
        """Yield what is asked for, part by part."""
        if self.exact.for_jax.is_requested(parameters):
            yield from self.exact.stream(question, size, parameters)
            return
        argument = self.whole.read_for_bounds(parameters)
        for piece in pieces(argument.shape, size):
            part = argument.part(piece.where)
            yield piece.where, self._of(question, part, parameters, argument.paths)

    def errors_for(self, parameters: Mapping[str, Any]) -> Array:
        """Return the largest error of the cheaper model, as a share of the intensity."""
        argument = self.whole.read_for_bounds(parameters)
        _, errors = self.whole.answer_for(self.errors, argument, parameters)
        return errors  # type: ignore[no-any-return]

    def _of(
        self,
        question: Question,
        arguments: Batch,
        parameters: Mapping[str, Any],
        ahead: int = 0,
    ) -> dict[str, Any]:
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
