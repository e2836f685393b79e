"""What light has of an array: a shape, an index, and its Stokes numbers for NumPy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn, Self

import numpy as np

from optipath.errors import IndexFault, LightError, ShapeError, shown
from optipath.light.frames import Frame
from optipath.light.polarization_state import PolarizationState
from optipath.values.arrays.jax_values import check_known, is_traced, known
from optipath.values.arrays.read_only import locked

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

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


class ArrayOfLight(PolarizationState):
    """Light as an array of lights: whatever concerns its axes, and not what light is.

    Light does not change. `stokes` is read-only; a component is a copy, which may be scaled in
    place, but of more than 65536 lights, where it is read-only, too.
    """

    stokes: Array
    exponent: Array

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

    def _component(self, place: int) -> Array:
        component: Array = handed_out(known(self.stokes)[..., place])
        return component

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the batch; () for a single light."""
        return tuple(self.stokes.shape[:-1])

    @property
    def ndim(self) -> int:
        """How many axes the batch has."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """How many lights there are."""
        return int(np.prod(self.shape, dtype=np.int64))

    def __len__(self) -> int:
        """Return how many lights there are along the first axis."""
        self._check_batch("has no length")
        return self.shape[0]

    def __iter__(self) -> Iterator[Self]:
        """Yield the lights along the first axis."""
        self._check_batch("cannot be gone through")
        return (self[place] for place in range(len(self)))

    def _check_batch(self, problem: str) -> None:
        if not self.shape:
            raise LightError(
                f"a single light {problem}; its numbers are light.S0 .. light.S3, or light.stokes"
            )

    def __bool__(self) -> NoReturn:
        """Refuse to be true or false: dark light would be either."""
        raise LightError("light is neither true nor false; ask for its intensity, light.S0 > 0")

    def __getitem__(self, key: Any) -> Self:
        """Return a part of a batch, by an index of its axes: NumPy's integers, slices, masks.

        Frames that are a batch go along.

        Raises
        ------
        IndexFault
            If the index does not fit the batch.

        Examples
        --------
        >>> from optipath import Light
        >>> lights = Light([[1.0, 0.0, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0]])
        >>> lights[1]
        Light([2., 1., 0., 0.])
        >>> lights[lights.S1 == 0].shape
        (1,)
        """
        try:
            return self._each(lambda numbers: numbers[key])
        except IndexError as fault:
            if not self.shape:
                self._refuse_index(key, "a single light has no axes")
            self._refuse_index(key, f"a batch of shape {self.shape}: {fault}")

    @staticmethod
    def _refuse_index(key: Any, problem: str) -> NoReturn:
        raise IndexFault(
            f"index {shown(key)} does not fit, {problem}; components are light.S0 .. light.S3, "
            f"or light.stokes[..., 0]"
        ) from None

    def reshape(self, *shape: Any) -> Self:
        """Return the same lights as a batch of another shape.

        Parameters
        ----------
        *shape : int
            As ``numpy.reshape`` takes it, for the axes of the batch alone.

        Returns
        -------
        Light

        Raises
        ------
        ShapeError
            If that is another number of lights.
        """
        try:
            return self._each(lambda numbers: numbers.reshape(*shape))
        except (TypeError, ValueError):
            raise ShapeError(
                f"{self.size} lights of shape {self.shape} cannot be given the shape {shown(shape)}"
            ) from None

    def _each(self, change: Callable[[Any], Any]) -> Self:
        """Return the light whose axes are changed, component by component."""
        raise NotImplementedError

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:  # noqa: FBT001 - NumPy's
        """Return the Stokes numbers, of shape (..., 4), for NumPy; read-only but for a copy."""
        check_known("numpy.asarray(light)", self.stokes)
        return np.array(known(self.stokes), dtype=dtype, copy=copy)

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

    Parameters
    ----------
    component : float or array_like, shape (...)
        That of the light itself.

    Returns
    -------
    ndarray, shape (...)
        A copy; the component itself, read-only, where it is large, or traced.

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


def indexed_frame(frame: Frame, batch: tuple[int, ...], change: Callable[[Any], Any]) -> Frame:
    """Return the frames that belong to a part of a batch.

    Parameters
    ----------
    frame : Frame
        One for all, or a batch that broadcasts to that of the light.
    batch : tuple of int
        The shape of the light.
    change : callable
        What makes an array of the part out of one of the batch.

    Returns
    -------
    Frame

    Examples
    --------
    >>> frames = Frame().turned([0.0, 0.5, 1.0])
    >>> indexed_frame(frames, (3,), lambda numbers: numbers[1]) == Frame().turned(0.5)
    True
    """
    if frame.z.ndim == 1:
        return frame
    axes = [np.broadcast_to(axis, (*batch, 3)) for axis in (frame.x, frame.y, frame.z)]
    x, y, z = [np.stack([change(axis[..., i]) for i in range(3)], axis=-1) for axis in axes]
    return Frame.trusted(x, y, z, frame.rounding)
