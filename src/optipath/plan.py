"""Plan: a composed path, run as often as one likes with other parameter values."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines import batches
from optipath.errors import ParameterError, did_you_mean
from optipath.explanation import Explanation, parameter_lines, steps_of
from optipath.light import Light
from optipath.mueller import Mueller

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from optipath.approximation import Approximation
    from optipath.certificate import Certificate
    from optipath.execution import Execution, Found
    from optipath.frames import Frame
    from optipath.inputs import Inputs
    from optipath.program import Program
    from optipath.reduction import Reduction, Tolerance


_FEW = 8
"""Of how many ends the bounds are written down."""

_LARGE = 1 << 30
"""A batch for which any engine is worth its while."""

_MADE = ("_approximation", "_detector", "_execution")


class Part(NamedTuple):
    """A part of a batch: its index in arrays of the batch's shape, and its light."""

    where: tuple[int | slice, ...]
    light: Light


@dataclass(frozen=True)
class Plan:
    """What a composer makes of a path: steps in order, and nothing of the graph.

    Attributes
    ----------
    whole : Program
        The path as it stands.
    reduction : Reduction
        What is left of it for what the detectors read.
    inputs : Inputs
        The parameters that are open, and what may be given for them.
    outlets : tuple of str
        Ports whose light leaves the path unread.
    copied : tuple of str
        Ports whose light goes to several links, whole to each.
    instead : Tolerance or None
        What is taken in its place where a certificate allows it.
    tolerance : float or None
        What the composer was given.
    method, composing, dtype : str
        How Fresnel's equations are computed, whether light is carried as Stokes or as Jones
        vectors, and in which precision.
    chosen : str
        The engine that the composer was asked for.
    threads : int
        How many threads share a large batch.
    """

    whole: Program
    reduction: Reduction
    inputs: Inputs
    outlets: tuple[str, ...]
    copied: tuple[str, ...]
    method: str
    composing: str
    dtype: str
    chosen: str = "auto"
    threads: int = 1
    instead: Tolerance | None = None
    tolerance: float | None = None

    @property
    def program(self) -> Program:
        """The steps that are run."""
        return self.reduction.program

    @property
    def model(self) -> str:
        """What is carried along: ``"scalar"``, ``"sp"``, ``"linear"`` or ``"full"``.

        With a tolerance, what is carried wherever a certificate allows it.
        """
        return self.instead.model if self.instead else self.reduction.model

    @property
    def engine(self) -> str:
        """What runs large batches; `engine_for` says what runs smaller ones."""
        return self.engine_for(_LARGE).partition(",")[0]

    def engine_for(self, count: int, /) -> str:
        """Return what runs a batch of so many paths.

        Examples
        --------
        >>> import optipath as op
        >>> plan = op.Composer(engine="numpy").compose(op.load_preset("malus"))
        >>> plan.engine, plan.engine_for(10)
        ('numpy', 'numpy, step by step')
        """
        return self._execution.engine_for(count)

    def run(self, /, **parameters: Any) -> Light:
        """Return the light at the only detector.

        Parameters
        ----------
        **parameters : float or array_like
            In radians and metres; arrays broadcast together.

        Returns
        -------
        Light
            ``stokes`` has the broadcast shape of all values with 4 behind it.

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter, or if there are
            several detectors.
        """
        name, place, frame = self._detector
        if self.instead is not None:
            return self.run_all(**parameters)[name]
        execution = self._execution
        usual = execution.single.usual(parameters)
        if usual is not None:
            return Light.of(usual[place][:4], frame, usual[place][4])
        light = execution.lights(parameters)[name]
        return Light.of(light.stokes, frame, light.exponent)

    def run_all(self, /, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and every dump, by name.

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter.
        """
        return self._in_frames(self._runner.lights(parameters))

    def stream(self, size: int = 1 << 20, /, **parameters: Any) -> Iterator[Part]:
        """Yield the light of a batch part by part, in memory that the parts need.

        Parameters
        ----------
        size : int, optional
            How many paths a part has at most.
        **parameters : float or array_like
            As in `run`. A grid is given by axes that broadcast, such as shapes (m, 1) and
            (n,), and is never laid out as a whole.

        Yields
        ------
        Part
            ``where``, its index in arrays of the batch's shape, and ``light``.

        Raises
        ------
        ParameterError
            As `run`; of values outside their range when their part is met.

        Examples
        --------
        >>> import optipath as op
        >>> plan = op.load_preset("malus").compose()
        >>> [part.where for part in plan.stream(2, angle=[0.0, 0.1, 0.2])]
        [(slice(0, 2, None),), (slice(2, 3, None),)]
        """
        name, _, _ = self._detector
        if isinstance(size, bool) or not isinstance(size, int) or size < 1:
            raise ParameterError(f"the size of a part must be a whole number above 0, not {size!r}")
        for where, lights in self._runner.stream(size, parameters):
            yield Part(where, self._in_frames(lights)[name])

    def _in_frames(self, lights: Mapping[str, Found]) -> dict[str, Light]:
        return {
            name: Light.of(lights[name].stokes, reading.frame, lights[name].exponent)
            for name, reading in self.program.readings.items()
        }

    def mueller(
        self, source: str | None = None, detector: str | None = None, /, **parameters: Any
    ) -> Mueller:
        """Return the Mueller matrix from one source to one detector.

        Entries too small for a float are 0; `run` keeps light however faint.

        Parameters
        ----------
        source, detector : str, optional
            Their names; needed only where there are several.
        **parameters : float or array_like
            As in `run`.

        Raises
        ------
        ParameterError
            As in `run`, or if a source or detector is not named or not known.
        """
        program = self.whole
        begin = self._only("source", tuple(program.sources), "mueller(source, detector)", source)
        ends = tuple(program.readings if detector else program.detectors)
        end = self._only("detector", ends, "mueller(source, detector)", detector)
        reading = program.readings[end]
        matrix = self._execution.matrix(begin, reading, parameters)
        return Mueller(matrix, program.sources[begin][1], reading.frame)

    def certificate(self, detector: str | None = None, /, **parameters: Any) -> Certificate:
        """Return how far the intensity at a detector can be from that without polarisation.

        Parameters
        ----------
        detector : str, optional
            Its name; needed only where there are several.
        **parameters : float or array_like
            As in `run`.

        Raises
        ------
        ParameterError
            As in `run`, or if a detector is not named or not known.

        Examples
        --------
        >>> import numpy as np
        >>> import optipath as op
        >>> gold = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
        >>> found = op.load_preset("npgr026").compose().certificate(**gold, phi=[0.2, 1.2])
        >>> print(found.error.round(5))
        [3.00e-05 1.27e-03]
        """
        ends = tuple(self.whole.readings if detector else self.whole.detectors)
        end = self._only("detector", ends, "certificate(detector)", detector)
        execution = self._execution
        return execution.certificates(execution.given(parameters), parameters)[end]

    def explain(self) -> str:
        """Return the plan in words: its steps in order, what it reads, what leaves unread.

        Examples
        --------
        >>> import optipath as op
        >>> plan = op.Composer(engine="numpy").compose(op.load_preset("malus"))
        >>> print(plan.explain().splitlines()[0])
        1 source, 1 detector, 5 steps; method stable, model linear, engine numpy, float64
        """
        return str(self.explanation())

    def explanation(self) -> Explanation:
        """Return the plan explained, part by part, as `explain` writes it down."""
        ends = self.program.readings
        names = {"detector": self.program.detectors, "dump": self.program.dumps}
        counts = {"source": len(self.program.sources)}
        counts |= {what: len(found) for what, found in names.items()}
        return Explanation(
            counts={**counts, "step": len(self.program.steps)},
            manner={
                "method": self.method,
                "model": self.model,
                "engine": self.engine,
                "dtype": self.dtype,
                "composing": self.composing,
            },
            reason=self._why(),
            steps=steps_of(self.reduction),
            reads={n: tuple(f"S{i}" for i in range(end.components)) for n, end in ends.items()},
            light_at={name: end.light for name, end in ends.items()},
            folded=self.reduction.folded,
            operations=self._execution.operations(),
            certificate=self._certified(),
            tolerance=self._tolerated(),
            notes=tuple(self._notes()),
            parameters=parameter_lines(self.inputs),
        )

    def _why(self) -> str:
        if self.instead is None:
            return self.reduction.reason
        exact = self.reduction
        return f"where its certificate allows it; exact is '{exact.model}': {exact.reason}"

    def _tolerated(self) -> dict[str, Any] | None:
        if self.tolerance is None:
            return None
        exact = self.reduction.model
        if self.instead is not None:
            text = (
                f"model {self.instead.model} where its certificate is within it, {exact} elsewhere"
            )
        elif self.model == "scalar":
            text = "not needed, the scalar model is exact"
        else:
            text = "not used, since certificates are for intensities, and more is read"
        return {"most": self.tolerance, "model": self.model, "otherwise": exact, "text": text}

    def _certified(self) -> dict[str, Any] | None:
        """Return the bounds for the values that are known, and defaults for others."""
        opened = self.inputs.open.values()
        missing = [parameter.name for parameter in opened if parameter.default is None]
        if missing:
            return {"text": f"depends on {', '.join(missing)}; see plan.certificate(...)"}
        execution = self._execution
        found = execution.certificates(execution.given({}), {})
        bounds = {
            name: {"lower": float(np.min(one.lower)), "upper": float(np.max(one.upper))}
            for name, one in found.items()
        }
        if len(bounds) > _FEW:
            return {"bounds": bounds, "text": f"for {len(bounds)} ends; see plan.certificate(...)"}
        texts = [
            f"at {name}, S0 is {each['lower']:.6g} .. {each['upper']:.6g} of the scalar model's"
            for name, each in bounds.items()
        ]
        at = ", for the defaults" if self.inputs.open else ""
        return {"bounds": bounds, "text": "; ".join(texts) + at}

    def _notes(self) -> Iterator[str]:
        yield from (f"{port} has no link: its light leaves the path" for port in self.outlets)
        if self.engine_for(_LARGE) != self.engine:
            yield (
                f"all batches are run step by step: paths of at most {self._execution.longest} "
                f"steps are compiled, in float64 and float32, if all elements compute with xp alone"
            )
        elif self.chosen != "jax":
            yield batches(self.chosen)
        yield from (f"{port} feeds several links: each takes all its light" for port in self.copied)

    def evaluations(self, /, **parameters: Any) -> dict[str, int]:
        """Return how often each step's numbers are computed for a batch.

        An element is evaluated only along those axes of a batch on which it depends: an
        interface that sees one of the two axes of a grid once for each value on it, and one
        without open values once.

        Raises
        ------
        ParameterError
            As `run`.

        Examples
        --------
        >>> import numpy as np
        >>> import optipath as op
        >>> plan = op.load_preset("npgr026").compose()
        >>> delta, phi = np.linspace(0, 1, 1000)[:, np.newaxis], np.linspace(0, 1, 1000)
        >>> found = plan.evaluations(delta=delta, phi=phi)
        >>> found["X1.reflected"], found["X2.reflected"]
        (1000, 1000)
        """
        return self._execution.evaluations(parameters)

    @cached_property
    def _detector(self) -> tuple[str, int, Frame]:
        """The name of the only detector, its place among the ends, and its frame."""
        name = self._only("detector", tuple(self.program.detectors), "run_all()")
        place = list(self.program.readings).index(name)
        return name, place, self.program.detectors[name].frame

    @cached_property
    def _execution(self) -> Execution:
        return self._executed(self.reduction)

    @cached_property
    def _approximation(self) -> Approximation | None:
        if self.instead is None:
            return None
        # Imported where it is needed, so that the library itself is there quickly.
        from optipath.approximation import Approximation  # noqa: PLC0415

        model = self.instead.model
        cheap = None if model == "scalar" else self._executed(self.reduction.by(model))
        return Approximation(self._execution, cheap, model, self.instead.most)

    @property
    def _runner(self) -> Execution | Approximation:
        return self._approximation or self._execution

    def _executed(self, reduction: Reduction) -> Execution:
        # Imported where it is needed, so that the library itself is there quickly.
        from optipath.execution import Execution  # noqa: PLC0415

        return Execution(
            reduction,
            self.whole,
            self.inputs,
            method=self.method,
            composing=self.composing,
            dtype=self.dtype,
            engine=self.chosen,
            threads=self.threads,
        )

    def __getstate__(self) -> dict[str, Any]:
        # What has been compiled stays here.
        return {name: value for name, value in self.__dict__.items() if name not in _MADE}

    @staticmethod
    def _only(what: str, names: tuple[str, ...], cure: str, name: str | None = None) -> str:
        if name is not None:
            if name not in names:
                raise ParameterError(f"{what} '{name}' does not exist{did_you_mean(name, names)}")
            return name
        if len(names) != 1:
            raise ParameterError(
                f"the path has {len(names)} {what}s ({', '.join(names)}); use {cure}"
            )
        return names[0]
