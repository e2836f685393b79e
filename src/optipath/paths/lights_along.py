"""The light on every link of a path, in the order in which it travels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from optipath.composer.composer import Composer
from optipath.composer.wiring import Wiring, link_text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from optipath.composer.travel import Port
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph

KEEPING = Composer(keep="all")
"""What composes a path so that the light on every link is kept."""


class LightOnLink(NamedTuple):
    """The light on a link, or of an out-port that nothing takes the light of."""

    name: str
    start: str
    leaves: str
    end: str
    enters: str
    light: Light
    tap: bool = False


def lights_along(path: PathGraph, /, **parameters: Any) -> list[LightOnLink]:
    """Return the light on every link, and what leaves the path, in the order of travel.

    Examples
    --------
    >>> import optipath as op
    >>> path = op.load_preset("two-panes")
    >>> for each in lights_along(path):
    ...     print(each.name, each.light.intensity.round(3))
    lamp.out -> pane1.in 1.0
    pane1.reflected -> pane2.in 0.074
    pane1.transmitted 0.926
    pane2.reflected -> eye.in 0.0
    pane2.transmitted 0.074
    """
    # By the plan, since a parameter may be called keep.
    lights: Mapping[str, Light] = path.plan_by(KEEPING).run_all(**parameters)
    wiring = Wiring(path.graph, keep="all")
    found = [
        LightOnLink(name, start, leaves, end, enters, lights[name], bool(tap))
        for start, end, (leaves, enters), tap in path.graph.edges(keys=True, data="tap")
        if (name := link_text((start, end, (leaves, enters)))) in lights
    ]
    for name in lights.keys() & {*wiring.outlets}:
        start, _, leaves = name.rpartition(".")
        found.append(LightOnLink(name, start, leaves, "", "", lights[name]))
    order = _order(wiring)
    return sorted(found, key=lambda each: (*order[each.start, each.leaves], each.tap))


def _order(wiring: Wiring) -> dict[Port, tuple[int, int]]:
    """Return where in the order of travel light leaves each port, by where it has come in."""
    place, found = wiring.order, {}
    for (name, port), own in place.items():
        ways = [c.enters for c in wiring.couplings[name] if c.leaves == port]
        fed = [place.get((name, enters), own) for enters in ways if enters is not None]
        # That which comes round in a loop comes in behind the port.
        found[name, port] = max([at for at in fed if at < own], default=own), own
    return found
