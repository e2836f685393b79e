"""Answers: the runners of a plan, and the frames and wavelengths of the light at its outlets.

Within a tolerance, a cheaper model runs where a certificate allows it, and the exact one elsewhere.
"""

from __future__ import annotations

from contextlib import suppress
from copy import deepcopy
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError
from optipath.faults import did_you_mean, shown
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.plan.noise import NoiseInterpreter, noise_at
from optipath.plan.questions import BoundsQuestion, LightQuestion, MatrixQuestion
from optipath.plan.reading import pieces, sliced
from optipath.plan.runnable import RunOptions
from optipath.plan.runner import runner_for
from optipath.values.arrays import locked
from optipath.values.curve_value import computed_values
from optipath.values.jax_values import is_traced
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from optipath.elements.vertex_place import VertexFrame
    from optipath.engines.program import Program
    from optipath.plan.certificate import Certificate
    from optipath.plan.inputs import Inputs
    from optipath.plan.questions import Question, StokesQuestion
    from optipath.plan.reading import Batch
    from optipath.plan.runner import Runner
    from optipath.values.parameters import Parameter
    from optipath.values.precision import Array


class Answers:
    """What answers all that a plan is asked."""

    def __init__(self, plan: Any) -> None:
        self.plan = plan
        self.question = LightQuestion(plan.program)
        self.wavelengths = wavelengths_among(plan.inputs)
        self.light = self._run_by(plan.program, unreduced=plan.reduction.unreduced)

    @cached_property
    def whole(self) -> Runner:
        """What gives matrices, and bounds of intensities."""
        return self._run_by(self.plan.whole)

    @cached_property
    def noise(self) -> NoiseInterpreter:
        """What finds the noise of light."""
        return NoiseInterpreter(self.plan.whole, self.light.dtype)

    @cached_property
    def approximation(self) -> Approximation | None:
        """What gives light by a cheaper model, where one is allowed."""
        instead = self.plan.instead
        if instead is None:
            return None
        program = self.plan.reduction.by(instead.model).program
        cheap = None if instead.model == "scalar" else self._run_by(program)
        errors = BoundsQuestion(self.plan.whole, instead.model)
        return Approximation(self.whole, errors, self.light, cheap, instead.most)

    @property
    def ran_by(self) -> tuple[str, ...]:
        """The engines that have given the last light; none before the first."""
        return (self.approximation or self.light).ran_by

    def lights(self, parameters: Mapping[str, Any]) -> dict[str, Any]:
        """Return the light at every end, as `LightQuestion` does."""
        return dict((self.approximation or self.light).answer(self.question, parameters))

    def stream(self, size: int, parameters: Mapping[str, Any]) -> Iterator[tuple[Any, Any]]:
        """Yield the index of each part of a batch, and the light at every end for it."""
        self.plan.inputs.warn_of_angles(parameters)
        if self.light.for_jax.is_requested(parameters):
            raise ParameterError(
                "a stream is not for JAX, which keeps a batch whole; use run, or engine 'numba'"
            )
        runner = self.approximation or self.light
        argument = runner.read(parameters)
        for piece in pieces(argument.shape, size):
            lights = runner.answer_for(self.question, argument.part(piece.where))
            yield piece.where, dict(lights)

    def matrix(self, source: str, end: str, parameters: Mapping[str, Any]) -> Any:
        """Return the Mueller matrices from a source to an end. Shape: returns (..., 4, 4)."""
        self.plan.inputs.warn_of_angles(parameters)
        return self.whole.answer(MatrixQuestion(self.plan.whole, source, end), parameters)

    def certificates(self, parameters: Mapping[str, Any]) -> dict[str, Certificate]:
        """Return the certificate of every end."""
        self.plan.inputs.warn_of_angles(parameters)
        argument = self.whole.read_for_bounds(parameters)
        return dict(self.whole.answer_for(BoundsQuestion(self.plan.whole), argument))

    def in_frames(
        self, lights: Mapping[str, Any], parameters: Mapping[str, Any], where: Any = ()
    ) -> dict[str, Light]:
        """Return the light at every end in its frame."""
        return {
            name: self.as_light(parameters, lights[name], reading.frame, where, name)
            for name, reading in self.plan.program.readings.items()
        }

    def as_light(
        self,
        parameters: Mapping[str, Any],
        stokes: Any,
        frame: Any,
        where: Any = (),
        end: str | None = None,
    ) -> Light:
        """Return light with the frame and wavelengths of a run; of an end, with its noise."""
        by, inputs = self.wavelengths, self.plan.inputs
        later = LaterWavelength(by, inputs, parameters, where) if by else None
        noise = None if end is None else (noise_at, self, end, parameters, where)
        frame = self.framed(frame, parameters, where)
        return Light.of(stokes, frame, noise=noise, wavelength=later)

    def framed(
        self, frame: Frame | VertexFrame, parameters: Mapping[str, Any], where: Any = ()
    ) -> Any:
        """Return a frame, or what makes it of the values that a run was given."""
        if isinstance(frame, Frame):
            return frame
        frame.refuse_changed()
        return LaterFrame(frame, self.plan.inputs, parameters, where)

    def _run_by(self, program: Program, *, unreduced: bool = False) -> Runner:
        plan = self.plan
        options = RunOptions(plan.method, plan.composing, plan.dtype, plan.chosen, plan.threads)
        return runner_for(program, plan.inputs, options, plan.own_ways, unreduced=unreduced)


