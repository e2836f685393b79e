"""The trail of light over the Poincaré sphere along a path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D

from optipath.errors import OptipathError, shown
from optipath.paths.energy import lights_along
from optipath.paths.path_graph import PathGraph
from optipath.plots.colors import FAINT, LINES
from optipath.plots.light_texts import known_light, no_ellipse
from optipath.plots.poincare_sphere import (
    draw_points,
    draw_steps,
    name_points,
    on_paper,
    side_keys,
    sphere_axes,
    sphere_point,
)
from optipath.plots.text import fitting, key_below

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt
    from mpl_toolkits.mplot3d import Axes3D

    from optipath.paths.energy import LightOnLink


_SAME = 0.02
"""How near points are, in radii, that are drawn as one."""

_STRAIGHT = "straight from light to light, not the way between"


class _State(NamedTuple):
    """A point, and the links whose light it is, by their numbers."""

    point: npt.NDArray[np.float64]
    links: list[int]

    @property
    def name(self) -> str:
        """The numbers, as few as will do."""
        return _numbers(self.links)


def poincare_path(path: PathGraph, ax: Axes3D | None = None, **values: Any) -> Axes3D:
    """Draw the light on every link of a path as points of the Poincaré sphere.

    Points are numbered in the order of travel; those that are next to the same point are one.
    Straight dashed lines join the light before an element and behind it: what it is within the
    element they do not say. Each light is in the frame in which it leaves its element, so that a
    frame that is turned between two elements turns the point, too.

    Parameters
    ----------
    path : PathGraph
        The path.
    ax : Axes3D, optional
        Where, of three dimensions; a figure of its own by default.
    **values : float or str
        Of parameters, as in `PathGraph.trace`; one value each.

    Returns
    -------
    Axes3D

    Raises
    ------
    OptipathError
        If the axes are flat, the light is a batch, or what is given is no path.
    ParameterError
        As `PathGraph.trace`; or if JAX traces a value.

    Examples
    --------
    >>> import optipath as op
    >>> ax = poincare_path(op.load_preset("senarmont"))
    >>> print(ax.get_legend().get_texts()[0].get_text())
    1  lamp → polarizer
    """
    if not isinstance(path, PathGraph):
        raise OptipathError(f"a trail is of a path, not of {shown(path)}; give a PathGraph")
    links = lights_along(path, **values)
    for link in links:
        known_light(link.light)
    if several := [link for link in links if link.light.shape]:
        raise OptipathError(
            f"{several[0].name} has light of shape {several[0].light.shape}, and a trail is of one "
            "value for each parameter; give one, or draw a batch of light with poincare()"
        )
    ax = sphere_axes(ax, (5.4, 6.2 + 0.12 * len(links)))
    points = np.stack([sphere_point(link.light) for link in links])
    _draw_links(ax, links, points)
    states = _states(points)
    places = np.array([state.point for state in states]).reshape(-1, 3)
    draw_points(ax, places, np.tile(to_rgba(LINES[0]), (len(states), 1)), 5.5)
    keys = [_key(ax, number, link) for number, link in enumerate(links, 1)]
    message = fitting(ax, _STRAIGHT, "x-small", less=5)
    line = Line2D([], [], color=FAINT, linestyle=(0, (4, 2)), label=message)
    key_below(ax, [*keys, line, *side_keys(places)], "x-small")
    if states:
        name_points(ax, on_paper(ax, places), [state.name for state in states])
    return ax


def _draw_links(ax: Axes3D, links: Sequence[LightOnLink], points: npt.NDArray[np.float64]) -> None:
    """Join the light that enters a node and the light that leaves it."""
    pairs = [
        (before, behind)
        for before, link in enumerate(links)
        for behind, other in enumerate(links)
        if link.end and link.end == other.start
    ]
    if pairs:
        starts, ends = np.transpose(pairs)
        colours = np.tile(to_rgba(FAINT), (len(pairs), 1))
        draw_steps(
            ax, points[starts], points[ends], colours, linewidths=1.2, linestyles=[(0, (4, 2))]
        )


def _states(points: npt.NDArray[np.float64]) -> list[_State]:
    """Return points that are apart, each with the numbers of its links."""
    results: list[_State] = []
    for number, point in enumerate(points, 1):
        if not np.isfinite(point).all():
            continue
        same = [state for state in results if np.linalg.norm(state.point - point) < _SAME]
        if same:
            same[0].links.append(number)
        else:
            results.append(_State(point, [number]))
    return results


def _numbers(links: Sequence[int]) -> str:
    """Return numbers in order, runs by their ends.

    >>> _numbers([1, 2, 3, 5])
    '1-3, 5'
    """
    runs: list[list[int]] = []
    for number in links:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    texts = [f"{run[0]}-{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs]
    return ", ".join(texts)


def _key(ax: Axes3D, number: int, link: LightOnLink) -> Line2D:
    """Return the line of the key that names a link, and says why it has no point."""
    start = link.start if link.end and link.leaves == "out" else f"{link.start}.{link.leaves}"
    text = f"{number}  {start} → {link.end or 'away'}"
    if np.isnan(sphere_point(link.light)).any():
        text += f" ({no_ellipse(link.light)})"
    return Line2D([], [], linestyle="none", label=fitting(ax, text, "x-small", less=5))
