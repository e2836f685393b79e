"""Errors and warnings: every exception of the library, and no more."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from optipath.faults import Fault, sentence

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from optipath.faults import Medium

_MOST_FAULTS = 20


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
            self.about = sentence("", about, "")

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

    @classmethod
    @contextmanager
    def collecting(cls, faults: list[str], about: str = "", **parts: Any) -> Iterator[None]:
        """Keep the faults of what goes wrong inside, each under what it is about, and go on.

        Parameters
        ----------
        faults : list of str
            Where they are kept.
        about : str, optional
            What is in front of each.
        **parts : str
            As `Fault.but` takes them, such as ``subject="n"``.

        Yields
        ------
        None

        Examples
        --------
        >>> faults = []
        >>> with OptipathError.collecting(faults, about="there"):
        ...     raise PathError("it is dark")
        >>> faults
        ['there: it is dark']
        """
        try:
            yield
        except cls as result:
            faults += [fault.under(about).but(**parts) for fault in result.faults]

    @classmethod
    @contextmanager
    def wrapping(cls, about: str = "", **parts: Any) -> Iterator[None]:
        """Raise what goes wrong inside as this error, under what it is about, or as it is.

        Parameters
        ----------
        about : str, optional
            What is in front of each fault.
        **parts : str
            As `collecting` takes them.

        Yields
        ------
        None

        Examples
        --------
        >>> with ParameterError.wrapping("there"):
        ...     raise UnitError("it is dark")
        Traceback (most recent call last):
        optipath.errors.ParameterError: there: it is dark
        """
        try:
            yield
        except OptipathError as result:
            under = [fault.under(about or result.about) for fault in result.faults]
            raise cls(*[fault.but(**parts) for fault in under]) from None

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


__all__ = [n for n, each in vars().items() if type(each) is type and issubclass(each, Exception)]


def __dir__() -> list[str]:
    return __all__
