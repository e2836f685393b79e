"""Lights on the Poincaré sphere: points, full on its near half and hollow on its far one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d.art3d import Line3DCollection

from optipath.plots.line_colours import INK
from optipath.plots.states.poincare_sphere import is_near

if TYPE_CHECKING:
    import numpy.typing as npt
    from mpl_toolkits.mplot3d import Axes3D

_FAR = 0.45
"""How much of a colour is seen on the far half."""


def sphere_point(light: Any) -> npt.NDArray[np.float64]:
    """Return S1, S2 and S3 over S0; NaN where light is dark or has not been read.

    Shapes: light (...); returns (..., 3).

    Examples
    --------
    >>> import optipath as op
    >>> sphere_point(op.Light([2.0, 1.0, 0.0, 0.0], exponent=-5000))
    array([0.5, 0. , 0. ])
    """
    return np.asarray(light.normalized, float)[..., 1:]


def draw_points(ax: Axes3D, points: npt.NDArray[np.float64], colours: Any, size: float) -> None:
    """Draw points on the sphere and within it.

    Shapes: points (n, 3); colours (n, 4).
    """
    near, colours = is_near(points), np.array(colours, float)
    face = np.where(near[:, np.newaxis], colours, 1.0)
    style: dict[str, Any] = {"s": size**2, "linewidths": 1.3, "depthshade": False, "zorder": 7}
    if len(points):
        ax.scatter(*points.T, facecolors=face, edgecolors=colours, **style)


def draw_steps(
    ax: Axes3D,
    starts: npt.NDArray[np.float64],
    ends: npt.NDArray[np.float64],
    colours: Any,
    **line: Any,
) -> None:
    """Draw straight lines, fainter on the far half.

    Shapes: starts, ends (n, 3); colours (n, 4).
    """
    there = np.isfinite(starts + ends).all(axis=1) & (starts != ends).any(axis=1)
    near = is_near(np.where(there[:, np.newaxis], starts + ends, 0.0))
    for side, alpha in ((there & near, 1.0), (there & ~near, _FAR)):
        if side.any():
            pairs = np.stack([starts[side], ends[side]], axis=1)
            shades = np.array(colours, float)[side]
            ax.add_collection3d(
                Line3DCollection(pairs, colors=shades, alpha=alpha, zorder=6, **line)
            )


def side_keys(points: npt.NDArray[np.float64], colour: str = INK) -> list[Line2D]:
    """Return the key of hollow points, where there are some.

    Shape: points (n, 3).
    """
    if is_near(points).all():
        return []
    mark: dict[str, Any] = {"marker": "o", "markersize": 5.0, "markerfacecolor": "white"}
    return [Line2D([], [], color=colour, linestyle="none", label="hollow: far half", **mark)]
