"""The faults met while reading, kept so that all can be told at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, ParamSpec, TypeVar

from optipath.errors import OptipathError, listed

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

T = TypeVar("T")
P = ParamSpec("P")

_MOST = 4
"""How many places are named where the same is wrong."""


class Faults(list[str]):
    """A list of sentences, each with its place in the file."""

    def attempt(
        self, where: str, action: Callable[P, T], *arguments: P.args, **keywords: P.kwargs
    ) -> T | None:
        """Return what an action gives, or None after keeping its faults.

        Parameters
        ----------
        where : str
            The place in the file.
        action : callable
            What may raise an `OptipathError`.
        *arguments, **keywords : Any
            What it is called with.

        Returns
        -------
        Any
            What it returns.

        Examples
        --------
        >>> from optipath.values.units import dimension_of
        >>> faults = Faults()
        >>> faults.attempt("parameters.delta", dimension_of, "degg")
        >>> faults
        ["parameters.delta: unit 'degg' is unknown; did you mean 'deg'?"]
        """
        try:
            return action(*arguments, **keywords)
        except OptipathError as error:
            self += [_placed(where, fault) for fault in error.faults]
            return None


def _placed(where: str, fault: str) -> str:
    """Return a fault with its place, which is not named twice."""
    named = f"parameter '{where.rpartition('.')[2]}' "
    if fault.startswith(named):
        return f"{where} {fault.removeprefix(named)}"
    # A fault within the value begins with its place there, such as ".n".
    return f"{where}{fault}" if fault.startswith(".") else f"{where}: {fault}"


def joined(faults: Iterable[str]) -> list[str]:
    """Return faults, one sentence for all the places where the same is wrong.

    Examples
    --------
    >>> joined(["a.x: 'z' is unknown", "b: 'y' is unknown", "c: 'z' is unknown", "no lamp"])
    ["a.x and c: 'z' is unknown", "b: 'y' is unknown", 'no lamp']
    """
    places: dict[tuple[str, str], list[str]] = {}
    for fault in dict.fromkeys(faults):
        where, colon, sentence = fault.partition(": ")
        places.setdefault((colon, sentence) if colon else ("", fault), []).append(where)
    return [
        f"{listed(_few(where))}: {sentence}" if colon else sentence
        for (colon, sentence), where in places.items()
    ]


def _few(places: list[str]) -> list[str]:
    if len(places) <= _MOST:
        return places
    return [*places[: _MOST - 1], f"{len(places) - _MOST + 1} more places"]
