"""What to give in place of arrays that do not broadcast, so that they do."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING

import numpy as np

from optipath.errors import listed

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    Shape = tuple[int, ...]

_MOST = 6
"""How many different shapes are looked at."""


def combination(
    shapes: Mapping[str, tuple[int, ...]], fixed: Collection[str] = (), lists: Collection[str] = ()
) -> str:
    """Say which arrays to give other axes, so that all broadcast; nothing where none is plain.

    What is longer than one along the first axes of the largest goes along these; else there is
    one path for every combination.

    Parameters
    ----------
    shapes : mapping of str to tuple of int
        Shapes that do not broadcast, by the names of what has them.
    fixed : collection of str, optional
        The names of what is to stay as it is.
    lists : collection of str, optional
        The names of what is a list, which takes no axes.

    Returns
    -------
    str
        A part of a sentence.

    Examples
    --------
    >>> combination({"delta": (7,), "rho": (4,)})
    'for every pair, give delta[:, None]'
    >>> combination({"delta": (7,), "rho": (4,), "phi": (5,)})
    'for every combination, give delta[:, None, None] and rho[:, None]'
    >>> combination({"delta": (7,), "rho": (7, 4)})
    'along the first axis, give delta[:, None]'
    >>> combination({"delta": (7,), "rho": (4,)}, lists=["delta"])
    'for every pair, give np.array(delta)[:, None]'
    """
    long = {owner: shape for owner, shape in shapes.items() if prod(shape) != 1}
    if len(set(long.values())) > _MOST:
        return ""
    if (added := _along_first_axes(long)) is not None:
        purpose = "along the first axis"
    else:
        groups = sorted(_groups(long), key=lambda group: not set(group).isdisjoint(fixed))
        purpose = "for every pair" if len(groups) == 2 else "for every combination"
        added, behind = {}, 0
        for group in reversed(groups):
            added = {owner: behind for owner in group if behind} | added
            behind += max(len(long[owner]) for owner in group)
    if len(added) > _MOST or not all(_is_of_user(o) and o not in fixed for o in added):
        return ""
    written = {owner: f"np.array({owner})" if owner in lists else owner for owner in added}
    return (
        f"{purpose}, give {listed([_with_axes(written[o], long[o], n) for o, n in added.items()])}"
    )


def _along_first_axes(shapes: Mapping[str, Shape]) -> dict[str, int] | None:
    """Return how many axes arrays need behind their own to go along the first of the largest."""
    most = max(map(len, shapes.values()))
    whole = [shape for shape in shapes.values() if len(shape) == most]
    added = {
        owner: most - len(shape)
        for owner, shape in shapes.items()
        if not _broadcast([*whole, shape])
    }
    longer = [shape + added.get(owner, 0) * (1,) for owner, shape in shapes.items()]
    return added if all(added.values()) and _broadcast(longer) else None


def _groups(shapes: Mapping[str, Shape]) -> list[list[str]]:
    """Return the names of arrays, those together that broadcast as they are."""
    groups: list[list[str]] = []
    for owner, shape in shapes.items():
        for group in groups:
            if _broadcast([shape, *(shapes[other] for other in group)]):
                group.append(owner)
                break
        else:
            groups.append([owner])
    return groups


def _broadcast(shapes: Iterable[Shape]) -> bool:
    try:
        np.broadcast_shapes(*set(shapes))
    except ValueError:
        return False
    return True


def _is_of_user(owner: str) -> bool:
    """Tell whether a name is that of an argument, or of a field of an element."""
    return all(map(str.isidentifier, owner.split(".")))


def _with_axes(owner: str, shape: Shape, more: int) -> str:
    return f"{owner}[{', '.join([':' if len(shape) == 1 else '...', *['None'] * more])}]"
