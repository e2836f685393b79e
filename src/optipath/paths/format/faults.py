"""The faults met while reading, kept so that all can be told at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from optipath.errors import OptipathError, did_you_mean, listed

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

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


def unknown_keys(raw: Mapping[str, Any], names: Sequence[str]) -> Faults:
    """Return a sentence for each key of a table that is none of those that there are.

    Examples
    --------
    >>> unknown_keys({"scal": 2}, ["scale", "offset"])
    ["key 'scal' is unknown; did you mean 'scale'?"]
    """
    unknown = [key for key in raw if key not in names]
    return Faults(f"key '{key}' is unknown{did_you_mean(key, names)}" for key in unknown)


def _placed(where: str, fault: str) -> str:
    """Return a fault with its place, which is not named twice."""
    if not where:
        return fault
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
