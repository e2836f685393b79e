"""Every exception of the library: one sentence a fault, all under `OptipathError`."""

from __future__ import annotations

import re
from copyreg import __newobj__  # type: ignore[attr-defined]
from reprlib import Repr
from typing import TYPE_CHECKING, Any

from optipath.spelling import closest, looks_left

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

_LONGEST = 600
_LONGEST_QUOTE, _LONGEST_PATH = 60, 250
_MOST_LISTED, _MOST_FAULTS = 40, 20


class OptipathError(Exception):
    """The base of every error that optipath raises on purpose.

    Parameters
    ----------
    *faults : str
        One sentence for each fault: the thing, the value, and the cure. Of what it quotes, 60
        characters are shown (250 of names of files), control characters by their codes.
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
        short = tuple(map(_told, faults))
        super().__init__(*short)
        self.faults = short
        if about:
            self.about = _told(about)

    def __reduce__(self) -> tuple[Any, ...]:
        # Whatever a subclass is made of, its sentences are what it is.
        return __newobj__, (type(self), *self.faults), self.__dict__

    def __str__(self) -> str:
        """Return the first faults, one a line, and how many more there are; or a single one."""
        if len(self.faults) == 1:
            return f"{self.about}: {self.faults[0]}" if self.about else self.faults[0]
        counted = f"{len(self.faults)} faults:"
        head = f"{self.about} has {counted}" if self.about else counted
        lines = [head, *(f"- {fault}" for fault in self.faults[:_MOST_FAULTS])]
        if (more := len(self.faults) - _MOST_FAULTS) > 0:
            lines.append(f"and {more:,} more")
        return "\n".join(lines)


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


def did_you_mean(word: object, known: Iterable[str]) -> str:
    """Return the cure for a misspelt word, ready to be put behind the fault.

    Examples
    --------
    >>> did_you_mean("transmited", ["reflected", "transmitted"])
    "; did you mean 'transmitted'?"
    >>> did_you_mean("xyz", ["in", "out"])
    '; there are: in, out'
    """
    if not looks_left():
        return ""
    names = [name for name in known if name]
    if (found := closest(word if isinstance(word, str) else shown(word), names)) is not None:
        return f"; did you mean '{found}'?"
    return there_are(names)


def there_are(names: Sequence[str]) -> str:
    """Return what there is, ready to be put behind a fault.

    Examples
    --------
    >>> there_are(["in", "out"]), there_are([])
    ('; there are: in, out', '; there are none')
    """
    if (more := len(names) - _MOST_LISTED) > 0:
        return f"; there are: {', '.join(names[:_MOST_LISTED])} and {more} more"
    return f"; there are: {', '.join(names)}" if names else "; there are none"


def unknown(what: str, word: object, known: Collection[str]) -> list[str]:
    """Return the sentence for a word that is none of those there are; none for one that is.

    Examples
    --------
    >>> unknown("engine", "nunpy", ("numpy", "jax")), unknown("engine", "jax", ("numpy", "jax"))
    (["engine 'nunpy' is unknown; did you mean 'numpy'?"], [])
    """
    if isinstance(word, str) and word in known:
        return []
    return [f"{what} {shown(word)} is unknown{did_you_mean(word, known)}"]


def listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them.

    Examples
    --------
    >>> listed(["a"]), listed(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _told(fault: str) -> str:
    """Return a sentence on one line, what it quotes cut where it is long."""
    fault = _QUOTED.sub(_cut, printable(fault).replace("\n", "\\n"))
    return fault if len(fault) <= _LONGEST else f"{fault[:300]} ... {fault[-150:]}"


def _cut(quoted: re.Match[str]) -> str:
    # Of the name of a file, each folder counts.
    return _short(quoted[0], _LONGEST_PATH if "/" in quoted[0] else _LONGEST_QUOTE + 2)


def _short(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most // 2]}...{text[3 - most // 2 :]}"


# Texts in quotation marks, and words of any length.
_QUOTED = re.compile(r"""(?<!\w)'[^']*'(?!\w)|(?<!\w)"[^"]*"(?!\w)|[^\s'"]{61,}""")

# Control characters but for the end of a line, what turns the direction of
# writing, other ends of lines, and halves of characters, which no file in UTF-8 can hold.
_UNSEEN = re.compile(
    "[\x00-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)


def printable(text: str) -> str:
    r"""Return a text in which control characters are shown as Python writes them.

    Examples
    --------
    >>> print(printable("a \x1b[31mred\x1b[0m word"))
    a \x1b[31mred\x1b[0m word
    """
    return _UNSEEN.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


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

    Examples
    --------
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
