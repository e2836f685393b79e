"""Parameter: a value that is given when a plan runs, not when a path is built."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import ParameterError, UnitError, shown
from optipath.values.affine import Affine
from optipath.values.angles import CosSin
from optipath.values.arrays.array_likes import array_of, as_given
from optipath.values.arrays.jax_values import is_traced, namespace
from optipath.values.arrays.read_only import read_only, same
from optipath.values.arrays.shapes import first_place
from optipath.values.degrees import called, has_plain_degrees
from optipath.values.displayed import displayed, format_range
from optipath.values.ratios import INFINITE, finite_number
from optipath.values.resolved import THERE, Resolved
from optipath.values.roundings import doubles, traced_within, within
from optipath.values.specification import check_types, checked_name, limit_of, read_specification
from optipath.values.units import dimension_of, format_quantity, parse_quantity
from optipath.values.unknown_parameter import unknown_word

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

ABSENT = "none"
"""The word that takes the element of an optional parameter out of the path."""

_ASIDE = {"scale", "offset", "offset_dimension", "is_listed", "is_material"}


@dataclass(frozen=True, eq=False)
class Parameter(Affine):
    """A named value of a path that is given when it is traced.

    Used in place of a value of any element; ``2 * parameter + 0.1`` stands for a multiple of it
    with an offset. The default, the range, the words and the unit are those of the value itself.

    Parameters
    ----------
    name : str
        The keyword that gives it, so a Python identifier.
    default : float or array_like, optional
        Used when none is given; without one, the parameter must be given.
    unit : str, optional
        The unit in which files and the command line give it; by default that of the first text.
        Plain numbers are in radians or metres, of the default and the limits too.
    minimum, maximum : float, optional
        The range, both ends included.
    help : str, optional
        One line for the command line.
    words : mapping of str to float, optional
        Values that have a name, such as ``{"horizontal": 0.0}``.
    optional : bool, optional
        Whether the word ``"none"`` takes the element out of the path.
    bound : bool, optional
        Whether the default is the value for good.
    scale, offset : float, optional
        It stands for ``scale * value + offset``; arithmetic says so.
    offset_dimension : str, optional
        That of the unit, where the offset was given as a text; ``"pure number"`` without one.

    Attributes
    ----------
    is_listed : bool
        Whether the default was given as a list, which may be one value by its parts.
    is_material : bool
        Whether it was given as a `Material`, which stands for an index of refraction.

    Raises
    ------
    ParameterError
        If the name is no identifier, a bound parameter has no value, or the
        default lies outside the range; or of arithmetic that gives no multiple with an offset.
    UnitError
        If the unit is unknown, or the offset has that of another dimension.

    Examples
    --------
    >>> Parameter("filter", words={"diagonal": 0.785}).resolve("diagonal").value
    array(0.785)
    >>> (90 - 2 * Parameter("d")).formula
    '-2 * d + 90'
    """

    name: str
    default: Any = None
    unit: str = ""
    minimum: float = -np.inf
    maximum: float = np.inf
    help: str = ""
    words: Mapping[str, float] = field(default_factory=dict)
    optional: bool = False
    bound: bool = False
    scale: float = 1.0
    offset: float = 0.0
    offset_dimension: str = ""
    is_listed: bool = field(default=False, init=False, repr=False)
    is_material: bool = field(default=False, init=False, repr=False)

    def __post_init__(self) -> None:
        checked_name(self.name)
        vars(self).update(read_specification(self))
        check_types(self)
        scale, offset, dimension = self.checked_shape()
        vars(self).update(scale=scale, offset=offset, offset_dimension=dimension)
        low, high = [limit_of(self.name, end) for end in (self.minimum, self.maximum)]
        if not low <= high:
            raise ParameterError(
                f"parameter '{self.name}' has the range {self.text(low)} .. "
                f"{self.text(high)}; begin with the lower end"
            )
        vars(self).update(minimum=low, maximum=high)
        vars(self).update(words={w: self._word(w, v) for w, v in self.words.items()})
        if isinstance(self.default, CosSin):
            raise ParameterError(
                f"parameter '{self.name}' cannot keep a cosine and a sine; give them when the "
                f"plan runs, or give an angle"
            )
        if self.default is not None:
            vars(self)["is_listed"] = isinstance(self.default, (list, tuple))
            vars(self)["is_material"] = hasattr(type(self.default), "refractive_index")
            default = read_only(self._as_number(self.default), (low, high), widened=False)
            object.__setattr__(self, "default", default)
            self.resolve(self.default)
        elif self.bound:
            raise ParameterError(f"parameter '{self.name}' is bound but has no value; give one")

    def _word(self, word: Any, value: Any) -> float:
        if not isinstance(word, str) or word == ABSENT or not word[:1].isalpha():
            raise ParameterError(
                f"parameter '{self.name}' cannot have the word {shown(word)}; begin with a letter, "
                f"and keep '{ABSENT}' for an element that is left out"
            )
        what = f"the word '{word}' of parameter '{self.name}'"
        number = array_of(what, value, ParameterError, (self.minimum, self.maximum))
        if isinstance(value, str) or number.ndim or number.dtype.kind not in "iuf":
            raise ParameterError(f"{what} must be a number, not {shown(value)}")
        return float(self.resolve(value).value)

    def _as_number(self, value: Any) -> Any:
        """Return a default with its texts read; words stay words."""
        if isinstance(value, str):
            return self.parse(value)
        if not isinstance(value, (list, tuple)):
            return self._number_of(value)
        array = as_given(f"parameter '{self.name}'", value, ParameterError)
        if array.dtype.kind not in "UO":
            return array
        read = [self._as_number(entry) for entry in array.ravel().tolist()]
        return np.array(read, object).reshape(array.shape).tolist()

    def same_specification(self, other: Parameter) -> bool:
        """Tell whether another parameter says the same of the value, scale and offset aside."""
        told = vars(self).keys() - _ASIDE
        return self is other or all(map(same, *[map(vars(p).get, told) for p in (self, other)]))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Parameter):
            return NotImplemented
        shape = other.scale, other.offset
        return (self.scale, self.offset) == shape and self.same_specification(other)

    def __hash__(self) -> int:
        return hash(self.name)

    def resolve(self, raw: Any, limits: tuple[float, float] | None = None) -> Resolved:
        """Return the numbers that a given value is, scale and offset aside.

        Parameters
        ----------
        raw : float, complex, str or array_like
            Numbers in radians or metres, words of this parameter, texts with a
            unit (``"30 deg"``), or an array or list of any of these.
        limits : tuple of float, optional
            The least and the largest number allowed where it stands; by default its own.

        Returns
        -------
        Resolved
            ``value`` and ``present``, both of the shape of `raw`.

        Raises
        ------
        ParameterError
            If it is no number or word, not finite, or outside the range.
        """
        if type(raw) is float and self.minimum <= raw <= self.maximum and abs(raw) < np.inf:
            return Resolved(np.array(raw), THERE)
        raw = self._number_of(raw)
        limits = limits or (self.minimum, self.maximum)
        if is_traced(raw):
            return Resolved(traced_within(raw, limits), THERE)
        # Arrays stay in the precision in which they are given, by which some are judged.
        array = within(as_given(f"parameter '{self.name}'", raw, ParameterError), limits)
        present = np.ones(array.shape, dtype=bool)
        if array.dtype.kind in "USO":
            entries = [self._entry(entry, limits) for entry in array.ravel().tolist()]
            present = np.array([entry is not None for entry in entries], bool).reshape(array.shape)
            array = np.array([0.0 if e is None else e for e in entries]).reshape(array.shape)
        elif array.dtype.kind not in "iufc":
            raise ParameterError(f"parameter '{self.name}' must be a number, not {shown(raw)}")
        if array.dtype.kind in "iu":
            array = array.astype(np.float64)
        self._check_range(array)
        return Resolved(array if array.ndim else doubles(array), present)

    def _number_of(self, given: Any) -> Any:
        """Return the numbers that a `CosSin` or a `Material` stands for; else what is given."""
        if isinstance(given, CosSin):
            return self._angle(given)
        is_index = hasattr(type(given), "refractive_index") and not dimension_of(self.unit)
        return given.refractive_index if is_index else given

    def _angle(self, given: CosSin) -> Any:
        if dimension_of(self.unit) != "angle":
            raise ParameterError(
                f"parameter '{self.name}' is no angle, but a cosine and a sine are given; "
                f"give a number"
            )
        if not given.is_traced:
            given.check(f"parameter '{self.name}'")
        return given.angle

    def parse(self, text: str, default_unit: str = "") -> Any:
        """Return what a text stands for: a word, as it is, or a number.

        Parameters
        ----------
        text : str
            A word of the parameter, or a number with its unit; where it has none, the
            number may be complex, such as ``"0.3+0.4j"``.
        default_unit : str, optional
            The unit of a number without one.

        Returns
        -------
        str, float or complex
            The word, or the number in radians or metres.

        Raises
        ------
        ParameterError
            If it is another word.
        UnitError
            If it is no quantity of the parameter's dimension.
        """
        if text in self.words or (self.optional and text == ABSENT):
            return text
        if text[:1].isalpha() and text != INFINITE:
            dimension = dimension_of(self.unit)
            raise ParameterError(unknown_word(self.name, text, self.all_words, dimension))
        try:
            return parse_quantity(text, dimension_of(self.unit), default_unit)
        except UnitError as error:
            raise UnitError(f"parameter '{self.name}': {error}") from None

    def text(self, value: Any) -> str:
        """Write a value as files and the command line give it."""
        if isinstance(value, str):
            return value
        if isinstance(value, np.ndarray):
            return f"array of shape {value.shape}"
        return format_quantity(value, self.unit)

    @property
    def all_words(self) -> tuple[str, ...]:
        """The words that may be given, the one for absence included."""
        return (*self.words, *([ABSENT] if self.optional else []))

    def default_text(self) -> str:
        """Write the default, or that there is none."""
        if isinstance(self.default, float):
            return displayed(self.default, self.unit)
        return "must be given" if self.default is None else self.text(self.default)

    def range_text(self) -> str:
        """Write the range, or nothing where there is none."""
        return format_range(self.minimum, self.maximum, self.unit)

    def _entry(self, entry: Any, limits: tuple[float, float]) -> Any:
        if not isinstance(entry, str):
            entry = self._number_of(entry)
            number = array_of(f"parameter '{self.name}'", entry, ParameterError, limits)
            if number.ndim or number.dtype.kind not in "iufc":
                wrong = f"parameter '{self.name}' must be a number, not {shown(entry)}"
                raise ParameterError(wrong)
            return number[()]
        value = self.parse(entry)
        return self.words.get(value) if isinstance(value, str) else value

    @np.errstate(over="ignore")  # Of limits, which half precision may have no numbers for.
    def allows(self, numbers: Any) -> Any:
        """Return which numbers of an array, JAX's as well, are finite and within the range."""
        inside = namespace(numbers).isfinite(numbers)
        if numbers.dtype.kind == "c":
            return inside & (self.minimum == -np.inf) & (self.maximum == np.inf)
        return inside & (numbers >= self.minimum) & (numbers <= self.maximum)

    def _check_range(self, array: npt.NDArray[Any]) -> None:
        if array.dtype.kind == "c" and np.isfinite([self.minimum, self.maximum]).any():
            raise ParameterError(f"parameter '{self.name}' is complex but has a range of reals")
        if not np.any(bad := ~self.allows(array)):
            return
        if not np.isfinite(value := array[bad].ravel()[0]):
            place, wanted = first_place(~np.isfinite(array)), finite_number(value, self.unit)
            raise ParameterError(f"parameter '{self.name}' is {value}{place}; give {wanted}")
        number, limits = float(value), (self.minimum, self.maximum)
        plain = dimension_of(self.unit) == "angle" and has_plain_degrees(*limits)
        unit = "" if plain else self.unit
        given, meant = called(number, format_quantity(number, unit), dimension_of(unit), limits)
        raise ParameterError(
            f"parameter '{self.name}' is {given}{first_place(bad)}, outside its range; give "
            f"{format_range(*limits, unit)}{meant}"
        )
