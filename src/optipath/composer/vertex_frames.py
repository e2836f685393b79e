"""The frames of light before the first vertex of a chain, and behind the last."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.composer.placement import azimuth_of, goes_straight, is_zero
from optipath.values.operands import operand_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.composer.travel import Port
    from optipath.composer.wiring import Link, Wiring
    from optipath.elements.vertices.frame import VertexFrame
    from optipath.values.operands import Operand


def vertex_frame(wiring: Wiring, name: str, port: str) -> VertexFrame | None:
    """Return the frame of light at a port that comes from a vertex, or else goes to one.

    Directly, or through elements that let it go straight on, whose links may turn it. Of
    light that several links bring, or may have brought, nothing is known.
    """
    if not wiring.self_placed:
        return None
    return _followed(wiring, (name, port), _before) or _followed(wiring, (name, port), _behind)


def _followed(
    wiring: Wiring,
    port: Port,
    following: Callable[[Wiring, Port], tuple[Port, list[Operand]] | None],
) -> VertexFrame | None:
    """Return the frame of the first vertex on the way from a port, with all turns between."""
    turns: list[Operand] = []
    passed: set[Port] = set()
    while port not in passed:
        own = wiring.elements[port[0]].own_frame(port[1])
        if own is not None:
            return own.turned(*turns)
        passed.add(port)
        found = following(wiring, port)
        if found is None:
            return None
        port, more = found
        turns += more
    return None


def _before(wiring: Wiring, port: Port) -> tuple[Port, list[Operand]] | None:
    """Return the port that all light at a port comes from, and the turns since then."""
    name, way = port
    if way not in wiring.elements[name].inputs:
        couplings = wiring.couplings[name]
        ways = {c.enters for c in couplings if c.leaves == way}
        fed = [enters for enters in ways if enters and (name, enters) in wiring.links_to]
        straight = len(fed) == 1 and goes_straight(wiring.elements[name], fed[0], way)
        return ((name, fed[0]), []) if straight else None
    links = wiring.links_to.get(port, [])
    if len(links) != 1:
        return None
    start, _, (leaves, _) = links[0]
    return (start, leaves), _turns(wiring, links[0])


def _behind(wiring: Wiring, port: Port) -> tuple[Port, list[Operand]] | None:
    """Return the port that light at a port goes to, and the turns till then, taken back."""
    name, way = port
    if way in wiring.elements[name].inputs:
        ways = {c.leaves for c in wiring.couplings[name] if c.enters == way}
        straight = [leaves for leaves in ways if goes_straight(wiring.elements[name], way, leaves)]
        return ((name, straight[0]), []) if len(straight) == 1 else None
    links = wiring.links_from.get(port) or [t for t in wiring.taps if (t[0], t[2][0]) == port]
    if len(links) != 1:
        return None
    _, end, (_, enters) = links[0]
    return (end, enters), [turn.negated() for turn in _turns(wiring, links[0])]


def _turns(wiring: Wiring, link: Link) -> list[Operand]:
    azimuth = azimuth_of(wiring, link)
    return [] if is_zero(azimuth) else [operand_of(azimuth)]
