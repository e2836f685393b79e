"""Taps: links that read all the light of a port and take nothing of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import networkx as nx

from optipath.composer.travel import reached
from optipath.composer.wiring import link_text
from optipath.errors import listed
from optipath.values.cures import cure

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from optipath.composer.travel import Port
    from optipath.composer.wiring import Link, Wiring


_OTHER = "other light"


def sharing_faults(wiring: Wiring) -> Iterator[str]:
    """Yield a sentence for each out-port whose whole light several links would take."""
    tap = cure("connect(..., tap=True), in a file tap = true", "tap = true below its [[links]]")
    for (name, port), links in wiring.links_from.items():
        if len(links) > 1:
            ends = listed([f"'{link[1]}.{link[2][1]}'" for link in links])
            taken = f"take all but one out, by {taken_out(wiring, links)}, and put one behind the "
            put = cure(f"{taken}other with path.insert(...)", "put one behind the other")
            yield (
                f"port '{name}.{port}' feeds {ends}, and each would get all of its light; {put}, "
                f"share the light with a BeamSplitter, or read it with a tap, which takes nothing: "
                f"{tap}"
            )


def taken_out(wiring: Wiring, links: Sequence[Link]) -> str:
    """Write down the calls that take links of one port out, as far as others lead there too."""
    ends = {link: (link[1], link[2][1]) for link in links}
    # What a way by another link comes to is cut short by the link straight there.
    short = [
        link
        for link in links
        if any(
            ends[link] in reached(wiring.ports, [ends[other]]) for other in links if other != link
        )
    ]
    calls = [
        f'path.disconnect("{start}.{leaves}", "{end}.{enters}")'
        for start, end, (leaves, enters) in (short if 0 < len(short) < len(links) else links)
    ]
    return " or ".join(calls)


def without_tap(wiring: Wiring, tap: Link) -> str:
    """Write down the calls that take a tap out, and what is fed by nothing else."""
    start, end, (leaves, enters) = tap
    cut = f"path.disconnect('{start}.{leaves}', '{end}.{enters}')"
    behind = wiring.graph.subgraph(fed_by(wiring, tap))
    feeders = {link for link in wiring.graph.in_edges(behind, keys=True) if link[0] not in behind}
    if feeders != {tap} or not nx.is_directed_acyclic_graph(behind):
        return cut
    # Once nothing feeds them, they are taken out one by one without a gap to close.
    out = [f"path.remove('{name}')" for name in nx.lexicographical_topological_sort(behind)]
    return out[0] if len(out) == 1 else " and ".join([cut, *out])


def fed_by(wiring: Wiring, tap: Link) -> set[str]:
    """Return the nodes that the light of a tap comes to, at whatever port of them."""
    return {tap[1], *nx.descendants(wiring.graph, tap[1])}


def tap_faults(wiring: Wiring) -> Iterator[str]:
    """Yield a sentence for each tap whose light meets other light, and would count twice.

    What a tap reads is still on its way elsewhere. So it may go to no place that light reaches
    otherwise: no loop, no Combiner, and no end that is not its own.
    """
    if not wiring.taps:
        return
    onwards = wiring.untapped
    light_of: dict[Port, str] = dict.fromkeys(reached(onwards, wiring.starts), _OTHER)
    for tap in wiring.taps:
        text = f"tap '{link_text(tap)}'"
        waiting = [(tap[1], tap[2][1])]
        while waiting:
            port = waiting.pop()
            met = light_of.setdefault(port, text)
            if met is not text:
                yield (
                    f"the light of {text} meets {met} at '{'.'.join(port)}', where it "
                    f"would be counted twice; let it end in a Detector of its own, or share "
                    f"the light with a BeamSplitter"
                )
                break
            waiting += [later for later in onwards[port] if light_of.get(later) is not text]