def only(what: str, names: tuple[str, ...], cure: str, name: str | None = None) -> str:
    """Return the name that is given, or the only one.

    >>> only("detector", ("eye",), "run_all()")
    'eye'
    """
    if name is not None:
        if isinstance(name, str) and name in names:
            return name
        raise ParameterError(f"{what} {shown(name)} does not exist{did_you_mean(name, names)}")
    if len(names) != 1:
        raise ParameterError(f"the path has {len(names)} {what}s ({', '.join(names)}); use {cure}")
    return names[0]


def by_place(ends: tuple[Any, ...], unnamed: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return what is given by its place, but for names of sources and detectors.

    >>> by_place(("lamp", None), ()), by_place((0.3, None), (0.2,))
    ((), (0.3, 0.2))
    """
    return (*[end for end in ends if not isinstance(end, str | None)], *unnamed)


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
        return self.answer_for(question, self.read(parameters))

    def read(self, parameters: Mapping[str, Any]) -> Batch:
        """Return what is given as numbers."""
        return self.whole.read_for_bounds(parameters)

    def errors_for(self, parameters: Mapping[str, Any]) -> Array:
        """Return the largest error of the cheaper model, as a share of the intensity."""
        _, errors = self.whole.answer_for(self.errors, self.read(parameters))
        return errors  # type: ignore[no-any-return]

    def answer_for(self, question: Question, arguments: Batch) -> dict[str, Any]:
        """Return what is asked for numbers that have been read."""

        def run(runner: Runner, numbers: Batch) -> dict[str, Any]:
            self._ran = (*self._ran, runner)
            return dict(runner.answer_for(question, numbers))

        self._ran = ()
        scalar, error = self.whole.answer_for(self.errors, arguments)
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


class _Later:
    """What is made of the values of a run when somebody asks for it, once."""

    _made: Any

    def __init__(
        self, of: Any, inputs: Inputs, parameters: Mapping[str, Any], where: Any = ()
    ) -> None:
        self.of = of
        self.inputs = inputs
        self.where = where
        # The batch, of which the light is a part, depends on all of them.
        own = parameters if where else parameters.keys() & self.names
        self.parameters = {name: kept(parameters[name]) for name in own}

    def __call__(self) -> Any:
        """Return it; None if it is in doubt."""
        return self._made

    @property
    def names(self) -> Iterable[str]:
        """The parameters that it depends on."""
        names: Iterable[str] = self.of.names
        return names

    def value(self, name: str) -> Any:
        """Return what was given for a parameter, or its default."""
        return self.parameters.get(name, {**self.inputs.bound, **self.inputs.open}[name].default)

    def part(self, numbers: Any) -> Any:
        """Return the numbers of a part of the batch, if the light is of one."""
        if not self.where:
            return numbers
        return sliced(numbers, self._batch, self.where)

    @cached_property
    def _batch(self) -> tuple[int, ...]:
        return self.inputs.resolve(self.parameters)[1]


class LaterFrame(_Later):
    """Makes a `Frame` of a `VertexFrame`."""

    @cached_property
    def _made(self) -> Any:
        arguments = {name: self.inputs.numbers_for(name, self.value(name)) for name in self.names}
        arguments |= computed_values(self.inputs.computed, arguments)
        return self.of.frame(arguments, self.part if self.where else np.asarray)


def kept(value: Any) -> Any:
    """Return a value that was given, or a copy of what somebody may change.

    >>> given = np.ones(2)
    >>> kept(given) is given, kept(0.5)
    (False, 0.5)
    """
    if isinstance(value, np.ndarray):
        owner = value.base if isinstance(value.base, np.ndarray) else value
        if not (value.flags.writeable or owner.flags.writeable):
            return value
        # What is broadcast may be much larger than what it is made of.
        once = tuple([slice(None) if stride else slice(1) for stride in value.strides])
        return np.broadcast_to(value[once].copy(), value.shape)
    with suppress(RecursionError, MemoryError):  # What is too much is refused by the run.
        return deepcopy(value) if isinstance(value, list) else value
    return value


USUAL = "wavelength"
"""The name that the wavelength of a path has."""


def wavelengths_among(inputs: Inputs) -> tuple[Parameter, ...]:
    """Return the parameters by which light may have its wavelength."""
    several = {**inputs.bound, **inputs.open}
    if inputs.per_nanometre:
        return tuple([several[name] for name in inputs.per_nanometre])
    usual = several.get(USUAL)
    if inputs.dimensions.get(USUAL, "length") != "length":
        usual = None
    return tuple([one for one in several.values() if one is usual or isinstance(one, Wavelength)])


class LaterWavelength(_Later):
    """Finds the wavelengths of light, in meters, which broadcast to the batch."""

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that may give them; where one does, it does."""
        return tuple([one.name for one in self.of])

    @property
    def in_doubt(self) -> tuple[str, ...]:
        """The names of the parameters that may all give them; none where one does."""
        return self.names if len(self.of) > 1 else ()

    @cached_property
    def _made(self) -> Any:
        if self.in_doubt:
            return None
        result, present = self.of[0].resolve(self.value(self.of[0].name))
        result = self.part(result if np.all(present) else np.where(present, result, np.nan))
        return result if is_traced(result) else locked(np.array(result, np.float64))
