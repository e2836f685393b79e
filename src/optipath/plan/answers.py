"""Answers: the runners of a plan, and what each of them is asked."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from optipath.light.frames import Frame
from optipath.light.light import Light
from optipath.plan.light_noise import noise_at
from optipath.plan.running.options import RunOptions
from optipath.plan.running.outlet_frames import LaterFrame
from optipath.plan.running.outlet_wavelengths import LaterWavelength, wavelengths_among
from optipath.plan.running.questions import (
    BoundsQuestion,
    ErrorsQuestion,
    LightQuestion,
    MatrixQuestion,
)
from optipath.plan.running.shared import runner_for
from optipath.values.large_angles import LargeAngles

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.elements.vertices.frame import VertexFrame
    from optipath.engines.program.program import Program, Reading
    from optipath.plan.approximation import Approximation
    from optipath.plan.certificate import Certificate
    from optipath.plan.running.noise_interpreter import NoiseInterpreter
    from optipath.plan.running.runner import Runner


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
        from optipath.plan.running.noise_interpreter import NoiseInterpreter  # noqa: PLC0415 - hardly ever needed

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

    def lights(self, parameters: Mapping[str, Any]) -> dict[str, tuple[Any, Any]]:
        """Return the light at every end, as Stokes vectors and exponents."""
        if self.large_angles.looks:
            self.large_angles.look(parameters)
        return dict((self.approximation or self.light).answer(self.question, parameters))

    def stream(self, size: int, parameters: Mapping[str, Any]) -> Iterator[tuple[Any, Any]]:
        """Yield the index of each part of a batch, and the light at every end for it."""
        self.large_angles.look(parameters)
        return (self.approximation or self.light).stream(self.question, size, parameters)

    def matrix(self, source: str, reading: Reading, parameters: Mapping[str, Any]) -> Any:
        """Return the Mueller matrices from a source to a reading.

        Shape: returns (..., 4, 4).
        """
        self.large_angles.look(parameters)
        question = MatrixQuestion(self.plan.whole, source, reading)
        return self.whole.answer(question, parameters)

    def certificates(self, parameters: Mapping[str, Any]) -> dict[str, Certificate]:
        """Return the certificate of every end."""
        self.large_angles.look(parameters)
        given = self.whole.read_for_bounds(parameters)
        return dict(self.whole.answer_for(BoundsQuestion(self.plan.whole), given, parameters))

    def in_frames(
        self, lights: Mapping[str, tuple[Any, Any]], parameters: Mapping[str, Any], where: Any = ()
    ) -> dict[str, Light]:
        """Return the light at every end in its frame."""
        found = {}
        by = self.wavelengths
        later = LaterWavelength(by, self.plan.inputs, parameters, where) if by else None
        for name, reading in self.plan.program.readings.items():
            stokes, exponent = lights[name]
            frame = self.framed(reading.frame, parameters, where)
            noise = (noise_at, self, name, parameters, where)
            found[name] = Light.of(stokes, frame, exponent, noise, wavelength=later)
        return found

    def as_light(self, parameters: Mapping[str, Any], stokes: Any, frame: Any) -> Light:
        """Return light of Stokes vectors by themselves, with the frame and wavelengths of a run.

        Shape: stokes (..., 4).
        """
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
