"""Every exception of the library: one sentence a fault, all under `OptipathError`."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


_LONGEST = 600


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


class CacheError(OptipathError):
    """A cache of compiled code that cannot be used, or whose folder is not to be trusted."""


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
    names, word = list(known), str(word)
    by_lower = {name.lower(): name for name in reversed(names)}
    close = get_close_matches(word.lower(), by_lower, n=1)
    if close:
        return f"; did you mean '{by_lower[close[0]]}'?"
    return f"; there are: {', '.join(names)}" if names else "; there are none"


def listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them.

    Examples
    --------
    >>> listed(["a"]), listed(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last


def _shortened(fault: str) -> str:
    # A sentence may quote what was given, which may be of any length.
    return fault if len(fault) <= _LONGEST else f"{fault[:300]} ... {fault[-150:]}"
