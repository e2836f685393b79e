"""Parameter: a value given when a plan runs, not when a path is built."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from itertools import chain
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, Self

import numpy as np

from optipath.errors import ParameterError, UnitError, ValueFault
from optipath.faults import Fault, closest, did_you_mean, shown, there_are
from optipath.values.angles import TURN, CosSin, range_cure, refused, warn_of_degrees
from optipath.values.arrays import (
    array_of,
    as_argument,
    changed,
    first_place,
    numbers_for,
    read_only,
    same,
)
from optipath.values.jax_values import is_jax, is_traced, namespace
from optipath.values.precision import affine, doubles, real_number, within
from optipath.values.units import (
    INFINITE,
    USUAL_UNITS,
    dimension_of,
    displayed,
    format_quantity,
    format_range,
    parse_quantity,
    unit_of,
    with_article,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Sequence

    import numpy.typing as npt


PURE = "pure number"
_OF_NUMPY: dict[Any, Callable[..., Any]] = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.true_divide: operator.truediv,
    np.negative: operator.neg,
    np.positive: operator.pos,
}

ABSENT = "none"
"""The word that takes the element of an optional parameter out of the path."""

_said = operator.itemgetter(
    "name", "unit", "minimum", "maximum", "help", "words", "optional", "bound"
)


@dataclass(frozen=True, eq=False)
class Parameter:
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
    is_material: bool = field(default=False, init=False, repr=False)

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.isidentifier():
            raise ParameterError(
                f"parameter name {shown(self.name)} must be letters, digits and _, a letter first"
            )
        for field_name, (kind, described) in _KINDS.items():
            if not isinstance(value := getattr(self, field_name), kind):
                what = f"{field_name} of {self.called}"
                raise ParameterError(f"{what} must be {described}, not {shown(value)}")
        if isinstance(self.unit, str) and not self.unit:
            numbers = [self.default, self.minimum, self.maximum, *self.words.values()]
            vars(self).update(unit=_first_unit(numbers))
        # Whoever binds a value looks at it where it stands.
        warns = dimension_of(self.unit) == "angle" and not self.bound
        if warns:
            warn_of_limits(self)
        self._read_limits_and_words()
        self._read_shape()
        argument = self.default
        self._read_default()
        if warns and argument is not None:
            warn_of_degrees(self.called, argument)

    def _read_default(self) -> None:
        if isinstance(self.default, CosSin):
            raise ParameterError(f"{self.called} cannot keep a cosine and a sine; give an angle")
        if type(argument := self.default) is float:
            self.resolve(argument)
        elif argument is not None:
            limits = self.minimum, self.maximum
            default = read_only(self._as_number(argument), limits, widened=False)
            vars(self).update(default=default, is_material=is_material(argument))
            self.resolve(default)
        elif self.bound:
            raise ParameterError(f"{self.called} is bound but has no value; give one")

    def with_default(self, value: Any) -> Self:
        """Return the same with another value by default; whoever gives it looks for degrees."""
        unit = self.unit or _first_unit([value])
        result = changed(self, default=value, unit=unit, is_material=False)
        result._read_default()  # noqa: SLF001 - its own
        return result

    def _read_limits_and_words(self) -> None:
        """Put numbers in place of texts."""
        faults: list[str] = []
        numbers = []
        for what, value in _limits_and_words(self):
            if type(value) is float:
                numbers.append(value)
                continue
            with ParameterError.collecting(faults):
                numbers.append(self._one_number(what, value))
        ParameterError.raise_for(faults)
        low, high, *words = numbers
        if not type(low) is type(high) is float:
            low, high = [float(doubles(np.asarray(end))) for end in (low, high)]
        if not low <= high:
            limits = f"{self.text(low)} .. {self.text(high)}"
            raise ParameterError(f"{self.called} has the range {limits}; begin with the lower end")
        vars(self).update(minimum=low, maximum=high)
        for word in self.words:
            if not isinstance(word, str) or word == ABSENT or not word[:1].isalpha():
                raise ParameterError(
                    f"{self.called} cannot have the word {shown(word)}; begin with a letter, "
                    f"and keep '{ABSENT}' for an element that is left out"
                )
        read = zip(self.words, words, strict=True)
        vars(self).update(words={word: float(self.resolve(raw).value) for word, raw in read})

    def _one_number(self, what: str, value: Any) -> Any:
        read = numbers_for(what, value, partial(self._quantity, default_unit=""), ParameterError)
        if type(read) is float:
            return read
        array = as_argument(what, read, ParameterError)
        if array.ndim or array.dtype.kind not in "iuf":
            raise ParameterError(f"{what} must be a number, not {shown(value)}")
        return array

    def _read_shape(self) -> None:
        """Put numbers in place of scale and offset, and the dimension that a text names."""
        dimension, argument = self.offset_dimension, self.offset
        if isinstance(argument, str):
            argument, dimension = self._parsed(argument)
        scale, offset = real_number(self.scale), real_number(argument)
        if not scale or offset is None:
            raise ParameterError(
                f"{self.called} can stand as scale * {self.name} + offset with finite "
                f"real numbers and a scale other than 0, not with scale {shown(self.scale)} and "
                f"offset {shown(self.offset)}"
            )
        vars(self).update(scale=scale, offset=offset, offset_dimension=dimension)

    def _as_number(self, value: Any) -> Any:
        """Return a default with its texts read; words stay words."""
        if isinstance(value, str):
            return self.parse(value)
        if not isinstance(value, (list, tuple)):
            return self._number_of(value)
        array = as_argument(self.called, value, ParameterError)
        if array.dtype.kind not in "UO":
            return array
        read = [self._as_number(entry) for entry in array.ravel().tolist()]
        return np.array(read, object).reshape(array.shape).tolist()

    def same_specification(self, other: Parameter) -> bool:
        """Tell whether another parameter says the same of the value, scale and offset aside."""
        return self is other or (
            bool(_said(vars(self)) == _said(vars(other))) and same(self.default, other.default)
        )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Parameter):
            return NotImplemented
        if type(self.default) is type(other.default) is float and vars(self) == vars(other):
            return True
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
            return Resolved(within(raw, limits), THERE)
        # Arrays of float32 stay so, as some are judged by their precision.
        array = within(as_argument(self.called, raw, ParameterError), limits)
        present = np.ones(array.shape, dtype=bool)
        if array.dtype.kind in "USO":
            entries = [self._entry(entry, limits) for entry in array.ravel().tolist()]
            present = np.array([entry is not None for entry in entries], bool).reshape(array.shape)
            array = np.array([0.0 if e is None else e for e in entries]).reshape(array.shape)
        elif array.dtype.kind not in "iufc":
            raise ParameterError(f"{self.called} must be a number, not {shown(raw)}")
        array = array if array.ndim and array.dtype.char in "fF" else doubles(array)
        self._check_range(array)
        return Resolved(array if array.ndim else doubles(array), present)

    def _number_of(self, argument: Any) -> Any:
        """Return the numbers that a `CosSin` or a `Material` stands for; else what is given."""
        if not isinstance(argument, CosSin):
            is_index = is_material(argument) and not dimension_of(self.unit)
            return argument.refractive_index if is_index else argument
        if dimension_of(self.unit) != "angle":
            what = f"{self.called} is no angle"
            raise ParameterError(f"{what}, but a cosine and a sine are given; give a number")
        if not argument.is_traced:
            argument.check(self.called)
        return argument.angle

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
            return self._quantity(text, default_unit)
        except UnitError as error:
            raise UnitError(f"{self.called}: {error}") from None

    def _quantity(self, text: str, default_unit: str) -> Any:
        return parse_quantity(text, dimension_of(self.unit), default_unit)

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
            number = array_of(self.called, entry, ParameterError, limits)
            if number.ndim or number.dtype.kind not in "iufc":
                raise ParameterError(f"{self.called} must be a number, not {shown(entry)}")
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
            raise ParameterError(f"{self.called} is complex but has a range of reals")
        if not np.any(bad := ~self.allows(array)):
            return
        if not np.isfinite(value := array[bad].ravel()[0]):
            place = first_place(~np.isfinite(array))
            raise ParameterError(f"{self.called} is {value}{place}; give a finite number")
        limits = self.minimum, self.maximum
        # Beyond a turn, limits are those of a number of degrees, which the path makes radians.
        of_degrees = any(TURN < abs(end) < math.inf for end in limits)
        unit = "" if of_degrees and dimension_of(self.unit) == "angle" else self.unit
        text, hint = refused(float(value), unit, limits)
        reason = f"{self.called} is {text}{first_place(bad)}, outside its range"
        raise ParameterError(Fault(reason, range_cure(format_range(*limits, unit), hint)))

    @property
    def is_signed(self) -> bool:
        """Whether it stands for the value itself or its negative."""
        return self.offset == 0.0 and self.scale in (1.0, -1.0)

    @property
    def is_negative(self) -> bool:
        """Whether it stands for the negative of the value."""
        return self.offset == 0.0 and self.scale == -1.0

    @property
    def quantity(self) -> Hashable:
        """What is told apart where it stands: by the name, or a multiple with an offset."""
        return self.name if self.is_signed else (self.name, self.scale, self.offset)

    @property
    def formula(self) -> str:
        """What it stands for, as people write it: ``d``, ``-d`` or ``2 * d + 10 deg``."""
        return self.formula_of(self.name)

    def formula_of(self, name: str) -> str:
        """Return what it stands for, the value being called by a name."""
        if self.scale in (1.0, -1.0):
            multiple = f"{'-' * (self.scale < 0.0)}{name}"
        else:
            multiple = f"{format_quantity(self.scale, '')} * {name}"
        if not self.offset:
            return multiple
        sign = "-" if self.offset < 0.0 else "+"
        return f"{multiple} {sign} {format_quantity(abs(self.offset), self.unit)}"

    @property
    def spoken(self) -> str:
        """What formulas in sentences call the value."""
        return self.name

    @property
    def called(self) -> str:
        """What sentences call the value."""
        return f"parameter '{self.name}'"

    @property
    def plain_numbers(self) -> Any:
        """What it is known to be, of which degrees are told from radians; None for nothing."""
        return self.default

    def alone(self) -> Self:
        """Return the value itself."""
        is_alone = self.scale == 1.0 and not self.offset and not self.offset_dimension
        return self if is_alone else changed(self, scale=1.0, offset=0.0, offset_dimension="")

    def like(self, other: Parameter) -> Self:
        """Return what stands for this value as another does for its own."""
        names = ("scale", "offset", "offset_dimension")
        return changed(self, **{name: getattr(other, name) for name in names})

    def placed(self, numbers: Any) -> Any:
        """Return what stands in its place where the value is some numbers."""
        return affine(self.scale, self.offset, numbers)

    def span_of(self, limits: tuple[float, float]) -> tuple[float, float]:
        """Return the limits of what stands in its place, by those of the value."""
        low, high = map(self.placed, limits)
        return min(low, high), max(low, high)

    def span_for(self, limits: tuple[float, float]) -> tuple[float, float]:
        """Return the limits of the value, by those of what stands in its place."""
        low, high = [(end - self.offset) / self.scale for end in limits]
        return min(low, high), max(low, high)

    def _parsed(self, text: str) -> tuple[Any, str]:
        """Return the number that a text with a unit is as an offset, and its dimension."""
        own = dimension_of(self.unit) or self.offset_dimension
        for dimension in [] if own else USUAL_UNITS:
            with suppress(UnitError):
                return parse_quantity(text, dimension), dimension or PURE
        dimension = own.removeprefix(PURE) if own else "angle"
        return parse_quantity(text, dimension), dimension or PURE

    def __neg__(self) -> Self:
        return changed(self, scale=-self.scale, offset=0.0 - self.offset)

    def __pos__(self) -> Self:
        return self

    def __mul__(self, other: Any) -> Self:
        if not (factor := real_number(other)):
            self._refuse(f"multiplied by {_named(other)}", other)
        return self._made(factor * self.scale, factor * self.offset)

    def __truediv__(self, other: Any) -> Self:
        if not (divisor := real_number(other)):
            self._refuse(f"divided by {_named(other)}", other)
        return self._made(self.scale / divisor, self.offset / divisor)

    def __add__(self, other: Any) -> Self:
        return self._shifted(other, 1.0)

    def __sub__(self, other: Any) -> Self:
        return self._shifted(other, -1.0)

    def __rsub__(self, other: Any) -> Self:
        return (-self)._shifted(other, 1.0)

    __rmul__, __radd__ = __mul__, __add__

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Do arithmetic with a number of NumPy, and refuse any other function."""
        if ufunc in (np.equal, np.not_equal):
            return ufunc is np.not_equal
        numbers = [one if isinstance(one, Parameter) else real_number(one) for one in inputs]
        if ufunc not in _OF_NUMPY or method != "__call__" or options or None in numbers:
            self._refuse(f"given to numpy.{ufunc.__name__}")
        return _OF_NUMPY[ufunc](*numbers)

    def _not_affine(self, *_: Any) -> NoReturn:
        self._refuse("used so")

    __pow__ = __rpow__ = __rtruediv__ = __mod__ = __abs__ = __float__ = _not_affine
    __lt__ = __le__ = __gt__ = __ge__ = _not_affine

    def _shifted(self, other: Any, sign: float) -> Self:
        number, dimension = other, self.offset_dimension
        if isinstance(other, str):
            number, dimension = self._parsed(other)
        if (number := real_number(number)) is None:
            self._refuse(f"added to {_named(other)} or subtracted from it", other)
        return self._made(self.scale, self.offset + sign * number, dimension)

    def _made(self, scale: float, offset: float, dimension: str | None = None) -> Self:
        """Return another multiple with another offset, if floats hold these."""
        if scale == 0.0 or not math.isfinite(scale) or not math.isfinite(offset):
            raise ParameterError(
                f"{self.called} would stand as {scale} * {self.spoken} + {offset}, which floats "
                f"cannot hold; give numbers nearer to 1"
            )
        dimension = self.offset_dimension if dimension is None else dimension
        return changed(self, scale=scale, offset=offset, offset_dimension=dimension)

    def _refuse(self, done: str, other: Any = None) -> NoReturn:
        if isinstance(other, (complex, np.complexfloating)):
            raise ParameterError(
                f"{self.called} cannot be {done}; for an index n + ik write op.Material(n, k), and "
                f"for any other complex number one parameter that is given it whole"
            )
        raise ParameterError(
            f"{self.called} cannot be {done}: it may stand as a multiple with an offset alone, "
            f"such as 2 * {self.spoken} + 0.1; compute other values in NumPy and give them as it"
        )


