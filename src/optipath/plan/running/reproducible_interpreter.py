"""An interpreter whose results are those of formulas to the last bit, alone and among others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.engines.formulas.left import DOUBLE, FROM_ANY, FROM_NEARER, LEFT
from optipath.engines.formulas.of_angles import is_in_first_quadrant, of_angle
from optipath.engines.program.carrying import carrying
from optipath.engines.program.execute import execute
from optipath.kernels.carriers.matrix_carrier import MatrixCarrier
from optipath.kernels.carriers.scaled_carrier import ScaledCarrier
from optipath.kernels.carriers.stokes_carrier import StokesCarrier
from optipath.kernels.numbers.primitives import NUMPY
from optipath.kernels.numbers.reproducible import reproducible_numpy
from optipath.kernels.numbers.trigonometry import DIGITS
from optipath.light.underflow import folded, underflows
from optipath.plan.running.interpreter import Interpreter

if TYPE_CHECKING:
    from optipath.engines.program.program import Program, Reading
    from optipath.kernels.carriers.carrier import Carrier
    from optipath.plan.running.interpreter import Shared
    from optipath.plan.running.options import RunOptions
    from optipath.plan.running.reading import ResolvedInputs
    from optipath.values.inputs import Inputs
    from optipath.values.operands import Operand


def interpreter_for(
    program: Program, inputs: Inputs, carrier: type[Carrier], options: RunOptions
) -> Interpreter:
    """Return what runs a program step by step."""
    dtype = np.dtype(options.dtype)
    if options.reproducible:
        return ReproducibleInterpreter(program, carrier, dtype, inputs)
    return Interpreter(program, carrier, dtype)


class ReproducibleInterpreter(Interpreter):
    """Runs a program so that a path comes to the same bits alone and in any batch.

    Kernels choose what is cheaper where a number is a plain 0. A number that is given is an array
    here, be it one alone, so that a path whose index has no absorption at its own wavelength is
    computed as its neighbours are.
    """

    def __init__(
        self, program: Program, carrier: type[Carrier], dtype: np.dtype[Any], inputs: Inputs
    ) -> None:
        super().__init__(program, carrier, dtype)
        self.limits = inputs.limits
        self.xp = reproducible_numpy(dtype.name)
        self._carriers = {kind: kind(self.xp) for kind in (carrier, ScaledCarrier, MatrixCarrier)}
        self._carrying = carrying(program, carrier, self.xp, dtype.name)

    def lights(
        self, given: ResolvedInputs, shared: Shared | None = None
    ) -> list[tuple[np.ndarray[Any, Any], Any]]:
        own = {index: tuple(map(given.cut, numbers)) for index, numbers in (shared or {}).items()}
        found = self._found(_as_batch(given), own)
        return [
            folded(stokes.reshape(*given.batch, 4), np.reshape(exponent, given.batch))
            for stokes, exponent in found
        ]

    def _found(self, given: ResolvedInputs, shared: Shared) -> list[tuple[Any, Any]]:
        program, carrier = self._carrying
        if program is self.program:
            found = self._stacked(given, carrier, shared)
        else:
            with np.errstate(all="ignore"):
                lights = execute(program, self.operands(given), carrier, number=self.number)
            found = self._read(given, lights)
        if self.carrier is not StokesCarrier:
            return found
        faint = np.any([underflows(stokes[..., 0]) for stokes, _ in found], axis=0)
        if not np.any(faint):
            return found
        again = self._stacked(given, self._carriers[ScaledCarrier], shared)
        return [
            (np.where(faint[..., np.newaxis], one, other), np.where(faint, power, 0))
            for (other, _), (one, power) in zip(found, again, strict=True)
        ]

    def matrix(self, given: ResolvedInputs, source: str, reading: Reading) -> np.ndarray[Any, Any]:
        return super().matrix(_as_batch(given), source, reading).reshape(*given.batch, 4, 4)

    def bounds(self, given: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        return [found.reshape(4, *given.batch) for found in super().bounds(_as_batch(given))]

    def operands(self, given: ResolvedInputs) -> list[np.ndarray[Any, Any]]:
        # Numbers that are known are no arrays, so that kernels see which of them are 0.
        return [
            number[()] if operand.known else number
            for operand, number in zip(self.program.operands, super().operands(given), strict=True)
        ]

    def _given(self, operand: Operand, given: ResolvedInputs) -> np.ndarray[Any, Any]:
        key, numbers = operand.input_key, given.numbers
        if operand.part == "present" or numbers.get(key) is False:
            return super()._given(operand, given)
        if key not in numbers:
            raw = operand.given_in(numbers, lambda number: self._cast(np.atleast_1d(number)))
            return self._cast(operand.evaluated(self.xp, raw))
        number = np.atleast_1d(numbers[key])
        if operand.part in ("cos", "sin"):
            return self._circular(operand, number)
        return self._cast(operand.evaluated(self.xp, number))

    def _circular(self, operand: Operand, angle: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        """Return the cosines or sines of angles, as formulas have them."""
        digits, negative = DIGITS[self.dtype.name], operand.value.is_negative
        first = is_in_first_quadrant(operand, self.limits[operand.input_key.quantity])
        left: Any = None
        if self.dtype != np.float64:
            left = LEFT[FROM_NEARER if first else FROM_ANY](NUMPY, DOUBLE)(angle)
            left = self._cast(-left if negative else left)
        signed = self._cast(-angle if negative else angle)
        small = np.abs(signed) <= digits.most
        if first or np.all(small):
            return of_angle(self.xp, digits, operand, signed, left, first=first)  # type: ignore[no-any-return]
        left = None if left is None else np.where(small, left, 0.0).astype(self.dtype)
        near = np.where(small, signed, 0.0).astype(self.dtype)
        near = of_angle(self.xp, digits, operand, near, left, first=False)
        far = operand.evaluated(reproducible_numpy("float64"), angle)
        return np.where(small, near, self._cast(far))


def _as_batch(given: ResolvedInputs) -> ResolvedInputs:
    """Return what is given, one path as a batch of one."""
    return given if given.batch else given._replace(batch=(1,))
