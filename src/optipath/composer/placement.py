"""Placement: how the frames at both ends of a link are aligned."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.composer.wiring import link_text
from optipath.elements.frame_checks import azimuth_at
from optipath.elements.vertex_place import AlongLeg
from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.kernels.catalog import PLAIN_TURN, TURN
from optipath.light.frame import Frame
from optipath.values.arrays import broadcast_fault
from optipath.values.operands import Operand, Operation, operand_of
from optipath.values.parameters import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from optipath.composer.wiring import Link, Port, Wiring
    from optipath.elements.element import Element
    from optipath.elements.vertex_place import VertexFrame


_ANY = Frame()


def frame_at(wiring: Wiring, name: str, port: str) -> Frame | None:
    """Return the world frame of a port; None for a port placed relatively."""
    frames = wiring.framed.get(name)
    return wiring.elements[name].frame_of(port, frames) if frames else None


def goes_straight(element: Element, enters: str, leaves: str) -> bool:
    """Tell whether light goes straight on from port to port: whether one frame serves both."""
    return element.frame_of(leaves, {enters: _ANY}) is _ANY


def azimuth_of(wiring: Wiring, link: Link) -> Any:
    """Return the turn of a relatively placed link in rad: its own, or else its element's."""
    own = wiring.azimuths.get(link)
    if own is None and link[1] in wiring.turned:
        return azimuth_at(wiring.elements[link[1]], link[2][1])
    return 0.0 if own is None else own


def alignment(wiring: Wiring, link: Link) -> Operation | None:
    """Return the turn from the frame that light leaves in to the one it enters."""
    start, end, (leaves, enters) = link
    if start in wiring.self_placed and end in wiring.self_placed:
        return wiring.elements[end].turn_from(wiring.elements[start])
    arriving = frame_at(wiring, start, leaves) if wiring.framed else None
    if arriving is not None and (expected := frame_at(wiring, end, enters)) is not None:
        c, s = arriving.turn_to(expected)
        if np.all(c == 1.0) and np.all(s == 0.0):
            return None
        return Operation(PLAIN_TURN, (Operand(c), Operand(s)))
    if wiring.framed and wiring.self_placed and (beside := _beside_vertex(wiring, link)):
        frame, vertex = beside
        return vertex.turn_to(frame, back=arriving is not None)
    azimuth = azimuth_of(wiring, link)
    return None if is_zero(azimuth) else Operation(TURN, (azimuth,))


def _beside_vertex(wiring: Wiring, link: Link) -> tuple[Frame, VertexFrame] | None:
    """Return the world frame at one end of a link, and the vertex's frame at the other, if so.

    Light that begins before a chain has the frame of its first vertex.
    """
    start, end, (leaves, enters) = link
    arriving, expected = frame_at(wiring, start, leaves), frame_at(wiring, end, enters)
    if (arriving is None) == (expected is None):
        return None
    name, port = (start, leaves) if arriving is None else (end, enters)
    if name not in wiring.self_placed and wiring.elements[name].inputs:
        return None
    vertex = vertex_frame(wiring, name, port)
    frame: Any = expected if arriving is None else arriving
    return None if vertex is None else (frame, vertex)


def along_legs(wiring: Wiring) -> Iterator[AlongLeg]:
    """Yield what must fit of world frames and of vertices next to them, once for each element."""
    if not wiring.self_placed or not wiring.framed:
        return
    entered = set()
    for link in sorted(wiring.links, key=lambda at: at[1] in wiring.self_placed):
        masks = any(getattr(wiring.elements[end], "bad", "") == "mask" for end in link[:2])
        if link[0] not in entered and not masks and (beside := _beside_vertex(wiring, link)):
            entered.add(link[1])
            yield AlongLeg.of(link_text(link), *beside)


def placement_faults(wiring: Wiring) -> list[str]:
    """Return what is wrong with the frames and turns of the links, a sentence each."""
    results = []
    for name in filter(wiring.placed.__contains__, wiring.elements):
        element, frames = wiring.elements[name], wiring.framed.get(name, {})
        shapes = {port: frame.z.shape[:-1] for port, frame in frames.items()}
        if not shapes or not broadcast_fault(shapes):
            results += element.frame_faults(name, frames)
    for link in sorted(wiring.framed_links):
        fault = _self_placed_fault(wiring, link) or _link_fault(wiring, link)
        results += [f"link '{link_text(link)}'{fault}"] if fault else []
    if wiring.placed:
        for name, element in wiring.elements.items():
            if element.merges and frame_at(wiring, name, "in") is None:
                results += _meeting_faults(wiring, name)
    legs = [] if results else [law for law in along_legs(wiring) if not law.is_open]
    return [*results, *filter(None, [law.fault() for law in legs]), *_between_faults(wiring)]


