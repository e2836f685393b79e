"""View: one number for each path, taken from a value that may have more."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.frozen import same
from optipath.kernels import NUMPY, cosine, sine
from optipath.parameters import Parameter, Resolved

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping


_COS, _SIN = cosine(NUMPY), sine(NUMPY)
_DOUBLE = np.dtype(np.float64)


@dataclass(frozen=True, eq=False, slots=True)
class View:
    """A number, an array or a parameter, and which part of it a kernel is given.

    Attributes
    ----------
    value : Any
        A number, an array, or a `Parameter`.
    part : str or int
        ``"value"``, ``"real"``, ``"imag"``, ``"cos"``, ``"sin"``, ``"present"`` (is an
        optional parameter there?), or the position in a flattened vector or matrix.
    tail : tuple of int
        The axes of the value behind the batch.
    """

    value: Any
    part: str | int = "value"
    tail: tuple[int, ...] = ()

    @property
    def known(self) -> bool:
        """Whether the value is known before the plan runs."""
        return not isinstance(self.value, Parameter) or self.value.bound

    def numbers(
        self, given: Mapping[str, Resolved], kind: np.dtype[Any] = _DOUBLE
    ) -> np.ndarray[Any, Any]:
        """Return this part of the value, parameters being given.

        Cosines and sines are computed in the precision of `kind`.
        """
        if not isinstance(self.value, Parameter):
            return self._part_of(np.asarray(self.value), kind)
        if self.part == "present":
            return self.present(given)
        resolved = self._resolved(given).value
        return self._part_of(-resolved if self.value.negative else resolved, kind)

    def present(self, given: Mapping[str, Resolved] | None = None) -> np.ndarray[Any, Any]:
        """Return where an optional parameter is there."""
        return self._resolved(given or {}).present

    def key(self) -> Hashable:
        """Return what equal views share; None for arrays, which are not compared."""
        if isinstance(self.value, Parameter):
            return self.value.name, self.value.negative, self.part
        if isinstance(self.value, (int, float, complex)):
            return repr(complex(self.value)), self.part
        return None

    def _resolved(self, given: Mapping[str, Resolved]) -> Resolved:
        parameter: Parameter = self.value
        return parameter.resolve(parameter.default) if parameter.bound else given[parameter.name]

    def _part_of(self, numbers: np.ndarray[Any, Any], kind: np.dtype[Any]) -> np.ndarray[Any, Any]:
        match self.part:
            case "real":
                return np.real(numbers)
            case "imag":
                # Adding 0 turns -0 into 0: an index without absorption has one sign only.
                return np.asarray(np.imag(numbers) + 0.0)
            case "cos":
                return np.asarray(_COS(numbers.astype(kind)))
            case "sin":
                return np.asarray(_SIN(numbers.astype(kind)))
            case int(position):
                flat = numbers.reshape(*numbers.shape[: -len(self.tail)], -1)
                return np.asarray(flat[..., position])
            case _:
                return numbers

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, View):
            return NotImplemented
        if self.known and other.known and "present" not in (self.part, other.part):
            return same(self.numbers({}), other.numbers({}))
        return self.part == other.part and same(self.value, other.value)

    __hash__ = None  # type: ignore[assignment]


def view_of(argument: Any) -> View:
    """Return the argument of an operation as a view."""
    return argument if isinstance(argument, View) else View(argument)
