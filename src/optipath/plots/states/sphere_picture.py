"""Light on the Poincaré sphere: a state, or the trail of a batch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import to_rgba

from optipath.errors import OptipathError, shown
from optipath.plots.colour_scale import ColourScale
from optipath.plots.line_colours import LINES
from optipath.plots.states.lights_to_draw import known_light
from optipath.plots.states.named_points import name_points
from optipath.plots.states.poincare_sphere import on_paper, sphere_axes
from optipath.plots.states.sphere_points import draw_points, draw_steps, side_keys, sphere_point
from optipath.plots.states.state_words import figures_text, state_text
from optipath.plots.titles_and_keys import head, key_below
from optipath.values.arrays.array_likes import array_of

if TYPE_CHECKING:
    import numpy.typing as npt
    from mpl_toolkits.mplot3d import Axes3D

    from optipath.light.light import Light

_MOST = 25_000
"""How many points a trail may have."""

_FEW = 12
"""Of how many each is numbered."""


def poincare(
    light: Light,
    ax: Axes3D | None = None,
    *,
    by: npt.ArrayLike | None = None,
    label: str = "",
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

    Raises
    ------
    OptipathError
        If the axes are flat, the light is no row, or `by` does not fit.
    ParameterError
        If JAX traces the light.

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
            f"light of shape {light.shape} is no trail; give one, or 1 to {_MOST} in a row, "
            "as light[0] or light[::10] picks them"
        )
    values = None if by is None else _values(by, light)
    if (values is None) != (label == ""):
        raise OptipathError(
            "by and label belong together: give both, as by=angles, label='delta (deg)', or none"
        )
    ax = sphere_axes(ax, (5.4, 5.6) if values is None else (6.4, 5.6))
    points = np.atleast_2d(sphere_point(light))
    colours, middles = _coloured(ax, values, label, len(points))
    draw_steps(ax, points[:-1], points[1:], middles, linewidths=1.4)
    there = np.asarray(np.isfinite(points).all(axis=1))
    size = 5.5 if len(points) <= _FEW else 3.5
    draw_points(ax, points[there], colours[there], size)
    _head(ax, light, there)
    key_below(ax, side_keys(points[there]))
    if values is None and light.ndim:
        _name_ends(ax, points, there)
    return ax


def _values(by: Any, light: Light) -> npt.NDArray[np.float64]:
    values = array_of("by", by, OptipathError)
    if not light.ndim:
        raise OptipathError("by colours a trail, and one light has none; leave it out")
    if values.dtype.kind not in "iuf" or values.shape != light.shape:
        raise OptipathError(
            f"by is {shown(by)}; give a number for each of the {light.size} lights, "
            "in the unit that label says"
        )
    if not np.isfinite(values).all():
        place = int(np.flatnonzero(~np.isfinite(values))[0])
        raise OptipathError(f"by[{place}] is {values[place]}; give finite numbers")
    return values.astype(float)


def _coloured(
    ax: Axes3D, values: npt.NDArray[np.float64] | None, label: str, count: int
) -> tuple[Any, Any]:
    """Return the colours of points and of the lines between them, and draw their bar."""
    if values is None:
        colours = np.tile(to_rgba(LINES[0]), (count, 1))
        return colours, colours[1:]
    scale = ColourScale.ordered(float(values.min()), float(values.max()))
    figure: Any = ax.figure
    figure.colorbar(ScalarMappable(scale.norm, scale.colours), ax=ax, label=label, shrink=0.7)
    colour_of = colormaps[scale.colours]
    middles = 0.5 * (values[1:] + values[:-1])
    return colour_of(scale.norm(values)), colour_of(scale.norm(middles))


def _head(ax: Axes3D, light: Light, there: npt.NDArray[np.bool_]) -> None:
    if not light.ndim:
        head(ax, f"{state_text(light)}\n{figures_text(light)}")
    elif not there.all():
        missing = np.count_nonzero(~there)
        head(ax, f"{missing} of {light.size} have no point: dark, or not read")


def _name_ends(ax: Axes3D, points: npt.NDArray[np.float64], there: npt.NDArray[np.bool_]) -> None:
    """Write numbers beside the points of a short trail, words beside the ends of a long one."""
    places = np.flatnonzero(there)
    if not len(places):
        return
    names = [str(place) for place in places]
    if len(places) > _FEW:
        places, names = places[[0, -1]], ["first", "last"]
    name_points(ax, on_paper(ax, points[places]), names)
