"""Plan: a composed path, run as often as one likes with other parameter values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple, Never

from optipath.engines.choice import LARGE
from optipath.errors import ParameterError
from optipath.light.frame import Frame
from optipath.light.light import Light
from optipath.light.mueller import Mueller
from optipath.plan.answers import Answers, LaterWavelength, by_place, only
from optipath.plan.noise import matrix_noise_at, noise_at
from optipath.values.arrays import MOST_PATHS
from optipath.values.parameters import check_named
from optipath.values.precision import whole_number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from optipath.elements.own_element import OwnWays
    from optipath.engines.draft import Draft
    from optipath.engines.program import Program, Reduction, Tolerance
    from optipath.plan.certificate import Certificate
    from optipath.plan.explanation import Explanation
    from optipath.plan.inputs import Inputs
    from optipath.plan.light_paths import LightPath


_MADE = ("_detector", "answers")


@dataclass(frozen=True)
class Plan:
    """What a composer makes of a path: steps in order, and nothing of the graph.

    Attributes
    ----------
    draft : Draft
        The path as it stands, which becomes the program `whole` where that is needed.
    reduction : Reduction
        What is left of it for what the detectors read.
    inputs : Inputs
        The parameters that are open, and what may be given for them.
    own_ways : tuple of OwnWays
        Ways through elements of a user's own that are looked at with the first values of a run.
    outlets : tuple of str
        Ports whose light leaves the path unread.
    taps : tuple of str
        Links that read light and take none, such as ``"S.reflected -> state.in"``.
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

    draft: Draft
    reduction: Reduction
    inputs: Inputs
    outlets: tuple[str, ...]
    taps: tuple[str, ...]
    method: str
    composing: str
    dtype: str
    chosen: str = "auto"
    threads: int = 1
    instead: Tolerance | None = None
    tolerance: float | None = None
    own_ways: tuple[OwnWays, ...] = ()

    @property
    def whole(self) -> Program:
        """The path as it stands, every step of it."""
        return self.draft.program

    @property
    def program(self) -> Program:
        """The steps that are run."""
        return self.reduction.program

    @property
    def model(self) -> str:
        """What is carried (with a tolerance, where that allows it): a name such as ``"full"``."""
        return self.instead.model if self.instead else self.reduction.model

    @property
    def engine(self) -> str:
        """What runs large batches; `engine_for` says what runs smaller ones."""
        return self.engine_for(LARGE).partition(",")[0]

    def run(self, /, *unnamed: Never, **parameters: Any) -> Light:
        """Return the light at the only detector.

        Parameters
        ----------
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            In radians and metres; arrays broadcast together.

        Returns
        -------
        Light
            ``stokes`` has the broadcast shape of all values with 4 behind it. It is NaN for
            values that JAX traces outside their domain: these cannot be refused.

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter, or if there are
            several detectors.
        """
        if unnamed:
            check_named("run", unnamed, self.inputs.open)
        name, place, frame = self._detector
        if self.instead is not None:
            return self.run_all(**parameters)[name]
        answers = self.answers
        stokes: Any = answers.light.single.fast_path(parameters, place)
        if type(frame) is not Frame:
            frame = answers.framed(frame, parameters)
        noise = (noise_at, answers, name, parameters, ())
        by = answers.wavelengths
        later = LaterWavelength(by, self.inputs, parameters) if by else None
        if stokes is None or self.inputs.turning:
            self.inputs.warn_of_angles(parameters)
        if stokes is None:
            stokes = answers.lights(parameters)[name]
        return Light.of(stokes, frame, noise=noise, wavelength=later)

    def run_all(self, /, *unnamed: Never, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and every dump, by name.

        Of a plan that keeps all, also that on every link, such as ``"lamp.out -> eye.in"``,
        and that which leaves the path by an outlet, such as ``"glass.transmitted"``.

        Parameters
        ----------
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `run`.

        Returns
        -------
        dict of str to Light
        """
        check_named("run_all", unnamed, self.inputs.open)
        self.inputs.warn_of_angles(parameters)
        return self.answers.in_frames(self.answers.lights(parameters), parameters)

    def stream(self, size: int = 1 << 20, /, *unnamed: Never, **parameters: Any) -> Iterator[Part]:
        """Yield the light of a batch part by part, in memory that the parts need.

        Parameters
        ----------
        size : int, optional
            How many paths a part has at most.
        *unnamed
            None: values are given by name.
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
        check_named("stream", unnamed, self.inputs.open)
        name, _, _ = self._detector
        ParameterError.raise_for(whole_number("the size of a part", size))
        for where, lights in self.answers.stream(size, parameters):
            yield Part(where, self.answers.in_frames(lights, parameters, where)[name])

    def mueller(
        self,
        source: str | None = None,
        detector: str | None = None,
        /,
        *unnamed: Never,
        **parameters: Any,
    ) -> Mueller:
        """Return the Mueller matrix from one source to one detector.

        Entries too small for a float are 0.

        Parameters
        ----------
        source, detector : str, optional
            Their names; needed only where there are several.
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `run`.

        Returns
        -------
        Mueller
            Of shape (..., 4, 4), the broadcast shape of all values in front.

        Raises
        ------
        ParameterError
            As in `run`, or if a source or detector is not named or not known.
        """
        check_named("mueller", by_place((source, detector), unnamed), self.inputs.open)
        if misplaced := {"source", "detector"} & parameters.keys() - self.inputs.open.keys():
            first, last = next(iter(self.whole.sources)), next(iter(self.whole.readings))
            raise ParameterError(
                f"{min(misplaced)} is given by its place: mueller(source, detector), such as "
                f"mueller('{first}', '{last}')"
            )
        program = self.whole
        begin = only("source", tuple(program.sources), "mueller(source, detector)", source)
        names = tuple(program.readings if detector is not None else program.detectors)
        end = only("detector", names, "mueller(source, detector)", detector)
        matrix = self.answers.matrix(begin, end, parameters)
        ends = program.sources[begin][1], program.readings[end].frame
        before, behind = (self.answers.framed(frame, parameters) for frame in ends)
        noise = partial(matrix_noise_at, self.answers, begin, end, parameters)
        return Mueller.of(matrix, before, behind, noise)

    def paths(
        self,
        /,
        limit: int | None = None,
        bounces: int | None = None,
        *unnamed: Never,
        **parameters: Any,
    ) -> list[LightPath]:
        """Return the ways of light from sources to detectors and dumps, the brightest first.

        The light of all of them together is what `run_all` gives; where light goes round, there
        is no end of them, and with more bounces their sum comes as near as one likes.

        Parameters
        ----------
        limit : int, optional
            How many at most.
        bounces : int, optional
            How often light may be reflected at most on its way.
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `run`; of a batch, the brightest member counts.

        Returns
        -------
        list of LightPath

        Raises
        ------
        ParameterError
            As in `run`, or if light goes round and nothing says when to stop.

        Examples
        --------
        >>> import optipath as op
        >>> for path in op.load_preset("coated-metal").compose().paths(limit=2):
        ...     print(path)
        0.539067  lamp.out -> surface.transmitted -> metal.reflected -> surface.reflected -> eye
        0.388729  lamp.out -> surface.transmitted -> metal.transmitted -> heat
        """
        from optipath.plan.light_paths import light_paths  # noqa: PLC0415 - not for every import

        arguments = [value for value in (limit, bounces) if isinstance(value, Mapping)]
        check_named("paths", (*arguments, *unnamed), self.inputs.open)
        answers = self.answers
        self.inputs.warn_of_angles(parameters)
        as_light = partial(answers.as_light, parameters)
        return light_paths(answers.whole, limit, bounces, parameters, as_light)

    def certificate(
        self, detector: str | None = None, /, *unnamed: Never, **parameters: Any
    ) -> Certificate:
        """Return how far the intensity at a detector can be from that without polarisation.

        Parameters
        ----------
        detector : str, optional
            Its name; needed only where there are several.
        *unnamed
            None: values are given by name.
        **parameters : float or array_like
            As in `run`.

        Returns
        -------
        Certificate
            Its arrays have the broadcast shape of all values.

        Raises
        ------
        ParameterError
            As in `run`, or if a detector is not named or not known, or if a Mueller matrix is
            unphysical.

        Examples
        --------
        >>> import numpy as np
        >>> import optipath as op
        >>> gold = {"n1": 0.18, "k1": 3.4, "n2": 0.18, "k2": 3.4}
        >>> found = op.load_preset("npgr026").compose().certificate(**gold, phi=[0.2, 1.2])
        >>> print(found.error.round(5))
        [3.00e-05 1.27e-03]
        """
        check_named("certificate", by_place((detector,), unnamed), self.inputs.open)
        ends = tuple(self.whole.readings if detector is not None else self.whole.detectors)
        end = only("detector", ends, "certificate(detector)", detector)
        return self.answers.certificates(parameters)[end]

    def engine_for(self, count: int, /) -> str:
        """Return what runs a batch of so many paths.

        Examples
        --------
        >>> import optipath as op
        >>> plan = op.Composer(engine="numpy").compose(op.load_preset("malus"))
        >>> plan.engine, plan.engine_for(10)
        ('numpy', 'numpy, step by step')
        """
        ParameterError.raise_for(whole_number("the number of paths", count, 0))
        return self.answers.light.engine_for(min(count, MOST_PATHS))

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
        # Imported where it is needed, so that the library itself is there quickly.
        from optipath.plan.explanation import explanation_of  # noqa: PLC0415

        return explanation_of(self)

    def evaluations(self, /, **parameters: Any) -> dict[str, int]:
        """Return how often each step's numbers are computed for a batch.

        An element is evaluated only along those axes of a batch on which it depends: an
        interface that sees one of the two axes of a grid once for each value on it, and one
        without open values once.

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
        from optipath.plan.explanation import evaluations  # noqa: PLC0415 - not for every import

        return evaluations(self.answers.light, parameters)

    def only_detector(self, cure: str) -> str:
        """Return the name of the detector; where there are several, refuse with a cure."""
        return only("detector", tuple(self.program.detectors), cure)

    @cached_property
    def answers(self) -> Answers:
        """What answers all that is asked, and keeps what it has prepared."""
        return Answers(self)

    @cached_property
    def _detector(self) -> tuple[str, int, Any]:
        """The name of the only detector, its place among the ends, and its frame."""
        name = self.only_detector("run_all()")
        place = list(self.program.readings).index(name)
        return name, place, self.program.detectors[name].frame

    def __getstate__(self) -> dict[str, Any]:
        # What has been compiled stays here.
        return {name: value for name, value in self.__dict__.items() if name not in _MADE}


class Part(NamedTuple):
    """A part of a batch, and its light."""

    where: tuple[int | slice, ...]
    light: Light