_KINDS: dict[str, tuple[type, str]] = {
    **dict.fromkeys(("help", "offset_dimension"), (str, "a text")),
    "words": (dict, "a dict from word to number"),
    **dict.fromkeys(("optional", "bound"), (bool, "True or False")),
}


def _limits_and_words(parameter: Parameter) -> list[tuple[str, Any]]:
    """Return the limits and the words of a parameter: what sentences call each, and its number."""
    of = f"of parameter '{parameter.name}'"
    limits = [(f"the {end} {of}", getattr(parameter, end)) for end in ("minimum", "maximum")]
    return limits + [(f"the word '{word}' {of}", value) for word, value in parameter.words.items()]


def warn_of_limits(parameter: Parameter, place: Callable[[Any], Any] | None = None) -> None:
    """Warn of plain numbers beyond a whole turn among the limits and words of an angle."""
    for what, number in _limits_and_words(parameter):
        warn_of_degrees(what, number, place)


def is_material(argument: Any) -> bool:
    """Tell whether an argument is a `Material`, which stands for an index of refraction."""
    return getattr(type(argument), "stands_for_index", False) is True


def _first_unit(values: list[Any]) -> str:
    """Return the unit of the first text that has one; none where there is none."""
    several = chain(*[v if isinstance(v, (list, tuple)) else [v] for v in values])
    units = [unit_of(text) for text in several if isinstance(text, str)]
    return next(filter(None, units), "")


