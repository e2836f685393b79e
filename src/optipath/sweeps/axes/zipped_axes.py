"""Parameters of a sweep that vary together: what ``zip=`` says."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from optipath.errors import did_you_mean, listed, shown

if TYPE_CHECKING:
    from collections.abc import Collection

_AS = "zip=('a', 'b'), zip=[('a', 'b'), ('c', 'd')] or zip={'point': ('a', 'b')}"

_UNNAMED = "dim_0"
"""What xarray calls a dimension that nobody has named."""


def zipped_dimensions(
    zipped: Any, lengths: Mapping[str, int], parameters: Collection[str], faults: list[str]
) -> dict[str, str]:
    """Return the dimension of each parameter that varies together with others.

    Examples
    --------
    >>> zipped_dimensions(("delta", "rho"), {"delta": 3, "rho": 3, "phi": 2}, [], [])
    {'delta': 'delta_rho', 'rho': 'delta_rho'}
    """
    groups = _groups(zipped, faults)
    found: dict[str, str] = {}
    for dimension, names in groups:
        told = [
            f"zip names '{name}', which has no axis of its own{did_you_mean(name, lengths)}"
            for name in names
            if name not in lengths
        ]
        told += [
            f"zip names '{name}' twice; write it in one group, once"
            for name in dict.fromkeys(names)
            if name in found or names.count(name) > 1
        ]
        if dimension in parameters:
            told.append(
                f"zip calls a dimension '{dimension}', which is the name of a parameter; give it "
                f"another, such as zip={{'point': {(*names,)}}}"
            )
        if dimension in found.values():
            told.append(f"zip has two dimensions '{dimension}'; name them by zip={{...}}")
        if not told and len({lengths[name] for name in names}) > 1:
            counted = listed([f"{lengths[name]} of '{name}'" for name in names])
            told.append(f"zip pairs values one by one, but there are {counted}; give as many each")
        faults += told
        if not told:
            found |= dict.fromkeys(names, dimension)
    return found


def shared_dimensions(along: Mapping[str, Any], dimensions: Mapping[str, str]) -> list[str]:
    """Return what is wrong with arrays along one dimension that may or may not vary together.

    Examples
    --------
    >>> shared_dimensions({"a": "x", "b": "x"}, {"a": "a_b", "b": "a_b"})
    []
    """
    faults = []
    for shared in dict.fromkeys(along.values()):
        names = [name for name in along if along[name] == shared]
        if len({dimensions.get(name, name) for name in names}) > 1 and shared != _UNNAMED:
            quoted = listed([f"'{name}'" for name in names])
            faults.append(
                f"{quoted} are all along '{shared}'; write zip={{'{shared}': {(*names,)}}} if they "
                f"vary together, or .rename({shared}='{names[-1]}') for all combinations"
            )
    return faults


def _groups(zipped: Any, faults: list[str]) -> list[tuple[str, list[str]]]:
    """Return the dimension and the names of each group."""
    if zipped is None or (isinstance(zipped, (list, tuple, Mapping)) and not zipped):
        return []
    if isinstance(zipped, Mapping):
        several: list[tuple[Any, Any]] = [*zipped.items()]
    elif isinstance(zipped, (list, tuple)):
        alone = any(isinstance(one, str) for one in zipped)
        several = [(None, group) for group in ([zipped] if alone else zipped)]
    else:
        faults.append(f"zip is {shown(zipped)}; write {_AS}")
        return []
    found = []
    for dimension, group in several:
        are_names = isinstance(group, (list, tuple)) and all(isinstance(n, str) for n in group)
        if not are_names or len(group) < 2:
            faults.append(f"zip has {shown(group)}, and a group is two names or more; write {_AS}")
        elif dimension is not None and not (isinstance(dimension, str) and dimension):
            faults.append(f"zip calls a dimension {shown(dimension)}; give it a text for a name")
        else:
            found.append((dimension or "_".join(group), [*group]))
    return found
