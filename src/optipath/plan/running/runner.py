"""Runner: answers what is asked of a program, for one path or millions."""

from __future__ import annotations

from contextlib import nullcontext
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.engines import FLOATS, NUMPY_STEPS, SEVERAL, EngineChoice, jax_path
from optipath.engines.formulas import lights_formula
from optipath.errors import ParameterError
from optipath.plan.running.batch import Layout
from optipath.plan.running.batch_runner import Results
from optipath.plan.running.interpreter import Interpreter, carrier_of
from optipath.plan.running.pieces import pieces
from optipath.plan.running.prepared import Prepared, Recipe, Sort
from optipath.plan.running.questions import LightQuestion
from optipath.plan.running.reading import InputReader
from optipath.plan.running.scalar_runner import ScalarRunner
from optipath.values.angles import CosSin
from optipath.values.arrays.jax_values import is_jax, is_traced, namespace
from optipath.values.arrays.memory import CURE, enough_for
from optipath.values.operands import ONE
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from contextlib import AbstractContextManager

    from optipath.engines.formulas import Formula
    from optipath.engines.program.program import Program
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.running.questions import Question
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.values.inputs import Inputs
    from optipath.values.operands import InputKey
    from optipath.values.parameters import Resolved

    Array = np.ndarray[Any, Any]

CACHED = 8192
"""How many paths are taken at once, step after step."""

MOST_KEPT = 64
"""How many sorts of batches are kept prepared; the oldest goes first."""

LONGEST = 200
"""How many steps are compiled in one piece."""

_LITTLE = 1 << 20
"""How many bytes every machine has."""


class RunOptions(NamedTuple):
    """How programs are run, as `Composer` takes it."""

    method: str
    composing: str
    dtype: str
    engine: str
    threads: int


