"""Array axes: shape, index and NumPy functions of light and Mueller matrices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from optipath.errors import IndexFault, LightError, ParameterError, ShapeError
from optipath.faults import shown
from optipath.values.arrays import as_argument, locked
from optipath.values.jax_values import is_traced, known, namespace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.values.precision import Array


class ArrayAxes:
    """One of a kind, or an array of them: whatever concerns its axes, and not what it is."""

    _kind: ClassVar[str]
    """What sentences call one, and several."""
    _several: ClassVar[str]
    _attribute: ClassVar[str]
    """The numbers, whose last axes are those of one; how many these are."""
    _axes: ClassVar[int]
    _written: ClassVar[str]
    """How somebody writes the numbers, and one number of each."""
    _entry: ClassVar[str]

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the batch; () for a single one."""
        return tuple(getattr(self, self._attribute).shape[: -self._axes])

    @property
    def ndim(self) -> int:
        """How many axes the batch has."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """How many there are."""
        return int(np.prod(self.shape, dtype=np.int64))

    def __len__(self) -> int:
        """Return how many there are along the first axis."""
        if not self.shape:
            one = f"a single {self._kind}"
            raise LightError(f"{one} has no length; its numbers are {self._written}")
        return self.shape[0]

    def __iter__(self) -> Iterator[Self]:
        """Yield those along the first axis."""
        return (self[place] for place in range(len(self)))

    def __bool__(self) -> NoReturn:
        """Refuse to be true or false: what is dark would be either."""
        raise LightError(f"{self._kind} is neither true nor false; ask {self._written}")

    def __getitem__(self, key: Any) -> Self:
        """Return a part of a batch, by an index of its axes: integers, slices, masks.

        Frames that are a batch are indexed as well; JAX may trace integers.

        >>> from optipath import Light
        >>> lights = Light([[1.0, 0.0, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0]])
        >>> lights[1]
        Light([2., 1., 0., 0.])
        >>> lights[lights.S1 == 0].shape
        (1,)
        """
        parts = key if isinstance(key, tuple) else (key,)
        traced = next((part for part in parts if is_traced(part)), None)

        def part(numbers: Any) -> Any:
            return (numbers if traced is None else namespace(traced).asarray(numbers))[key]

        try:
            return self._each(part)
        except (IndexError, TypeError, ValueError) as fault:
            problem = f"a batch of shape {self.shape}: {str(fault).partition(chr(10))[0]}"
            problem = problem if self.shape else f"a single {self._kind} has no axes"
            wrong = f"index {shown(key)} does not fit, {problem}"
            raise IndexFault(f"{wrong}; numbers are {self._entry}") from None

    def reshape(self, *shape: Any, order: Any = "C", copy: bool | None = None) -> Self:
        """Return the same as a batch of another shape.

        Parameters
        ----------
        *shape : int
            As ``numpy.reshape`` takes it, for the axes of the batch alone.
        order : str, optional
            In which order its axes are gone through, as ``numpy.reshape`` takes it.
        copy : bool, optional
            What ``numpy.reshape`` takes besides; nothing here can be written to.

        Returns
        -------
        Light or Mueller
        """
        try:
            return self._each(lambda numbers: numbers.reshape(*shape, order=order))
        except (TypeError, ValueError):
            wanted = shown(shape[0] if len(shape) == 1 else shape)
            what = f"{self.size} {self._several} of shape {self.shape}"
            raise ShapeError(f"{what} cannot be given the shape {wanted}") from None

    def _each(self, change: Callable[[Any], Any]) -> Self:
        """Return the same with axes changed, number by number."""
        raise NotImplementedError

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:  # noqa: FBT001 - NumPy's
        """Return the numbers for NumPy, the axes of one behind; read-only but for a copy."""
        numbers = getattr(self, self._attribute)
        if is_traced(numbers):
            raise ParameterError(
                f"{self._kind} that JAX traces is no array of numbers; take {self._written}"
            )
        return np.array(known(numbers), dtype=dtype, copy=copy)


def each_number(numbers: Any, change: Callable[[Any], Any]) -> Any:
    """Return vectors (..., n) whose axes but the last are changed, number by number."""
    parts = [change(numbers[..., place]) for place in range(numbers.shape[-1])]
    return namespace(parts[0]).stack(parts, axis=-1)


def why_refused(factor: Any) -> str:
    """Say why something is no factor of a product, and what to write in its place."""
    if isinstance(factor, type):
        return f"{factor.__name__} is a class; write {factor.__name__}(...)"
    if hasattr(factor, "mueller"):
        kind = type(factor).__name__
        return (
            f"a {kind} begins with light of its own; write path.mueller() @ light for what is "
            f"between its source and its detector, or give its Source these stokes"
        )
    if hasattr(factor, "element"):
        return f"{shown(factor)} is of a path; write the element without a name"
    return (
        f"{shown(factor)} has no frames; write element @ light, optipath.Mueller(matrix) @ light, "
        f"and optipath.Light(numbers) for light"
    )


_CURE = "light adds up, light + light, and is taken times numbers >= 0, 0.5 * light, light / 2"


def factor_of_light(factor: Any, *, dark: bool) -> Any:
    """Return an array of finite numbers above 0, or of 0 where that makes light dark."""
    if hasattr(factor, "mueller") or isinstance(factor, ArrayAxes):
        raise LightError(
            f"{shown(factor)} is what light meets; write element @ light or matrix @ light"
        )
    array = factor
    if not is_traced(factor):
        array = as_argument("a factor of light", known(factor), LightError)
    if array.dtype.kind not in "biuf":
        refuse(f"{shown(factor)} is no real number")
    allowed = (array >= 0.0 if dark else array > 0.0) & (array < np.inf)
    if is_traced(array):
        # A product, since a choice would have slopes of 0.
        array = array * namespace(array).where(allowed, 1.0, np.nan)
    elif not np.all(allowed):
        bad = array[~allowed].ravel()[0]
        refuse(f"light has no {bad!s}-fold" if dark else f"{bad!s} divides none")
    return array if array.dtype.kind == "f" else array.astype(np.float64)


def refuse(problem: str) -> NoReturn:
    """Raise what is wrong, with what there is instead."""
    raise LightError(f"{problem}; {_CURE}; for other sums take light.stokes")


OPERATORS = {
    np.add: "add",
    np.subtract: "sub",
    np.multiply: "mul",
    np.true_divide: "truediv",
    np.matmul: "matmul",
}


_COMPARES = "allclose array_equal array_equiv isclose may_share_memory shares_memory"
_JOINS = "atleast_1d atleast_2d atleast_3d concatenate stack vstack copy copyto"
_WRITES = "array2string array_repr array_str save savetxt savez"
TAKES_NUMBERS = frozenset(f"{_COMPARES} {_JOINS} {_WRITES}".split())
"""The functions of NumPy that mix no components: they take the numbers of light."""


def numbers_within(arguments: Any) -> Any:
    """Return arguments with the numbers of light in place of it."""
    if isinstance(arguments, (list, tuple)):
        return [numbers_within(each) for each in arguments]
    if isinstance(arguments, dict):
        return {name: numbers_within(each) for name, each in arguments.items()}
    return np.asarray(arguments) if isinstance(arguments, ArrayAxes) else arguments


_COPIED = 1 << 16
"""Of how many lights components are copied when somebody asks for them."""


def handed_out(component: Any) -> Any:
    """Return a component of light as it is given to whoever asks for it."""
    if isinstance(component, float):
        return np.array(component)
    stored = is_traced(component) or component.size > _COPIED
    return locked(component) if stored else np.array(component)


def stacked_components(components: tuple[Any, Any, Any, Any]) -> Array:
    """Return four components, floats or arrays of one shape, as one array (..., 4)."""
    arrays = [component for component in components if isinstance(component, np.ndarray)]
    if not arrays:
        return np.array(components)
    stokes: Array = np.empty((4, *arrays[0].shape), arrays[0].dtype)
    for row, component in enumerate(components):
        stokes[row] = component
    return np.moveaxis(stokes, 0, -1)


def refuse_call(call: str) -> NoReturn:
    """Raise that a function of NumPy takes no light."""
    raise LightError(
        f"numpy.{call} takes numbers, and light has a frame besides; give it light.stokes, or "
        f"light.S0; the mean of lights is sum(lights) / len(lights)"
    )