def _self_placed_fault(wiring: Wiring, link: Link) -> str:
    """Say what is wrong with a link between elements that have frames by their values."""
    start, end, _ = link
    if start in wiring.self_placed and end in wiring.self_placed:
        if link in wiring.azimuths:
            return " is turned by its vertices and by an azimuth; leave the azimuth out"
        fault = wiring.elements[end].fault_behind(wiring.elements[start])
        return f" {fault}" if fault else ""
    return ""


def _between_faults(wiring: Wiring) -> Iterator[str]:
    """Yield what is wrong with elements that stand relatively between two vertices."""
    known = wiring.placed
    for name in filter(wiring.self_placed.__contains__, wiring.elements):
        waiting = [p for p in wiring.graph.predecessors(name) if p not in known]
        seen = set(waiting)
        while waiting:
            between = waiting.pop()
            for before in wiring.graph.predecessors(between):
                if before in wiring.self_placed:
                    ends = f"the vertices '{before}' and '{name}', whose frames differ"
                    cure = "put it before or behind, or give it world frames"
                    yield f"'{between}' stands relatively between {ends}; {cure}"
                elif before not in seen | known:
                    seen.add(before)
                    waiting.append(before)


def _link_fault(wiring: Wiring, link: Link) -> str:
    start, end, (leaves, enters) = link
    own, framed = wiring.azimuths.get(link), wiring.framed
    if own is None and start not in framed and end not in framed:
        return ""
    arriving, expected = frame_at(wiring, start, leaves), frame_at(wiring, end, enters)
    element_turn = azimuth_at(wiring.elements[end], enters)
    if own is not None and not is_zero(element_turn):
        turns = f"{turn_text(own)} and {turn_text(element_turn)}"
        return f" and '{end}' both give an azimuth, {turns}; give it in one place"
    for name, port, frame in ((start, leaves, arriving), (end, enters, expected)):
        if frame is None and (frames := framed.get(name)):
            other = f"'{name}.{port}' has no world frame, though '{name}.{next(iter(frames))}' has"
            return f": {other}; give it one"
    ends_relatively = expected is None and not wiring.elements[end].outputs and own is None
    beside = _beside_vertex(wiring, link)
    if (arriving is None) != (expected is None) and not ends_relatively and beside is None:
        has, lacks = f"'{start}.{leaves}'", f"'{end}.{enters}'"
        if arriving is None:
            has, lacks = lacks, has
        return f": {has} has a world frame but {lacks} has none; give both or neither"
    if beside is None and (arriving is None or expected is None):
        return ""
    if not (own is None and is_zero(element_turn)):
        return " is turned by its world frames and by an azimuth; give one of them"
    fault = "" if arriving is None or expected is None else _turn_fault(arriving, expected)
    return f": {fault}" if fault else ""


def _turn_fault(first: Frame, second: Frame) -> str:
    """Say why one frame is no turn of the other."""
    try:
        first.turn_to(second)
    except OptipathError as fault:
        return str(fault)
    return ""


def _meeting_faults(wiring: Wiring, name: str) -> list[str]:
    links = wiring.links_to.get((name, "in"), [])
    if len(links) < 2:
        return []
    meet = f"several lights meet at '{name}' in"
    if any(link[0] in wiring.self_placed for link in links):
        return [f"{meet} frames of vertices; give each an end of its own"]
    frames = [frame for link in links if (frame := frame_at(wiring, link[0], link[2][0]))]
    for frame in frames[1:]:
        if fault := _turn_fault(frames[0], frame):
            problem = f"light from directions that differ cannot meet at '{name}': {fault}"
            return [f"{problem}; give each its own detector"]
    return [f"{meet} world frames; give '{name}' a frame of its own"] if frames else []


def is_zero(azimuth: Any) -> bool:
    """Tell whether a turn is known to be none."""
    return isinstance(azimuth, (int, float)) and azimuth == 0.0


def turn_text(turn: Any) -> str:
    """Return a turn as people write it."""
    return turn.formula if isinstance(turn, Parameter) else shown(turn)


def vertex_frame(wiring: Wiring, name: str, port: str) -> VertexFrame | None:
    """Return the frame of light at a port that comes from a vertex, or else goes to one.

    Directly, or through elements that let light go straight on; unknown where several links meet.
    """
    if not wiring.self_placed:
        return None
    return _followed(wiring, (name, port), before) or _followed(wiring, (name, port), _behind)


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
        if (result := following(wiring, port)) is None:
            return None
        port, more = result
        turns += more
    return None


def before(wiring: Wiring, port: Port) -> tuple[Port, list[Operand]] | None:
    """Return the port that all light at a port comes from, and the turns since then."""
    name, way = port
    if way not in wiring.elements[name].inputs:
        ways = {c.enters for c in wiring.couplings[name] if c.leaves == way}
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
