"""A program done step after step, with the kernels as they are: one path, or whole arrays."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from math import prod
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from optipath.engines.formulas import slack_of
from optipath.engines.program.execute import evaluated, walk, whole_matrices
from optipath.kernels import FLOAT, NUMPY, Bounds, Jones, Linear, Plain, Scaled
from optipath.light.underflow import FAINT, folded, is_faint
from optipath.plan.running.closer import CloserLook
from optipath.plan.running.gains import check_gains
from optipath.plan.running.physical import what_matrices_lack
from optipath.values.arrays.shapes import joint_shape
from optipath.values.precision import wide

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.engines.program.loops import Meeting
    from optipath.engines.program.program import Program, Reading
    from optipath.kernels import Components, Way
    from optipath.plan.running.reading import Given
    from optipath.values.operands import Raw, View

Shared: TypeAlias = Mapping[int, tuple[np.ndarray[Any, Any], ...]]

_LONG = 16
_TINY = np.finfo(np.float64).tiny * FAINT


def way_of(program: Program, composing: str) -> type[Way]:
    """Return how light is carried along a program."""
    if composing == "jones":
        return Jones
    return Scaled if len(program.steps) > _LONG else Plain


class Stepwise:
    """Runs a program without compiling anything.

    Parameters
    ----------
    program : Program
        The steps.
    way : type
        How light is carried.
    dtype : dtype
        The precision.
    """

    def __init__(self, program: Program, way: type[Way], dtype: np.dtype[Any]) -> None:
        self.program = program
        self.way = way
        self.dtype = dtype
        self._float_way = way(FLOAT)
        self._ways = {kind: kind(NUMPY) for kind in (way, Scaled, Linear)}
        self._known: list[Any] | None = None
        self._known_floats: list[float] | None = None

    def single(self, numbers: Mapping[Raw, Any]) -> list[tuple[Any, ...]] | None:
        """Return (S0, S1, S2, S3, exponent) at every end, all numbers being floats.

        None where that takes more care than floats allow.
        """
        if self._known_floats is None:
            self._known_floats = [
                self._of_known(view).item() if view.known else 0.0 for view in self.program.leaves
            ]
        leaves = list(self._known_floats)
        for place, view in enumerate(self.program.leaves):
            if not view.known:
                number = numbers[view.raw]
                leaves[place] = number if view.part == "present" else view.of_float(number)
        meetings: list[Meeting] = []
        try:
            found = walk(self.program, leaves, self._float_way, meetings=meetings)
        except (ArithmeticError, ValueError):
            return None
        if not all(all(meeting.conditions) for meeting in meetings):
            return None
        lights = []
        for reading in self.program.readings.values():
            components, exponent = found[reading.light]
            read = tuple(components[: reading.components])
            finite = abs(sum(map(abs, read))) < np.inf
            if not finite or (self.way is Plain and not components[0] >= _TINY):
                return None
            lights.append((*read, *[np.nan] * (4 - len(read)), exponent))
        return lights

    def lights(
        self, given: Given, shared: Shared | None = None
    ) -> list[tuple[np.ndarray[Any, Any], Any]]:
        """Return Stokes vectors (..., 4) and exponents at every end.

        What several parts of a batch have in common may be given, see `shared`.
        """
        own = {index: tuple(map(given.cut, numbers)) for index, numbers in (shared or {}).items()}
        found = self._stacked(given, self._ways[self.way], own)
        if self.way is Plain and any(np.any(is_faint(s[..., 0])) for s, _ in found):
            found = self._stacked(given, self._ways[Scaled], own)
        return [folded(*light) for light in found]

    def shared(self, given: Given) -> Shared:
        """Return the numbers of evaluations that differ along a few axes of a batch only.

        Together they are no more than the light that the batch gives.
        """
        leaves, way = self.leaves(given), self._ways[self.way]
        left, found = 4 * given.paths, {}
        with np.errstate(all="ignore"):
            for index, evaluation in enumerate(self.program.evaluations):
                shapes = [leaves[leaf].shape for leaf in evaluation.arguments]
                shapes += [] if evaluation.presence is None else [leaves[evaluation.presence].shape]
                size = 16 * prod(joint_shape(*shapes))
                if size <= min(left, given.paths):
                    found[index] = evaluated(evaluation, leaves, way, self.number)
                    left -= size
        return found

    def matrix(self, given: Given, source: str, reading: Reading) -> np.ndarray[Any, Any]:
        """Return Mueller matrices (..., 4, 4) from a source to a reading."""
        none = self.dtype.type(0.0)
        begin, _ = self.program.sources[source]

        def emitted(part: Given) -> dict[int, Components]:
            columns = np.eye(4, dtype=self.dtype).reshape(4, 4, *[1] * len(part.batch))
            dark = {step: (none,) * 4 for step, _ in self.program.sources.values()}
            return {**dark, begin: tuple(columns[:, row] for row in range(4))}

        lights = self._walk(given, self._ways[Linear], emitted)
        stokes = _stack(lights[reading.light][0], (4, *given.batch), reading, self.dtype)
        return np.ascontiguousarray(np.moveaxis(stokes, 0, -1))

    def bounds(self, given: Given) -> list[np.ndarray[Any, Any]]:
        """Return what `Bounds` reads at every end, shape (4, ...).

        Raises
        ------
        ParameterError
            If a Mueller matrix is unphysical.
        """
        leaves = self.leaves(given)
        with np.errstate(all="ignore"):
            matrices = whole_matrices(self.program, leaves, self._ways[Linear], self.number)
        lacking = what_matrices_lack(self.program, matrices)
        way = Bounds(NUMPY, slack_of(self.program, self.dtype.name) + lacking)
        found = self._walk(given, way, shared=matrices)
        read = []
        for reading in self.program.readings.values():
            parts = np.empty((4, *given.batch), self.dtype)
            for row, part in enumerate(found[reading.light][0]):
                parts[row] = part
            # What is too extreme for floats is bounded by nothing.
            told = np.all(np.isfinite(parts), axis=0)
            parts[1] = np.where(told, parts[1], 0.0)
            parts[2] = np.where(told, parts[2], np.inf)
            read.append(parts)
        return read

    def _stacked(self, given: Given, way: Way, shared: Shared) -> list[Any]:
        lights = self._walk(given, way, None, shared)
        return [
            (
                _stack(lights[reading.light][0], given.batch, reading, self.dtype),
                np.broadcast_to(lights[reading.light][1], given.batch),
            )
            for reading in self.program.readings.values()
        ]

    def _walk(
        self, given: Given, way: Way, emitted: Any = None, shared: Shared | None = None
    ) -> dict[int, Any]:
        meetings: list[Meeting] = []
        begin = emitted and emitted(given)
        with np.errstate(all="ignore"):
            leaves = self.leaves(given)
            found = walk(self.program, leaves, way, begin, self.number, shared, meetings)
            doubtful = _doubtful(meetings, given.batch)
            if not np.any(doubtful):
                return found
            part = given if np.all(doubtful) else given.part((doubtful,))
            leaves, meetings = self.leaves(part), []
            begin, closer = emitted and emitted(part), CloserLook(self, part)
            again = walk(self.program, leaves, way, begin, self.number, None, meetings, closer.meet)
            check_gains(meetings)
        return again if part is given else _instead(found, again, doubtful)

    def number(self, number: Any) -> np.ndarray[Any, Any]:
        """Return what a kernel gives in the precision of the plan."""
        # Plain numbers among what kernels give have no precision of their own.
        return np.asarray(number, self.dtype)

    def leaves(self, given: Given) -> list[np.ndarray[Any, Any]]:
        """Return the numbers behind the leaves of the program."""
        if self._known is None:
            self._known = [
                self._cast(self._of_known(view)) if view.known else None
                for view in self.program.leaves
            ]
        kind, numbers = wide(self.dtype), given.numbers
        return [
            self._cast(_given(view, numbers, kind))
            if leaf is None and view.part != "present"
            else np.asarray(numbers[view.raw])
            if leaf is None
            else given.cut(leaf)
            for leaf, view in zip(self._known, self.program.leaves, strict=True)
        ]

    def wide_number(self, view: View, given: Given) -> Any:
        """Return the number behind a view with all digits that are given.

        For an angle that is given by its cosine and sine, these two.
        """
        kind, numbers = wide(self.dtype), given.numbers
        if view.known:
            return given.cut(np.asarray(view.numbers({}), kind))
        if view.raw in numbers:
            return view.of(np.asarray(numbers[view.raw], kind), kind)
        sign = -1.0 if view.value.negative else 1.0
        return numbers[view.raw._replace(part="cos")], sign * numbers[view.raw._replace(part="sin")]

    def _of_known(self, view: Any) -> Any:
        if view.part == "present":
            return view.present()[()]
        return view.numbers({}, wide(self.dtype))[()]

    def _cast(self, numbers: Any) -> np.ndarray[Any, Any]:
        array = np.asarray(numbers)
        with np.errstate(over="ignore", under="ignore"):  # What is not finite is told later.
            return array if array.dtype == bool else array.astype(self.dtype, copy=False)


def _given(view: View, numbers: Mapping[Raw, Any], kind: np.dtype[Any]) -> Any:
    """Return what a view sees of what is given: a number, or an angle's cosine and sine."""
    if view.raw in numbers:
        return view.of(np.asarray(numbers[view.raw]), kind)
    sign = -1.0 if view.value.negative else 1.0
    cos, sin = (np.asarray(numbers[view.raw._replace(part=part)]) for part in ("cos", "sin"))
    if view.part == "cos":
        return cos
    return sign * (sin if view.part == "sin" else np.arctan2(sin, cos))


