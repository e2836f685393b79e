"""Every exception of the library: one sentence a fault, all under `OptipathError`."""

from __future__ import annotations

from difflib import get_close_matches
from reprlib import Repr
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


_LONGEST = 600
_SHORT = Repr()
_SHORT.maxlevel, _SHORT.maxstring, _SHORT.maxlong, _SHORT.maxother = 4, 80, 40, 200


class OptipathError(Exception):
    """The base of every error that optipath raises on purpose.

    Parameters
    ----------
    *faults : str
        One sentence for each fault: the thing, the value, and the cure.

    Examples
    --------
    >>> print(OptipathError("port 'a.out' is free", "port 'b.in' is fed twice"))
    2 faults:
    - port 'a.out' is free
    - port 'b.in' is fed twice
    """

    def __init__(self, *faults: str) -> None:
        short = tuple(map(_shortened, faults))
        super().__init__(*short)
        self.faults = short

    def __reduce__(self) -> tuple[Any, ...]:
        # Whatever a subclass is made of, its sentences are what it is.
        return _of_faults, (type(self), self.faults), self.__dict__

    def __str__(self) -> str:
        """All faults, one a line; a single fault stands alone."""
        if len(self.faults) == 1:
            return self.faults[0]
        return "\n".join([f"{len(self.faults)} faults:", *(f"- {fault}" for fault in self.faults)])


class FrameError(OptipathError):
    """Axes that are no right-handed frame, or frames whose directions differ."""


class ShapeError(OptipathError):
    """An array whose shape does not fit what it stands for."""


class UnitError(OptipathError):
    """A quantity whose unit is unknown, missing, or of another dimension."""


class ValueFault(OptipathError):  # noqa: N818 - a fault is what the messages call it
    """A number outside the domain of the quantity it is given for."""


class PathError(OptipathError):
    """A path graph that cannot be composed; carries every fault found."""


class LoopWarning(UserWarning):
    """Nearly all of the light that goes round in a loop comes back each time."""


class MissingExtraError(OptipathError):
    """A feature whose extra is not installed.

    Parameters
    ----------
    what, library, extra : str
        The feature, what it needs, and the extra that brings it.
    """

    def __init__(self, what: str, library: str, extra: str) -> None:
        super().__init__(
            f"{what} need {library}, which is not installed; pip install 'optipath[{extra}]'"
        )


class ParameterError(OptipathError):
    """Parameter values that a plan cannot run with; carries every fault found."""


class PresetError(OptipathError):
    """A preset that is unknown, unreadable, or wrongly written."""


class ComposerError(OptipathError):
    """A composer option that does not exist."""


def did_you_mean(word: object, known: Iterable[str]) -> str:
    """Return the cure for a misspelt word, ready to be put behind the fault.

    Parameters
    ----------
    word : object
        What was written.
    known : iterable of str
        What could have been meant.

    Returns
    -------
    str
        ``"; did you mean 'x'?"``, or the list of what there is.

    Examples
    --------
    >>> did_you_mean("transmited", ["reflected", "transmitted"])
    "; did you mean 'transmitted'?"
    >>> did_you_mean("xyz", ["in", "out"])
    '; there are: in, out'
    """
    names, word = list(known), word if type(word) is str else shown(word)
    by_lower = {name.lower(): name for name in reversed(names)}
    close = get_close_matches(word.lower(), by_lower, n=1)
    if close:
        return f"; did you mean '{by_lower[close[0]]}'?"
    return f"; there are: {', '.join(names)}" if names else "; there are none"


def shown(value: object) -> str:
    """Return what somebody has given as a sentence quotes it: in one short line, whatever it is.

    Examples
    --------
    >>> shown([1.0, "a"]), shown("a" * 1000)[-10:], shown(10**400)[:10]
    ("[1.0, 'a']", "aaaaaaaaa'", '1000000000')
    """
    try:
        text = " ".join(_SHORT.repr(value).split())
    except Exception:  # noqa: BLE001 - somebody else's repr may raise anything
        text = f"something of type {type(value).__name__}"
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them.

    Examples
    --------
    >>> listed(["a"]), listed(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _of_faults(kind: type[OptipathError], faults: tuple[str, ...]) -> OptipathError:
    error = kind.__new__(kind, *faults)
    OptipathError.__init__(error, *faults)
    return error


def _shortened(fault: str) -> str:
    # A sentence may quote what was given, which may be of any length.
    return fault if len(fault) <= _LONGEST else f"{fault[:300]} ... {fault[-150:]}"
