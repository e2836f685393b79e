"""Answers: the runners of a plan, and which source or detector is meant."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, did_you_mean, shown
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.plan.inputs import LargeAngles
from optipath.plan.noise import noise_at
from optipath.plan.outlets import LaterFrame, LaterWavelength, wavelengths_among
from optipath.plan.questions import BoundsQuestion, ErrorsQuestion, LightQuestion, MatrixQuestion
from optipath.plan.reading import RunOptions
from optipath.plan.runner import runner_for

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.elements.vertex_place import VertexFrame
    from optipath.engines.program import Program, Reading
    from optipath.plan.approximation import Approximation
    from optipath.plan.certificate import Certificate
    from optipath.plan.noise import NoiseInterpreter
    from optipath.plan.runner import Runner


class Answers:
    """What answers all that a plan is asked."""

    def __init__(self, plan: Any) -> None:
        self.plan = plan
        self.large_angles = LargeAngles(plan.inputs)
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
        from optipath.plan.noise import NoiseInterpreter  # noqa: PLC0415 - hardly ever needed

        return NoiseInterpreter(self.plan.whole, self.light.dtype)

    @cached_property
    def approximation(self) -> Approximation | None:
        """What gives light by a cheaper model, where one is allowed."""
        instead = self.plan.instead
        if instead is None:
            return None
        from optipath.plan.approximation import Approximation  # noqa: PLC0415 - hardly ever needed

        program = self.plan.reduction.by(instead.model).program
        cheap = None if instead.model == "scalar" else self._run_by(program)
        errors = ErrorsQuestion(self.plan.whole, instead.model)
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
        self.large_angles.look(parameters)
        return (self.approximation or self.light).stream(self.question, size, parameters)

    def matrix(self, source: str, reading: Reading, parameters: Mapping[str, Any]) -> Any:
        """Return the Mueller matrices from a source to a reading. Shape: returns (..., 4, 4)."""
        self.large_angles.look(parameters)
        question = MatrixQuestion(self.plan.whole, source, reading)
        return self.whole.answer(question, parameters)

    def certificates(self, parameters: Mapping[str, Any]) -> dict[str, Certificate]:
        """Return the certificate of every end."""
        self.large_angles.look(parameters)
        argument = self.whole.read_for_bounds(parameters)
        return dict(self.whole.answer_for(BoundsQuestion(self.plan.whole), argument, parameters))

    def in_frames(
        self, lights: Mapping[str, Any], parameters: Mapping[str, Any], where: Any = ()
    ) -> dict[str, Light]:
        """Return the light at every end in its frame."""
        results = {}
        by = self.wavelengths
        later = LaterWavelength(by, self.plan.inputs, parameters, where) if by else None
        for name, reading in self.plan.program.readings.items():
            frame = self.framed(reading.frame, parameters, where)
            noise = (noise_at, self, name, parameters, where)
            results[name] = Light.of(lights[name], frame, noise=noise, wavelength=later)
        return results

    def as_light(self, parameters: Mapping[str, Any], stokes: Any, frame: Any) -> Light:
        """Return light of Stokes vectors (..., 4), with the frame and wavelengths of a run."""
        by = self.wavelengths
        later = LaterWavelength(by, self.plan.inputs, parameters) if by else None
        return Light.of(stokes, self.framed(frame, parameters), wavelength=later)

    def framed(
        self, frame: Frame | VertexFrame, parameters: Mapping[str, Any], where: Any = ()
    ) -> Any:
        """Return a frame, or what makes it of the values that a run was given."""
        if isinstance(frame, Frame):
            return frame
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