_OF_A_COMPOSER = ("method", "model", "engine", "dtype", "tolerance", "composing", "loops")
_CASE = "cas"
"""What the word case begins with, however it goes on."""


def unknown_parameter(name: str, known: Iterable[str]) -> str:
    """Return the sentence for a parameter that there is not."""
    names = [*known]
    if closest(name, names) is None:
        if name in _OF_A_COMPOSER:
            return f"'{name}' is no parameter of the path; write Composer({name}=...).compose(path)"
        if name.lower().startswith(_CASE):
            return f"'{name}' is no parameter of the path; write load_preset(..., case=...)"
    return f"parameter '{name}' is unknown{did_you_mean(name, names)}"


def unknown_word(name: str, word: str, known: Iterable[str], dimension: str = "") -> str:
    """Return the sentence for a word that a parameter does not know, or that is no number.

    >>> unknown_word("filter", "vertikal", ["horizontal", "vertical"])
    "parameter 'filter' knows no word 'vertikal'; did you mean 'vertical'?"
    >>> unknown_word("t", "half", [])
    "parameter 't' knows no word 'half'; give a number"
    """
    if word.lower() == "nan":
        wanted = _number(dimension)
        return f"parameter '{name}' cannot be '{word}', which is not finite; give {wanted}"
    return f"parameter '{name}' knows no word '{word}'{word_meant(word, known, dimension)}"


