"""Plan: a composed path, run as often as one likes with other parameter values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from optipath.errors import ParameterError, did_you_mean
from optipath.execution import Execution
from optipath.explanation import explanation
from optipath.light import Light
from optipath.mueller import Mueller

if TYPE_CHECKING:
    from optipath.inputs import Inputs
    from optipath.program import Program


@dataclass(frozen=True)
class Plan:
    """What a composer makes of a path: steps in order, and nothing of the graph.

    Attributes
    ----------
    program : Program
        The steps.
    inputs : Inputs
        The parameters that are open, and what may be given for them.
    outlets : tuple of str
        Ports whose light leaves the path unread.
    copied : tuple of str
        Ports whose light goes to several links, whole to each.
    method, model, engine, composing, dtype : str
        How Fresnel's equations are computed, what is carried along, what runs the
        steps, whether as Stokes or as Jones vectors, and in which precision.
    """

    program: Program
    inputs: Inputs
    outlets: tuple[str, ...]
    copied: tuple[str, ...]
    method: str
    model: str
    engine: str
    composing: str
    dtype: str

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
        name = self._only("detector", tuple(self.program.detectors), "run_all()")
        return self.run_all(**parameters)[name]

    def run_all(self, /, **parameters: Any) -> dict[str, Light]:
        """Return the light at every detector and every dump, by name.

        Raises
        ------
        ParameterError
            With every unknown, missing or unsuitable parameter.
        """
        lights = self._execution(parameters).lights()
        return {
            name: Light(lights[name].stokes, reading.frame, lights[name].exponent)
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
        program = self.program
        begin = self._only("source", tuple(program.sources), "mueller(source, detector)", source)
        ends = tuple(program.readings if detector else program.detectors)
        end = self._only("detector", ends, "mueller(source, detector)", detector)
        reading = program.readings[end]
        matrix = self._execution(parameters).matrix(begin, reading)
        return Mueller(matrix, program.sources[begin][1], reading.frame)

    def explain(self) -> str:
        """Return the plan in words: its steps in order, what it reads, what leaves unread.

        Examples
        --------
        >>> import optipath as op
        >>> print(op.Composer().compose(op.load_preset("malus")).explain().splitlines()[0])
        1 source, 1 detector, 5 steps; method stable, model full, engine numpy, float64
        """
        manner = f"method {self.method}, model {self.model}, engine {self.engine}, {self.dtype}" + (
            ", composing Jones columns" if self.composing == "jones" else ""
        )
        notes = [f"{port} has no link: its light leaves the path" for port in self.outlets]
        notes += [f"{port} feeds several links: each takes all its light" for port in self.copied]
        return explanation(self.program, self.inputs, manner, tuple(notes))

    def _execution(self, parameters: dict[str, Any]) -> Execution:
        given, batch = self.inputs.resolve(parameters)
        manner = {"composing": self.composing, "dtype": self.dtype, "method": self.method}
        return Execution(self.program, given, batch, **manner)

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