class Runner:
    """Runs one program, and keeps what has been prepared.

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
    """

    def __init__(
        self, program: Program, inputs: Inputs, options: RunOptions, *, unreduced: bool = False
    ) -> None:
        self.program = program
        self.inputs = inputs
        self.options = options
        self.unreduced = unreduced
        self.dtype = np.dtype(options.dtype)
        self.carrier = carrier_of(program, options.composing)
        self.reader = InputReader(program, inputs, self.dtype)
        self.interpreter = Interpreter(program, self.carrier, self.dtype)
        self.single = ScalarRunner(program, inputs, self.interpreter, self._of_floats)
        # Until a formula turns out not to be made.
        self.may_compile = len(program.steps) <= LONGEST and options.dtype != "longdouble"
        self._sorts: dict[Any, Sort] = {}
        self._recipes: dict[Any, Recipe] = {}

    # ---------------------------------------------------------------- what is asked

    def answer(self, question: Question, parameters: Mapping[str, Any]) -> Any:
        """Return what is asked for.

        Parameters
        ----------
        question : Question
            What that is.
        parameters : mapping of str to Any
            What is given.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if a result is not finite.
        """
        key = self.reader.key(parameters)
        recipe = None if key is None else self._recipes.get((question.key, key))
        numbers = None if recipe is None else recipe.numbers(parameters)
        if recipe is not None and numbers is not None:
            return self._run(question, recipe.prepared, numbers, parameters)
        if self.is_for_jax(parameters):
            return self._by_jax(question, parameters)
        return self.answer_for(question, self.reader.read(parameters), parameters, key=key)

    def stream(
        self, question: Question, size: int, parameters: Mapping[str, Any]
    ) -> Iterator[tuple[Any, Any]]:
        """Yield the index of a part of the batch, and what is asked for it."""
        if self.is_for_jax(parameters):
            raise ParameterError(
                "a stream is not for JAX, which keeps a batch whole; use run, or engine 'numba'"
            )
        given = self.reader.read(parameters)
        for piece in pieces(given.batch, size):
            part = given.part(piece.where)
            yield piece.where, self.answer_for(question, part, parameters, ahead=given.paths)

    def answer_for(
        self,
        question: Question,
        given: ResolvedInputs,
        parameters: Mapping[str, Any],
        *,
        key: Any = None,
        ahead: int = 0,
    ) -> Any:
        """Return what is asked for numbers that have been read.

        Parameters
        ----------
        question : Question
            What that is.
        given : ResolvedInputs
            The numbers, or a part of them.
        parameters : mapping of str to Any
            What they were read from, whole.
        key : tuple, optional
            By which the batch is found again.
        ahead : int, optional
            How many paths there are in all, where this is a part.
        """
        floats = question.key == "light" and self.dtype == np.float64 and given.is_of_floats
        if floats and not given.batch:
            lights = self.single.lights(given)
            if lights is not None:
                return question.of_floats(lights)
        known = {name: given.cut(array) for name, array in self.known_arrays.items()}
        arrays = {str(key): n for key, n in given.numbers.items() if isinstance(n, np.ndarray)}
        layout = Layout(given.batch, arrays | known)
        prepared = Prepared(self._sort(question, given, layout, floats=floats), layout, known)
        if not given.within(self.inputs.limits):
            self.inputs.resolve(parameters)
        elif key is not None and Recipe.holds(given, parameters):
            recipe = Recipe(prepared, self.reader, given, parameters)
            _kept(self._recipes, (question.key, key), recipe)
        numbers = {str(key): number for key, number in given.numbers.items()} | known
        return self._run(question, prepared, numbers, parameters, given, ahead)

    def read_for_bounds(self, parameters: Mapping[str, Any]) -> ResolvedInputs:
        """Return what is given, for both the bounds of light and the light.

        Raises
        ------
        ParameterError
            With every fault of what is given, or if light goes round.
        """
        if self.program.loops:
            raise ParameterError(
                "there are no certificates for light that goes round in a loop; run the path, "
                "which is exact"
            )
        self.refuse_traced(parameters, "certificates are made")
        return self.reader.read(parameters)

    def _sort(
        self, question: Question, given: ResolvedInputs, layout: Layout, *, floats: bool
    ) -> Sort:
        """Return what this batch has in common with others."""
        forms = given.forms(self.dtype)
        key = question.key, forms, layout.key, floats
        found = self._sorts.get(key)
        if found is None:
            found = Sort(self, question, dict(forms), layout, floats=floats)
            _kept(self._sorts, key, found)
        return found

    def _run(
        self,
        question: Question,
        prepared: Prepared,
        numbers: Mapping[str, Any],
        parameters: Mapping[str, Any],
        given: ResolvedInputs | None = None,
        ahead: int = 0,
    ) -> Any:
        sort, layout = prepared.sort, prepared.layout
        engine = sort.choice.of(layout.paths, sort, ahead)
        stepped = engine == NUMPY_STEPS

        def part(piece: Any) -> Array:
            whole = given or self.reader.read(parameters)
            return question.rows(self, whole.part(piece.where), {})

        with self.enough_for(layout.batch, question.numbers(stepped=stepped), question.cure):
            rows = None
            if engine == FLOATS and sort.function is not None:
                rows = sort.function.rows(numbers, layout)
            if rows is not None:
                results = Results.of(rows, question.read, self.dtype)
            elif stepped or engine == FLOATS:
                self.inputs.resolve(parameters)
                return self._stepped(question, given or self.reader.read(parameters))
            else:
                assert sort.batches is not None  # noqa: S101 - or it would not be chosen
                results = sort.batches.results(
                    engine, numbers, layout, lambda: self.inputs.resolve(parameters), part
                )
            return question.answer(results, layout.batch)

    def _stepped(self, question: Question, given: ResolvedInputs) -> Any:
        """Return what is asked for, step by step."""
        several = given.paths > CACHED and not self.unreduced
        shared = self.interpreter.shared(given) if several and question.key == "light" else {}
        parts = [question.rows(self, part, shared) for part in self.parts(given)]
        rows = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        return question.answer(Results.of(rows, question.read, self.dtype), given.batch)

    def _by_jax(self, question: Question, parameters: Mapping[str, Any]) -> Any:
        resolved, batch = self.inputs.resolve(parameters)
        with self.enough_for(batch, 2 * question.read):
            found = question.by_jax(self, resolved, batch, parameters)
        if found is None:
            # Loops that need a closer look get the same one by every engine.
            return self._stepped(question, self.reader.read(parameters))
        return found

    # ---------------------------------------------------------------- what it is run by

    def formula(self, question: Question, forms: Any, axes: Any) -> Formula | None:
        """Return the formula of a question; None where it cannot be made."""
        if not self.may_compile:
            return None
        try:
            return question.formula(self, forms, axes)
        except Exception:  # noqa: BLE001 - an element of one's own may do anything with numbers
            self.may_compile = False
            return None

    def _of_floats(self, forms: Mapping[InputKey, str]) -> Formula | None:
        """Return the formula of light for plain floats; None where it cannot be made."""
        return self.formula(LightQuestion(self.program, polynomials=False), forms, {})

    @cached_property
    def length(self) -> int | None:
        """How many operations light takes; None where it cannot be made a formula."""
        made = self.formula(LightQuestion(self.program), self.all_given_as(ONE), {})
        return None if made is None else len(made.steps)

    def engine_for(self, count: int) -> str:
        """Return what runs a batch of so many paths, once that has been done several times."""
        engine, floats = self.options.engine, self.dtype == np.float64
        if engine == "jax":
            return engine
        if count == 1 and floats:
            return FLOATS
        if any(sort.choice.settled == "numba" for sort in self._sorts.values()):
            return "numba"
        choice = EngineChoice(engine, self.most_operations, floats=floats, runs=SEVERAL)
        return choice.of(count, _Unknown(self.length))

    @property
    def most_operations(self) -> int:
        """How many operations Numba is given in one piece; by name, as many as it can take."""
        return 3000 if self.options.engine == "numba" else 1500

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

    @cached_property
    def known_arrays(self) -> dict[str, Array]:
        """The arrays that are known beforehand, as formulas name them."""
        kind = wide(self.dtype)
        return {
            f".{place}": operand.numbers(kind=kind).astype(
                bool if operand.part == "present" else self.dtype, copy=False
            )
            for place, operand in enumerate(self.program.operands)
            if operand.known and operand.numbers().ndim
        }

    def enough_for(
        self, batch: tuple[int, ...], numbers: int, cure: str = CURE
    ) -> AbstractContextManager[None]:
        """Return a context for so many numbers a path.

        Raises
        ------
        ParameterError
            If the machine has no memory for them.
        """
        each = self.dtype.itemsize * numbers
        if prod(batch) * each < _LITTLE:
            return nullcontext()
        return enough_for(batch, each, cure, ParameterError)

    def parts(self, given: ResolvedInputs) -> Iterator[ResolvedInputs]:
        """Return what is given in parts that stay in the cache, step after step."""
        if given.paths <= CACHED:
            return iter([given])
        return (given.part(piece.where) for piece in pieces(given.batch, CACHED))

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

    # ---------------------------------------------------------------- what is JAX's

    @cached_property
    def jax(self) -> Any:
        """The program for JAX."""
        return jax_path(self.program, self.carrier, self.dtype)

    @cached_property
    def has_traced(self) -> bool:
        """Whether a value of the path is one that JAX traces."""
        return any(operand.traced for operand in self.program.operands)

    def is_for_jax(self, parameters: Mapping[str, Any]) -> bool:
        """Tell whether a run is asked of JAX: by name, or by what is given."""
        traced = self.has_traced or any(map(_is_of_jax, parameters.values()))
        if traced and self.options.engine not in ("auto", "jax"):
            raise ParameterError(
                f"values of JAX were given, but the plan was composed for engine "
                f"'{self.options.engine}'; compose with engine='jax' or 'auto'"
            )
        return traced or self.options.engine == "jax"

    def needs_closer_look(self, sound: Any, resolved: Mapping[str, Resolved]) -> bool:
        """Tell whether hardly any light leaves a loop, of values that are all known."""
        traces = self.has_traced or any(is_traced(given.value) for given in resolved.values())
        return not traces and not np.all(sound)

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


class _Unknown(NamedTuple):
    """A batch of which nothing is known but how many operations a path takes."""

    length: int | None
    has_floats = is_kept = False

    def operations(self, *, floats: bool) -> int | None:
        del floats
        return self.length


def _is_of_jax(value: Any) -> bool:
    """Tell whether a value is JAX's, or an angle by such a cosine and sine."""
    parts = (value.cos, value.sin) if type(value) is CosSin else (value,)
    return any(map(is_jax, parts))


def _kept(store: dict[Any, Any], key: Any, value: Any) -> None:
    """Keep a value with others, the oldest of which go."""
    for oldest in list(store)[: max(0, len(store) - MOST_KEPT + 1)]:
        store.pop(oldest, None)
    store[key] = value
