"""Light on the Poincaré sphere: states, batches, and trails along a path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox
from mpl_toolkits.mplot3d import Axes3D, proj3d
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from optipath.errors import OptipathError
from optipath.faults import shown
from optipath.plots.axes import own_lines
from optipath.plots.colors import FAINT, INK, LINES, ColourScale
from optipath.plots.labels import Label, place_labels
from optipath.plots.light_at_detector import START, axis_of, end_of, fine_steps, varied
from optipath.plots.light_texts import (
    figures_text,
    known_light,
    lights_of_one,
    no_ellipse,
    state_text,
)
from optipath.plots.text import fitting, head, key_below
from optipath.values.arrays import array_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from optipath.light.light import Light
    from optipath.paths.energy import LightOnLink
    from optipath.paths.path_graph import PathGraph
    from optipath.values.precision import Numbers


_MOST = 25_000
"""How many points a trail may have."""

_FEW = 12
"""Of how many each is numbered."""


def poincare(
    light: Light, ax: Axes3D | None = None, *, by: npt.ArrayLike | None = None, label: str = ""
) -> Axes3D:
    """Draw light as a point of the Poincaré sphere, or a batch as a trail.

    The axes are S1, S2 and S3 over S0: H, D, V and A (0, 45, 90 and -45 deg) are on the equator,
    R (S3 > 0, `Light.handedness` 1) is above and L below. Light that is partly polarised is within
    the sphere, as far from its centre as its DoP; what is hollow, or faint, is on the far half.
    Neighbours in a batch are joined by straight lines.

    Parameters
    ----------
    light : Light
        One, or a batch of shape (n,) in its order, of 25000 at most.
    ax : Axes3D, optional
        Where, of three dimensions; a figure of its own by default. What another picture of this
        kind has drawn there stays.
    by : array_like, shape (n,), optional
        Numbers that colour the trail, in the unit that `label` says; in an order from dark to
        light, and not round in a circle.
    label : str, optional
        Of the colour bar: ``"delta (deg)"``; needed with `by`.

    Returns
    -------
    Axes3D

    Examples
    --------
    >>> import optipath as op
    >>> ax = poincare(op.Light([2.0, 0.0, 0.6, 0.8]))
    >>> print(ax.get_title())
    right-handed elliptical
    S0 = 2, DoP = 0.5, AoP = 45°, b/a = 0.5
    """
    light = known_light(light)
    if light.ndim > 1 or not 0 < light.size <= _MOST:
        raise OptipathError(
            f"light of shape {light.shape} is no trail; give 1 to {_MOST} in a row, as light[::10]"
        )
    if (by is None) != (label == ""):
        raise OptipathError("by and label belong together: give both, or none")
    values = None
    if by is not None:
        values = array_of("by", by, OptipathError)
        there = values.dtype.kind in "iuf" and light.ndim and values.shape == light.shape
        if not (there and np.isfinite(values).all()):
            raise OptipathError(
                f"by is {shown(by)}; give a finite number for each light of a trail {light.shape}"
            )
        values = values.astype(float)
    ax = sphere_axes(ax, (5.4, 5.6) if values is None else (6.4, 5.6))
    points = np.atleast_2d(sphere_point(light))
    colours = middles = np.tile(to_rgba(LINES[0]), (len(points), 1))
    if values is not None:
        scale = ColourScale.ordered(float(values.min()), float(values.max()))
        colour_of = ScalarMappable(scale.norm, scale.colours)
        ax.figure.figure.colorbar(colour_of, ax=ax, label=label, shrink=0.7)
        colours = colour_of.to_rgba(values)
        middles = colour_of.to_rgba(0.5 * (values[1:] + values[:-1]))
    _draw_steps(ax, points[:-1], points[1:], middles[: len(points) - 1], linewidths=1.4)
    places = np.flatnonzero(np.isfinite(points).all(axis=1))
    _draw_points(ax, points[places], colours[places], 5.5 if len(points) <= _FEW else 3.5)
    if not light.ndim:
        head(ax, f"{state_text(light)}\n{figures_text(light)}")
    elif len(places) < light.size:
        missing = light.size - len(places)
        head(ax, f"{missing} of {light.size} have no point: dark, or not read")
    key_below(ax, _side_keys(points[places]))
    if values is None and light.ndim and len(places):
        few = len(places) <= _FEW
        names = [str(place) for place in places] if few else ["first", "last"]
        name_points(ax, _on_paper(ax, points[places if few else places[[0, -1]]]), names)
    return ax


def parameter_trail(path: PathGraph, name: str, detector: Any = None, values: Any = None) -> Axes3D:
    """Draw the light at a detector on the Poincaré sphere, coloured by a parameter."""
    (parameter,), end = varied(path, [name], {}), end_of(path, detector)
    along, argument = axis_of(path, parameter, values, START)

    def light_at(values: Numbers) -> Light:
        return path.trace_all(**{name: values})[end]

    def points_at(values: Numbers) -> Numbers:
        return sphere_point(light_at(values))

    if values is not None:
        return poincare(light_at(argument), by=along.numbers, label=along.short)
    fine = fine_steps(argument, points_at(argument), points_at, on_picture=np.asarray)
    numbers = np.interp(fine.values, argument, along.numbers)
    ax = poincare(light_at(fine.values), by=numbers, label=along.short)
    if message := fine.told(name):
        head(ax, f"{ax.get_title()}\n{message}".strip())
    return ax


_ELEVATION, _AZIMUTH = 20.0, 35.0
_REACH, _ZOOM = 1.0, 1.25
_GROUND = "#f3f6fa"
_AXIS = 1.3
"""How far the axes reach, beyond which their names stand."""

_MARK = "Poincaré sphere"
"""By which a sphere that is there is found again."""

_AXES = ("S1/S0", "HV"), ("S2/S0", "DA"), ("S3/S0", "RL")
"""The names of the axes, and of the states at both of their ends."""

_SIDES = ("right", "top"), ("left", "top"), ("center", "bottom")
"""On which side of their ends the names of axes stand."""


def sphere_axes(argument: Any, size: tuple[float, float]) -> Axes3D:
    """Return axes with a Poincaré sphere, drawn unless it is there already.

    S3 > 0 is up; the far half is fainter, and the view is fixed, since halves and names depend on
    it.
    """
    if argument is None:
        argument = Figure(figsize=size, layout="constrained").add_subplot(projection="3d")
        own_lines(argument)
    if not isinstance(argument, Axes3D):
        raise OptipathError(
            f'ax is {shown(argument)}; give figure.add_subplot(projection="3d"), or leave it out'
        )
    if not any(line.get_gid() == _MARK for line in argument.get_lines()):
        _draw_sphere(argument)
    return argument


def is_near(points: Numbers) -> npt.NDArray[np.bool_]:
    """Tell which points (..., 3) are on the near half of the sphere."""
    return np.asarray(points @ _towards_eye() >= -1e-9)


def _on_paper(ax: Axes3D, points: Numbers) -> Numbers:
    """Return where points (..., 3) are seen, in the flat coordinates (..., 2) of the axes."""
    return np.stack(proj3d.proj_transform(*points.T, ax.get_proj())[:2], axis=-1)


def _towards_eye() -> Numbers:
    up, round_ = np.radians(_ELEVATION), np.radians(_AZIMUTH)
    return np.array([np.cos(up) * np.cos(round_), np.cos(up) * np.sin(round_), np.sin(up)])


def _draw_sphere(ax: Axes3D) -> None:
    ax.view_init(elev=_ELEVATION, azim=_AZIMUTH)
    ax.set_proj_type("ortho")
    ax.disable_mouse_rotation()
    ax.computed_zorder = False
    ax.set_axis_off()
    ax.set(xlim=(-_REACH, _REACH), ylim=(-_REACH, _REACH), zlim=(-_REACH, _REACH))
    ax.set_box_aspect((1.0, 1.0, 1.0), zoom=_ZOOM)
    eye = _towards_eye()
    side = np.array([-eye[1], eye[0], 0.0]) / np.hypot(eye[0], eye[1])
    x, y, z = np.eye(3)
    for first, second, width in ((x, y, 1.1), (x, z, 0.7), (y, z, 0.7)):
        points = _circle(first, second)
        near = is_near(points)[:, np.newaxis]
        front, back = np.where(near, points, np.nan), np.where(near, np.nan, points)
        ax.plot(*front.T, color=FAINT, linewidth=width, zorder=3)
        ax.plot(*back.T, color=FAINT, linewidth=width, linestyle=(0, (2, 3)), alpha=0.6, zorder=1)
    outline = _circle(side, np.cross(eye, side))
    ax.plot(*outline.T, color=INK, linewidth=1.0, zorder=2, gid=_MARK)
    ax.add_collection3d(Poly3DCollection([outline], facecolor=_GROUND, zorder=0))
    style: dict[str, Any] = {"color": INK, "zorder": 8, "transform": ax.transData}
    style["path_effects"] = [*HALO]
    for axis, (name, states), (across, up) in zip(np.eye(3), _AXES, _SIDES, strict=True):
        for state, point in zip(states, (axis, -axis), strict=True):
            bold = {"weight": "bold", "alpha": 1.0 if is_near(point) else 0.55}
            middle = {"ha": "center", "va": "center"}
            ax.text2D(*_on_paper(ax, 1.13 * point), state, **middle, **bold, **style)
        ends = np.outer((0.0, _AXIS), axis)
        ax.plot(*ends.T, color=FAINT, linewidth=0.7, linestyle=(0, (2, 3)), zorder=1)
        where = _on_paper(ax, _AXIS * axis)
        ax.text2D(*where, name, ha=across, va=up, fontsize="small", **style)


def _circle(first: Numbers, second: Numbers) -> Any:
    turn = np.linspace(0.0, 2.0 * np.pi, 181)[:, np.newaxis]
    return np.cos(turn) * first + np.sin(turn) * second


_FAR = 0.45
"""How much of a colour is seen on the far half."""


def sphere_point(light: Any) -> Numbers:
    """Return S1, S2 and S3 over S0 (..., 3); NaN where light is dark or has not been read."""
    return np.asarray(light.normalized, float)[..., 1:]


def _draw_points(ax: Axes3D, points: Numbers, colours: Any, size: float) -> None:
    """Draw points on the sphere and within it. Shapes: points (n, 3); colours (n, 4)."""
    near, colours = is_near(points), np.array(colours, float)
    face = np.where(near[:, np.newaxis], colours, 1.0)
    style: dict[str, Any] = {"s": size**2, "linewidths": 1.3, "depthshade": False, "zorder": 7}
    if len(points):
        ax.scatter(*points.T, facecolors=face, edgecolors=colours, **style)


def _draw_steps(ax: Axes3D, starts: Numbers, ends: Numbers, colours: Any, **line: Any) -> None:
    """Draw straight lines, fainter on the far half. Shapes: starts, ends (n, 3); colours (n, 4)."""
    there = np.isfinite(starts + ends).all(axis=1) & (starts != ends).any(axis=1)
    near = is_near(np.where(there[:, np.newaxis], starts + ends, 0.0))
    for side, alpha in ((there & near, 1.0), (there & ~near, _FAR)):
        if side.any():
            pairs = np.stack([starts[side], ends[side]], axis=1)
            shades = np.array(colours, float)[side]
            ax.add_collection3d(
                Line3DCollection(pairs, colors=shades, alpha=alpha, zorder=6, **line)
            )


def _side_keys(points: Numbers) -> list[Line2D]:
    """Return the key of hollow points, where there are some. Shape: points (n, 3)."""
    if is_near(points).all():
        return []
    mark: dict[str, Any] = {"marker": "o", "markersize": 5.0, "markerfacecolor": "white"}
    return [Line2D([], [], color=INK, linestyle="none", label="hollow: far half", **mark)]


HALO = (withStroke(linewidth=2.5, foreground="white"),)
"""What keeps names readable over lines."""


def name_points(ax: Axes, points: Numbers, names: Sequence[str]) -> None:
    """Write names beside points (n, 2), over no point or text and few lines, with lines to them."""
    ax.figure.figure.draw_without_rendering()
    lines = [np.asarray(line.get_xydata()) for line in ax.lines]
    for each in ax.collections:
        lines += each.get_segments() if isinstance(each, LineCollection) else []
    taken = [text.get_window_extent() for text in ax.texts if text.get_text()]
    taken += [Bbox([pixel - 4.0, pixel + 4.0]) for pixel in ax.transData.transform(points)]
    style = {"fontsize": "small", "color": INK, "path_effects": [*HALO]}
    labels = [Label(name, point, style, 0.7) for name, point in zip(names, points, strict=True)]
    place_labels(ax, labels, lines, ax.get_window_extent(), taken=taken)


_SAME = 0.02
"""How near points are, in radii, that are drawn as one."""

_STRAIGHT = "straight from light to light, not the way between"


def poincare_path(path: PathGraph, ax: Axes3D | None = None, **values: Any) -> Axes3D:
    """Draw the light on every link of a path as points of the Poincaré sphere.

    Points are numbered in the order of travel; those that are next to the same point are one.
    Straight dashed lines join the light before an element and behind it: what it is within the
    element they do not say. Each light is in the frame in which it leaves its element, so that a
    frame that is turned between two elements turns the point, too.

    Parameters
    ----------
    path : PathGraph
    ax : Axes3D, optional
        Where, of three dimensions; a figure of its own by default.
    **values : float or str
        Of parameters, as in `PathGraph.trace`; one value each.

    Returns
    -------
    Axes3D

    Examples
    --------
    >>> import optipath as op
    >>> ax = poincare_path(op.load_preset("senarmont"))
    >>> print(ax.get_legend().get_texts()[0].get_text())
    1  lamp → polarizer
    """
    links = lights_of_one(path, "poincare_path", values)
    ax = sphere_axes(ax, (5.4, 6.2 + 0.12 * len(links)))
    points = np.stack([sphere_point(link.light) for link in links])
    # Dashed lines from the light that enters a node to that which leaves it.
    pairs = [
        (before, behind)
        for before, link in enumerate(links)
        for behind, other in enumerate(links)
        if link.end and link.end == other.start
    ]
    starts, ends = points[np.array(pairs, int).reshape(-1, 2).T]
    dashes: dict[str, Any] = {"linewidths": 1.2, "linestyles": [(0, (4, 2))]}
    _draw_steps(ax, starts, ends, np.tile(to_rgba(FAINT), (len(pairs), 1)), **dashes)
    states: list[tuple[Numbers, list[int]]] = []
    for number, point in enumerate(points, 1):
        same = [one for other, one in states if np.linalg.norm(other - point) < _SAME]
        if same:
            same[0].append(number)
        elif np.isfinite(point).all():
            states.append((point, [number]))
    places = np.array([point for point, _ in states]).reshape(-1, 3)
    _draw_points(ax, places, np.tile(to_rgba(LINES[0]), (len(states), 1)), 5.5)
    keys = [_key(ax, _link_text(number, link)) for number, link in enumerate(links, 1)]
    keys.append(_key(ax, _STRAIGHT, color=FAINT, linestyle=(0, (4, 2))))
    key_below(ax, [*keys, *_side_keys(places)], "x-small")
    if states:
        name_points(ax, _on_paper(ax, places), [_numbers(numbers) for _, numbers in states])
    return ax


def _numbers(links: Sequence[int]) -> str:
    """Return numbers in order, runs by their ends.

    >>> _numbers([1, 2, 3, 5])
    '1-3, 5'
    """
    breaks = np.flatnonzero(np.diff(links) > 1) + 1
    runs = [run.tolist() for run in np.split(links, breaks)]
    texts = [f"{run[0]}-{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs]
    return ", ".join(texts)


def _link_text(number: int, link: LightOnLink) -> str:
    """Return the number and the name of a link, and why it has no point."""
    start = link.start if link.end and link.leaves == "out" else f"{link.start}.{link.leaves}"
    text = f"{number}  {start} → {link.end or 'away'}"
    if np.isnan(sphere_point(link.light)).any():
        text += f" ({no_ellipse(link.light)})"
    return text


def _key(ax: Axes3D, text: str, **line: Any) -> Line2D:
    label = fitting(ax, text, "x-small", less=5)
    return Line2D([], [], label=label, **{"linestyle": "none", **line})