def word_meant(word: str, known: Iterable[str], dimension: str) -> str:
    """Return the cure for a word that is unknown where a number may stand, too.

    >>> word_meant("antidiagonal", ["diagonal"], "angle")
    "; write '-45 deg' for the axis 'antidiagonal'"
    >>> word_meant("off", ["none"], "angle")
    "; there are: none, or give an angle such as '45 deg'"
    """
    words = [*known]
    unit = USUAL_UNITS[dimension]
    # By its letters alone, an axis is near the one at right angles to it.
    near = closest(word, [*words, *AXES] if dimension == "angle" else words)
    if near in words:
        return f"; did you mean '{near}'?"
    if near is not None:
        return f"; write '{format_quantity(AXES[near], unit)}' for the axis '{near}'"
    number = _number(dimension)
    return f"{there_are(words)}, or give {number}" if words else f"; give {number}"


def _number(dimension: str) -> str:
    """Return what a number of a dimension is, with an example."""
    unit = USUAL_UNITS[dimension]
    return f"{with_article(dimension)} such as '45 {unit}'" if dimension else "a number"


AXES: Mapping[str, float] = MappingProxyType(
    {
        "horizontal": 0.0,
        "vertical": math.pi / 2.0,
        "diagonal": math.pi / 4.0,
        "antidiagonal": -math.pi / 4.0,
    }
)
"""The angles of axes that have names, from x towards y."""


