"""Chains of vertices by their angles, as files write them: a table of lists."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from optipath.elements.vertices.by_angles import VerticesByAngles
from optipath.errors import PresetError, shown
from optipath.paths.format.faults import unknown_keys

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_ANGLES = ("incidences", "turns")
_BACKWARDS = "backwards"


def chain_by_angles(raw: Mapping[str, Any], decoded: Callable[[Any], Any]) -> VerticesByAngles:
    """Return the chain of a table.

    Examples
    --------
    >>> chain_by_angles({"incidences": [0.5], "backwards": True}, float)
    VerticesByAngles(incidences=(0.5,), turns=(), backwards=True)
    """
    faults = unknown_keys(raw, (*_ANGLES, _BACKWARDS))
    angles = []
    for key in _ANGLES:
        several = raw.get(key, [])
        if not isinstance(several, list):
            faults.append(f"{key} must be a list of angles, not {shown(several)}")
            continue
        places = [(f".{key}[{place}]", angle) for place, angle in enumerate(several)]
        angles.append(tuple(faults.attempt(at, decoded, angle) for at, angle in places))
    backwards = raw.get(_BACKWARDS, False)
    if not isinstance(backwards, bool):
        faults.append(f"{_BACKWARDS} must be true or false, not {shown(backwards)}")
    if faults:
        raise PresetError(*faults)
    incidences, turns = angles
    return VerticesByAngles(incidences, turns, backwards)


def table_of_angles(chain: VerticesByAngles, encoded: Callable[[Any], Any]) -> dict[str, Any]:
    """Return the table of a chain.

    Examples
    --------
    >>> table_of_angles(VerticesByAngles((0.5, 0.6), (0.1,)), str)
    {'incidences': ['0.5', '0.6'], 'turns': ['0.1']}
    """
    table: dict[str, Any] = {
        key: [encoded(angle) for angle in getattr(chain, key)] for key in _ANGLES
    }
    return table | {_BACKWARDS: True} if chain.backwards else table
