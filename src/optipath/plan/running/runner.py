"""Runner: what running a program takes, whatever is wanted of it."""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines import compile_array_path, engine_for, jax_path
from optipath.engines.formulas import lights_formula
from optipath.errors import ParameterError
from optipath.plan.running.batch import Layout
from optipath.plan.running.batch_runner import BatchRunner, known_arrays
from optipath.plan.running.interpreter import Interpreter, carrier_of
from optipath.plan.running.pieces import pieces
from optipath.plan.running.reading import ResolvedInputs, Sorter
from optipath.values.angles import CosSin
from optipath.values.arrays.jax_values import is_jax, is_traced, namespace
from optipath.values.arrays.memory import CURE, enough_for
from optipath.values.operands import ONE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from contextlib import AbstractContextManager

    from optipath.engines.formulas import Formula
    from optipath.engines.program.program import Program
    from optipath.kernels import Carrier
    from optipath.plan.running.batch_runner import Results
    from optipath.values.inputs import Inputs
    from optipath.values.operands import InputKey
    from optipath.values.parameters import Resolved

    Array = np.ndarray[Any, Any]

CACHED = 8192
"""How many paths are taken at once, step after step."""


MOST_LAYOUTS = 64
"""For how many kinds of batches a program is kept compiled; the oldest goes first."""


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it."""

    method: str
    composing: str
    dtype: str
    engine: str
    threads: int


class Runner:
    """Does formulas of one program to batches, and keeps what has been compiled.

    Parameters
    ----------
    program : Program
        The steps.
    inputs : Inputs
        What may be given.
    options : RunOptions
        How they are run.
    unreduced : bool
        Whether everything is done for each path.

    Attributes
    ----------
    longest : int
        How many steps are compiled in one piece.
    """

    longest = 200

    def __init__(
        self, program: Program, inputs: Inputs, options: RunOptions, *, unreduced: bool = False
    ) -> None:
        self.program = program
        self.inputs = inputs
        self.options = options
        self.unreduced = unreduced
        self.dtype = np.dtype(options.dtype)
        self.carrier = carrier_of(program, options.composing)
        self.sorter = Sorter(program, inputs, self.dtype)
        self.interpreter = Interpreter(program, self.carrier, self.dtype)
        self._many: dict[Any, BatchRunner] = {}

    @cached_property
    def compilable(self) -> bool:
        """Whether the program can be made a formula."""
        kind = self.dtype.name
        if len(self.program.steps) > self.longest or kind not in ("float64", "float32"):
            return False
        return self._length is not None

    @cached_property
    def _length(self) -> int | None:
        """How many operations the formula of light has; None where it cannot be made."""
        try:
            made = self.lights_formula(self.all_given_as(ONE), unreduced=self.unreduced)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            return None
        return len(made.steps)

    def all_given_as(self, form: str) -> dict[InputKey, str]:
        """Return one form for every number that is not known."""
        return dict.fromkeys((v.input_key for v in self.program.operands if not v.known), form)

    def lights_formula(
        self, forms: Mapping[InputKey, str], *, carrier: type[Carrier] | None = None, **options: Any
    ) -> Formula:
        """Return the formula of the light at every end, as the function of that name does."""
        kind, limits = self.dtype.name, self.inputs.limits
        options = {"polynomials": True, **options}
        return lights_formula(self.program, carrier or self.carrier, kind, forms, limits, **options)

    def engine_for(self, count: int) -> str:
        """Return the engine for a batch of so many paths."""
        found = engine_for(self.options.engine, count, compilable=self.compilable)
        return "numpy" if found == "numba" and self.is_too_long else found

    @property
    def most_operations(self) -> int:
        """How many operations Numba is given in one piece; by name, as many as it can take."""
        return 3000 if self.options.engine == "numba" else 1500

    @property
    def is_too_long(self) -> bool:
        """Whether the formula is so long that Numba takes too much time to compile it."""
        return self._length is not None and self._length > self.most_operations

    def is_for_jax(self, parameters: Mapping[str, Any]) -> bool:
        """Tell whether a run is asked of JAX: by name, or by what is given."""
        traced = self.has_traced or any(map(_is_of_jax, parameters.values()))
        if traced and self.options.engine not in ("auto", "jax"):
            raise ParameterError(
                f"values of JAX were given, but the plan was composed for engine "
                f"'{self.options.engine}'; compose with engine='jax' or 'auto'"
            )
        return traced or self.options.engine == "jax"

    def traces(self, resolved: Mapping[str, Resolved]) -> bool:
        """Tell whether JAX traces a value of the path, or one that is given."""
        return self.has_traced or any(is_traced(given.value) for given in resolved.values())

    def nan_outside(self, numbers: Any, resolved: Mapping[str, Resolved], axes: int) -> Any:
        """Return what JAX gives, NaN where a value that it traces is not allowed.

        Parameters
        ----------
        numbers : Array
            Of the shape of the batch, with some axes behind it.
        resolved : mapping of str to Resolved
            What is given.
        axes : int
            How many there are behind the batch.
        """
        inside = self.inputs.inside(resolved)
        if inside is True:
            return numbers
        xp = namespace(numbers)
        # As a factor it makes slopes NaN as well, and those of what is allowed stay as they are.
        factor = xp.where(inside, 1.0, xp.nan).astype(numbers.dtype)
        return numbers * factor.reshape(*factor.shape, *[1] * axes)

    def filled(
        self,
        engine: str,
        what: Any,
        formula: Callable[[Any, Any], Formula],
        given: ResolvedInputs,
        parameters: Mapping[str, Any],
        fallback: Callable[[ResolvedInputs], Array],
        read: int,
    ) -> tuple[Results, bool]:
        """Return the results of a formula, and whether their exponents say anything."""
        forms = given.forms(self.dtype)
        known = {name: given.cut(array) for name, array in self.known_arrays.items()}
        arrays = {str(key): n for key, n in given.numbers.items() if isinstance(n, np.ndarray)}
        layout = Layout(given.batch, arrays | known)
        key = engine, what, forms, layout.key
        many = self._many.get(key)
        if many is None:
            made = formula(dict(forms), layout.axes)
            if len(made.steps) > self.most_operations:
                engine = "numpy"
            compiled = partial(compile_array_path, engine)
            many = BatchRunner(
                made,
                compiled,
                layout,
                threads=self.options.threads,
                read=read,
                staged=not self.unreduced,
            )
            for oldest in list(self._many)[: max(0, len(self._many) - MOST_LAYOUTS + 1)]:
                self._many.pop(oldest, None)
            self._many[key] = many
        if many.formula.unread or not given.within(self.inputs.limits):
            self.inputs.resolve(parameters)
        found, failed = many.results(
            given, layout, known, lambda: self.inputs.resolve(parameters), fallback
        )
        return found, failed or many.has_exponents

    def enough_for(
        self, batch: tuple[int, ...], numbers: int, *, twice: bool, cure: str = CURE
    ) -> AbstractContextManager[None]:
        """Return a context for so many numbers a path; for twice as many, where they are copied.

        Raises
        ------
        ParameterError
            If the machine has no memory for them.
        """
        each = self.dtype.itemsize * numbers * (2 if twice else 1)
        return enough_for(batch, each, cure, ParameterError)

    def parts(self, given: ResolvedInputs) -> Iterator[ResolvedInputs]:
        """Return what is given in parts that stay in the cache, step after step."""
        if given.paths <= CACHED:
            return iter([given])
        return (given.part(piece.where) for piece in pieces(given.batch, CACHED))

    def block(self, results: Results, start: int, stop: int) -> Array:
        """Return results, some of which may be known, as an array (results, paths)."""
        together = results.together(start, stop)
        if together is not None:
            return together
        rows = np.empty((stop - start, results.out.shape[1]), self.dtype)
        for row, result in zip(rows, results.each[start:stop], strict=True):
            row[...] = result
        return rows

    def refuse_infinite(self, numbers: Array) -> None:
        """Refuse light that is not finite.

        Raises
        ------
        ParameterError
            Telling the cure.
        """
        method = self.options.method
        if not is_traced(numbers) and not np.all(np.isfinite(numbers)):
            raise ParameterError(
                f"the light is not finite in {self.dtype} by method '{method}': a value is "
                f"too extreme; give values nearer to 1"
                + ("" if method == "stable" else ", or use method 'stable'")
            )

    @cached_property
    def known_arrays(self) -> dict[str, Array]:
        """The arrays that are known beforehand, as formulas name them."""
        return known_arrays(self.program, self.dtype)

    @cached_property
    def jax(self) -> Any:
        """The program for JAX."""
        return jax_path(self.program, self.carrier, self.dtype)

    def refuse_traced(self, parameters: Mapping[str, Any], what: str) -> None:
        """Refuse values that are not known yet.

        Raises
        ------
        ParameterError
            Telling what they are not for.
        """
        if self.has_traced or any(
            value.is_traced if type(value) is CosSin else is_traced(value)
            for value in parameters.values()
        ):
            raise ParameterError(
                f"{what} of numbers, not of values that JAX traces; do it outside of jit and grad"
            )

    @cached_property
    def has_traced(self) -> bool:
        """Whether a value of the path is one that JAX traces."""
        return any(operand.traced for operand in self.program.operands)


def _is_of_jax(value: Any) -> bool:
    """Tell whether a value is JAX's, or an angle by such a cosine and sine."""
    parts = (value.cos, value.sin) if type(value) is CosSin else (value,)
    return any(map(is_jax, parts))