def _named(other: Any) -> str:
    if isinstance(other, Parameter):
        return other.called
    return "a value of JAX" if is_jax(other) else shown(other)


def label_of(what: str, name: Any, usual: str) -> str:
    """Return what sentences call a thing by."""
    if not isinstance(name, str):
        raise ValueFault(f"the name of {what} is {shown(name)}; give a text")
    return name or usual


THERE = np.ones((), dtype=bool)
"""For a parameter that is there, on every path."""
THERE.flags.writeable = False


class Resolved(NamedTuple):
    """Numbers for a parameter, and where an optional one is there at all."""

    value: npt.NDArray[Any]
    present: npt.NDArray[np.bool_]


def check_named(
    call: str, unnamed: Sequence[object], names: Iterable[str], first: str = ""
) -> None:
    """Refuse values that are given without a name.

    >>> check_named("run", [0.5], ["delta", "rho"])
    Traceback (most recent call last):
    optipath.errors.ParameterError: values are given by name: run(delta=0.5); there are: delta, rho
    """
    if not unnamed:
        return
    value, known = unnamed[0], list(names)
    if not known:
        raise ParameterError(f"{call}() takes no values here: no parameter is open")
    written = (
        f"**{shown(dict(value))}" if isinstance(value, Mapping) else f"{known[0]}={shown(value)}"
    )
    given = ", ".join(filter(None, (first, written)))
    raise ParameterError(f"values are given by name: {call}({given}){there_are(known)}")
