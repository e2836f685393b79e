"""Energy along a path: the power on links, in elements and at ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optipath.composer.composer import Composer
from optipath.composer.wiring import Wiring, cycles, link_text, reached

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    import numpy.typing as npt

    from optipath.composer.wiring import Port
    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph


_ROUNDING = 1e-12
"""The share of the power that comes in below which a difference is rounding."""


class LightOnLink(NamedTuple):
    """The light on a link, or of an out-port that nothing takes it of; and its power (...)."""

    name: str
    start: str
    leaves: str
    end: str
    enters: str
    light: Light
    power: Any = None
    tap: bool = False
    in_loop: bool = False


class EnergyAlong(NamedTuple):
    """Where the power of the light of a path comes from and goes.

    Given = taken + left + ended; amplifiers take a negative power, see `notes`.

    >>> import optipath as op
    >>> found = energy_along(op.load_preset("malus"), angle="60 deg")
    >>> {name: float(power.round(3)) for name, power in found.taken.items()}
    {'polarizer': 0.5, 'analyzer': 0.375}
    >>> {name: float(power.round(3)) for name, power in found.ended.items()}
    {'eye': 0.125}
    """

    links: tuple[LightOnLink, ...]
    given: Mapping[str, npt.NDArray[np.float64]]
    taken: Mapping[str, npt.NDArray[np.float64]]
    left: Mapping[str, npt.NDArray[np.float64]]
    ended: Mapping[str, npt.NDArray[np.float64]]
    notes: tuple[str, ...]


def energy_along(
    path: PathGraph, lit: Sequence[LightOnLink] = (), /, **parameters: Any
) -> EnergyAlong:
    """Return where the power of the light of a path comes from and goes, of its lights if known."""
    wiring = Wiring(path.graph, keep="all")
    lit = lit or lights_along(path, **parameters)
    powers = np.broadcast_arrays(*[_power(each.light) for each in lit])
    spent = reached(wiring.untapped, wiring.starts)
    round_and_round = set().union(*cycles(wiring.untapped))
    links = []
    for each, power in zip(lit, powers, strict=True):
        tap = each.tap or (each.start, each.leaves) not in spent
        ends = {(each.start, each.leaves), (each.end, each.enters)}
        in_loop = not each.tap and ends <= round_and_round
        links.append(each._replace(tap=tap, in_loop=in_loop, power=power))
    flows = [link for link in links if not link.tap]
    inner = {node for node, e in wiring.elements.items() if e.inputs and e.outputs}
    begin = {node for node, e in wiring.elements.items() if not e.inputs}
    given = _sums((link.start, link.power) for link in flows if link.start in begin)
    entered = dict.fromkeys(link.end for link in flows)
    taken = {node: _taken(node, flows) for node in entered if node in inner}
    left = {link.name: link.power for link in flows if not link.end}
    ended = _sums((link.end, link.power) for link in flows if link.end and link.end not in inner)
    return EnergyAlong((*links,), given, taken, left, ended, (*_notes(links, taken),))


def _power(light: Light) -> npt.NDArray[np.float64]:
    """Return the intensity of light; no more than the noise of what it was is dark."""
    power = np.asarray(light.intensity, float)
    return np.where(np.abs(power) < light.noise, 0.0, power)


def _sums(powers: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    results: dict[str, Any] = {}
    for name, power in powers:
        results[name] = results[name] + power if name in results else power
    return results


def _taken(node: str, flows: list[LightOnLink]) -> npt.NDArray[np.float64]:
    """Return what comes in and does not go out; 0 where that is rounding."""
    arrives = sum(link.power for link in flows if link.end == node)
    goes = sum(link.power for link in flows if link.start == node)
    rest = np.asarray(arrives - goes, float)
    return np.where(np.abs(rest) <= _ROUNDING * np.maximum(arrives, goes), 0.0, rest)


def _notes(links: Iterable[LightOnLink], taken: Mapping[str, Any]) -> Iterable[str]:
    if any(link.in_loop for link in links):
        yield "light goes round: a link in a loop has the power of all rounds together"
    for name, power in taken.items():
        if np.any(power < 0.0):
            yield f"'{name}' gives more light than it gets: it takes a negative power"


KEEPING = Composer(keep="all")
"""What composes a path so that the light on every link is kept."""


def lights_along(path: PathGraph, /, **parameters: Any) -> list[LightOnLink]:
    """Return the light on every link, and what leaves the path, in the order of travel.

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
    results = [
        LightOnLink(name, start, leaves, end, enters, lights[name], tap=bool(tap))
        for start, end, (leaves, enters), tap in path.graph.edges(keys=True, data="tap")
        if (name := link_text((start, end, (leaves, enters)))) in lights
    ]
    for name in lights.keys() & {*wiring.outlets}:
        start, _, leaves = name.rpartition(".")
        results.append(LightOnLink(name, start, leaves, "", "", lights[name]))
    order = _order(wiring)
    return sorted(results, key=lambda each: (*order[each.start, each.leaves], each.tap))


def _order(wiring: Wiring) -> dict[Port, tuple[int, int]]:
    """Return where in the order of travel light leaves each port, by where it has come in."""
    place, result = wiring.order, {}
    for (name, port), own in place.items():
        ways = [c.enters for c in wiring.couplings[name] if c.leaves == port]
        fed = [place.get((name, enters), own) for enters in ways if enters is not None]
        # That which comes round in a loop comes in behind the port.
        result[name, port] = max([at for at in fed if at < own], default=own), own
    return result
