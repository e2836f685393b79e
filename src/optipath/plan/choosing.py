"""Which source or detector is meant, where a path may have several."""

from __future__ import annotations

from typing import Any

from optipath.errors import ParameterError, did_you_mean, shown


def only(what: str, names: tuple[str, ...], cure: str, name: str | None = None) -> str:
    """Return the name that is given, or the only one.

    Examples
    --------
    >>> only("detector", ("eye",), "run_all()")
    'eye'
    """
    if name is not None:
        if isinstance(name, str) and name in names:
            return name
        raise ParameterError(f"{what} {shown(name)} does not exist{did_you_mean(name, names)}")
    if len(names) != 1:
        raise ParameterError(f"the path has {len(names)} {what}s ({', '.join(names)}); use {cure}")
    return names[0]


def by_place(ends: tuple[Any, ...], unnamed: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return what is given by its place, but for names of sources and detectors.

    Examples
    --------
    >>> by_place(("lamp", None), ()), by_place((0.3, None), (0.2,))
    ((), (0.3, 0.2))
    """
    return (*[end for end in ends if not isinstance(end, str | None)], *unnamed)
