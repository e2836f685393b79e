"""What light has of an array besides its axes: components, and what NumPy does with it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from optipath.errors import LightError
from optipath.light.array_axes import ArrayAxes
from optipath.light.polarization_state import PolarizationState
from optipath.values.arrays.jax_values import is_traced, known, namespace
from optipath.values.arrays.read_only import locked

if TYPE_CHECKING:
    from optipath.values.roundings import Array

_OPERATORS = {
    np.add: "add",
    np.subtract: "sub",
    np.multiply: "mul",
    np.true_divide: "truediv",
    np.matmul: "matmul",
}


_COMPARES = ("allclose", "array_equal", "array_equiv", "isclose", "may_share_memory")
_JOINS = (
    "atleast_1d",
    "atleast_2d",
    "atleast_3d",
    "concatenate",
    "stack",
    "vstack",
    "copy",
    "copyto",
    "save",
    "savetxt",
    "savez",
)
_SHAPES = ("shape", "ndim", "size", "flip", "reshape", "shares_memory")
_WRITES = ("array2string", "array_repr", "array_str")
_TAKES_LIGHT = frozenset([*_COMPARES, *_JOINS, *_SHAPES, *_WRITES])
"""The functions of NumPy that mix no components."""

_COPIED = 1 << 16
"""Of how many lights components are copied when somebody asks for them."""


class ArrayOfLight(ArrayAxes, PolarizationState):
    """Light as an array of lights, and not what light is.

    Light does not change. `stokes` is read-only; a component is a copy, which may be scaled in
    place, but of more than 65536 lights, where it is read-only, too.
    """

    stokes: Array
    exponent: Array

    _kind, _several = "light", "lights"
    _attribute, _axes = "stokes", 1
    _written, _entry = "light.stokes", "light.S0 .. light.S3, or light.stokes[..., 0]"

    @property
    def S0(self) -> Array:  # noqa: N802 - as everybody writes it
        """The intensity, of shape (...)."""
        return self._component(0)

    @property
    def S1(self) -> Array:  # noqa: N802
        """The intensity along x less that along y, of shape (...)."""
        return self._component(1)

    @property
    def S2(self) -> Array:  # noqa: N802
        """The intensity along x + y less that along y - x, of shape (...)."""
        return self._component(2)

    @property
    def S3(self) -> Array:  # noqa: N802
        """The intensity that turns from x to y less that which turns back, of shape (...)."""
        return self._component(3)

    @property
    def intensity(self) -> Array:
        """S0, of shape (...)."""
        parts = self.__dict__.get("_stokes")
        if type(parts) is tuple and "stokes" not in self.__dict__:
            return handed_out(parts[0])  # type: ignore[no-any-return]
        return self.S0

    @property
    def log10_intensity(self) -> Array:
        """The decimal logarithm of S0, of shape (...), however faint; -inf where it is dark."""
        s0 = self._numbers[..., 0]
        xp = namespace(s0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return xp.asarray(xp.log10(s0) + self.exponent * np.log10(2.0))  # type: ignore[no-any-return]

    @property
    def is_measured(self) -> bool:
        """Whether it is, or is made of, ``Light(..., physical=False)``."""
        return "_measured" in self.__dict__

    def _component(self, place: int) -> Array:
        component: Array = handed_out(known(self.stokes)[..., place])
        return component

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Add, dim, compare; refuse what would lose the frame."""
        name = _OPERATORS.get(ufunc)
        if name is not None and method == "__call__" and not options:
            first, second = inputs
            if isinstance(first, ArrayOfLight):
                return getattr(first, f"__{name}__")(second)
            return getattr(second, f"__r{name}__")(first)
        if all(kinds.endswith("?") for kinds in ufunc.types if "O" not in kinds):
            numbers = [np.asarray(i) if isinstance(i, ArrayOfLight) else i for i in inputs]
            return getattr(ufunc, method)(*numbers, **options)
        return self._refuse_call(
            ufunc.__name__ if method == "__call__" else f"{ufunc.__name__}.{method}"
        )

    def __array_function__(self, function: Any, _: Any, given: Any, options: Any) -> Any:
        """Compare, join and write numbers; refuse what would mix the components."""
        if function.__name__ in _TAKES_LIGHT:
            # By NEP 18, what NumPy does without us.
            return function._implementation(*given, **options)  # noqa: SLF001
        return self._refuse_call(function.__name__)

    @staticmethod
    def _refuse_call(call: str) -> NoReturn:
        raise LightError(
            f"numpy.{call} takes numbers, and light has a frame besides; give it light.stokes, "
            f"whose last axis are the components, or one, light.S0; the mean of lights is "
            f"sum(lights) / len(lights)"
        )


def handed_out(component: Any) -> Any:
    """Return a component of light as it is given to whoever asks for it.

    Shapes: component (...); returns (...).

    Examples
    --------
    >>> kept = np.ones(3)
    >>> mine = handed_out(kept)
    >>> mine *= 2.0
    >>> kept
    array([1., 1., 1.])
    """
    if isinstance(component, float):
        return np.array(component)
    kept = is_traced(component) or component.size > _COPIED
    return locked(component) if kept else np.array(component)


def stacked_components(components: tuple[Any, Any, Any, Any]) -> Array:
    """Return four components, floats or arrays of one shape, as one array (..., 4).

    Examples
    --------
    >>> stacked_components((1.0, 0.5, 0.0, 0.0))
    array([1. , 0.5, 0. , 0. ])
    """
    arrays = [component for component in components if isinstance(component, np.ndarray)]
    if not arrays:
        return np.array(components)
    stokes: Array = np.empty((4, *arrays[0].shape), arrays[0].dtype)
    for row, component in enumerate(components):
        stokes[row] = component
    return np.moveaxis(stokes, 0, -1)
