"""The choices of places of a path run the other way."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from optipath.composer.placement import azimuth_of, frame_at, is_zero
from optipath.errors import PathError
from optipath.paths.port_names import find_port

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.composer.travel import Port
    from optipath.composer.wiring import Wiring
    from optipath.paths.place_choice import PlaceChoice


def reversed_choices(
    wiring: Wiring, port_back: Callable[[str, str], str]
) -> dict[str, PlaceChoice]:
    """Return the choices of a path that stay the same choices on the way back.

    They do where nothing is turned between the ports beside each place: a node stands in the
    frame of the light that comes to it, which is that of the other port on the way back.
    """
    choices: dict[str, PlaceChoice] = wiring.graph.graph.get("choices", {})
    movable = {choice.node for choice in choices.values()}
    found = {}
    for name, choice in choices.items():
        next_ports = {
            word: _next_port(wiring, choice.node, port) for word, port in choice.behind.items()
        }
        if all(port is not None and port[0] not in movable for port in next_ports.values()):
            behind = {
                word: f"{port[0]}.{port_back(*port)}"
                for word, port in next_ports.items()
                if port is not None
            }
            found[name] = replace(choice, behind=behind)
    return found


def _next_port(wiring: Wiring, node: str, behind: str) -> Port | None:
    """Return the port that comes behind a place of a node; None where something is turned."""
    try:
        port = find_port(wiring.graph, behind, out=True)
    except PathError:
        return None
    if frame_at(wiring, *port) is not None:
        return None
    while len(links := wiring.links_from.get(port, [])) == 1:
        (link,) = links
        if not is_zero(azimuth_of(wiring, link)):
            return None
        _, end, (_, enters) = link
        if end != node:
            return end, enters
        port = node, wiring.elements[node].natural
    return None