def _doubtful(meetings: Sequence[Meeting], batch: tuple[int, ...]) -> np.ndarray[Any, Any]:
    """Return for which paths of a batch a loop takes a closer look."""
    holds = [condition for meeting in meetings for condition in meeting.conditions]
    return np.broadcast_to(np.logical_not(reduce(np.logical_and, holds, np.True_)), batch)


def _instead(
    found: dict[int, Any], others: Mapping[int, Any], where: np.ndarray[Any, Any]
) -> dict[int, Any]:
    """Return lights, those of some paths replaced by others."""

    def put(number: Any, other: Any) -> Any:
        number = np.asarray(number)
        several = number.shape[: max(0, number.ndim - where.ndim)]
        whole = np.array(np.broadcast_to(number, (*several, *where.shape)))
        whole[..., where] = other
        return whole

    return {
        light: (tuple(map(put, components, others[light][0])), put(exponent, others[light][1]))
        for light, (components, exponent) in found.items()
    }


def _stack(
    components: Any, batch: tuple[int, ...], reading: Reading, dtype: np.dtype[Any]
) -> np.ndarray[Any, Any]:
    stokes = np.full((*batch, 4), np.nan, dtype=dtype)
    for component in range(reading.components):
        stokes[..., component] = components[component]
    return stokes
