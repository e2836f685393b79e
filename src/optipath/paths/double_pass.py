"""There and back: what light meets on its way to a mirror, and again on its way back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.composer.placement import is_zero
from optipath.composer.plain_graph import LINK_VALUES
from optipath.elements.coupling import vanishes
from optipath.elements.element import Chainable, begun, natural_of
from optipath.elements.frame_checks import azimuth_at
from optipath.elements.own_element import couplings_of
from optipath.errors import PathError
from optipath.materials.index_domains import FOLLOWS
from optipath.paths.editing import next_by_kind
from optipath.paths.path_graph import PathGraph

if TYPE_CHECKING:
    from collections.abc import Iterator


def there_and_back(*elements: Chainable) -> PathGraph:
    """Return what light passes on its way to where it turns back, and again on its way back.

    The last is where it turns, at normal incidence: a `Mirror`, an `Interface` or a `LayerStack`
    at an incidence of 0, or an element of one's own that reflects. The others are met again in
    reverse order, each as `Element.reversed` has it, and turned as they are on the way there: each
    takes the azimuth of the one that was behind it. Light comes out in the mirrored frame
    (x, -y, -z) of the first element, which its azimuth has turned.

    Parameters
    ----------
    *elements : Element, NamedElement or PathGraph
        In the order in which light meets them; a chain of several may stand for some. What has a
        name of its own is called ``name-back`` on the way back.

    Returns
    -------
    PathGraph
        For ``>>``, without source and detector.

    Raises
    ------
    PathError
        If light does not turn back at the last, or something else has no way back.

    Examples
    --------
    A quarter-wave plate before a mirror is a half-wave plate. With its axis at 22.5 deg it turns
    light at 0 deg to 45 deg, which is S2 < 0 in the frame of light that comes back.

    >>> import numpy as np
    >>> import optipath as op
    >>> plate = op.Retarder(np.pi / 2, np.pi / 8)
    >>> path = op.Source(stokes=(1, 1, 0, 0)) >> op.there_and_back(plate, op.Mirror())
    >>> path
    <PathGraph: source >> retarder >> mirror >> retarder-2>
    >>> print((path >> op.Detector()).trace().stokes.round(12) + 0.0)
    [ 1.  0. -1.  0.]
    """
    if not elements:
        raise PathError("op.there_and_back() needs elements, and last where light turns back")
    *others, last = [begun(element) for element in elements]
    PathError.raise_for([*_turning_faults(last), *_piece_faults(others)])
    there = PathGraph()
    for other in others:
        there = there >> other
    return _doubled(there, last) if others else last


def _doubled(there: PathGraph, last: PathGraph) -> PathGraph:
    """Return a path to where light turns back, and from there."""
    back, path = there.reversed(), there >> last
    (turning,) = (name for name in path if name not in there)
    names: dict[str, str] = {}
    for name in back:
        element = back.element(name)
        names[name] = next_by_kind(name, element, path) or f"{name}-back"
        path.add(names[name], element, back.nodes[name]["frames"])
    for (start, end, (leaves, enters)), about in back.edges.items():
        said = {name: about.get(name) for name in LINK_VALUES}
        path.connect(f"{names[start]}.{leaves}", f"{names[end]}.{enters}", **said)
    ((before, _, (leaves, _)),) = path.graph.in_edges(turning, keys=True)
    arrives = f"{names[before]}.{path.element(before).port_back(leaves)}"
    azimuth = azimuth_at(path.element(turning), "in")
    path.connect(turning, arrives, None if is_zero(azimuth) else azimuth)
    return path


def _turning_faults(last: PathGraph) -> Iterator[str]:
    """Say why light does not turn back at what is given last; nothing if it does."""
    name, *more = last
    if more:
        yield f"light turns back at one element, and {last} has several; give its last by itself"
        return
    element = last.element(name)
    enters, leaves = (natural_of(element, out=out) for out in (False, True))
    ways = [way for way in couplings_of(element) if (way.enters, way.leaves) == (enters, leaves)]
    if not any(way.reflects for way in ways) or element.self_placed:
        cure = "give a Mirror(), or another that reflects by its natural way"
        yield f"light does not turn back at '{name}', which is given last; {cure}"
    incidence = getattr(element, "incidence", 0.0)
    if incidence is FOLLOWS or not vanishes(incidence):
        yield f"light turns back at '{name}' at normal incidence alone; give it an incidence of 0.0"


def _piece_faults(pieces: list[PathGraph]) -> Iterator[str]:
    """Say where light begins or ends on the way, and what is chosen of it."""
    for piece in pieces:
        for name in piece:
            element = piece.element(name)
            if not element.inputs or not element.outputs:
                where = "ends" if element.inputs else "begins"
                cure = "Source() >> op.there_and_back(...) >> Detector()"
                yield f"light {where} at '{name}'; let op.there_and_back(...) stand between: {cure}"
        for name in piece.choices:
            yield f"choice '{name}' moves a node on the way there alone; give a chain without it"
