"""The Poincaré sphere without light: its outline, its circles, its axes and their names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import Axes3D, proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from optipath.errors import OptipathError, shown
from optipath.plots.line_colours import FAINT, INK
from optipath.plots.own_axes import own_lines
from optipath.plots.states.named_points import HALO

if TYPE_CHECKING:
    import numpy.typing as npt

_ELEVATION, _AZIMUTH = 20.0, 35.0
_REACH, _ZOOM = 1.0, 1.25
_GROUND = "#f3f6fa"
_AXIS = 1.3
"""How far the axes reach, beyond which their names stand."""

_MARK = "Poincaré sphere"
"""By which a sphere that is there is found again."""

_NAMES = (
    ("H", (1, 0, 0)),
    ("V", (-1, 0, 0)),
    ("D", (0, 1, 0)),
    ("A", (0, -1, 0)),
    ("R", (0, 0, 1)),
    ("L", (0, 0, -1)),
)

_AXES = ("S1/S0", "right", "top"), ("S2/S0", "left", "top"), ("S3/S0", "center", "bottom")
"""The names of the axes, and on which side of their ends they stand."""


def sphere_axes(given: Any, size: tuple[float, float]) -> Axes3D:
    """Return axes with a Poincaré sphere, drawn unless it is there already.

    S3 > 0 is up; the far half is fainter. The picture stands still, since its halves and its
    names are those of one point of view.
    """
    if given is None:
        given = Figure(figsize=size, layout="constrained").add_subplot(projection="3d")
        own_lines(given)
    if not isinstance(given, Axes3D):
        raise OptipathError(
            f"ax is {shown(given)}, and a sphere needs axes of three dimensions; give "
            'figure.add_subplot(projection="3d"), or leave it out'
        )
    if not any(line.get_gid() == _MARK for line in given.get_lines()):
        _draw_sphere(given)
    return given


def is_near(points: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
    """Tell which points are on the near half of the sphere.

    Shapes: points (..., 3); returns (...).

    Examples
    --------
    >>> is_near(np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]))
    array([ True, False])
    """
    return np.asarray(points @ _towards_eye() >= -1e-9)


def on_paper(ax: Axes3D, points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return where points are seen, in the flat coordinates of the axes.

    Shapes: points (n, 3); returns (n, 2).
    """
    return np.stack(proj3d.proj_transform(*points.T, ax.get_proj())[:2], axis=-1)


def _towards_eye() -> npt.NDArray[np.float64]:
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
    for first, second in ((x, y), (x, z), (y, z)):
        _draw_circle(ax, first, second)
    outline = _circle(side, np.cross(eye, side))
    ax.plot(*outline.T, color=INK, linewidth=1.0, zorder=2, gid=_MARK)
    ax.add_collection3d(Poly3DCollection([outline], facecolor=_GROUND, zorder=0))
    _draw_axes(ax)


def _circle(first: npt.NDArray[np.float64], second: npt.NDArray[np.float64]) -> Any:
    turn = np.linspace(0.0, 2.0 * np.pi, 181)[:, np.newaxis]
    return np.cos(turn) * first + np.sin(turn) * second


def _draw_circle(
    ax: Axes3D, first: npt.NDArray[np.float64], second: npt.NDArray[np.float64]
) -> None:
    points = _circle(first, second)
    near = is_near(points)[:, np.newaxis]
    front, back = np.where(near, points, np.nan), np.where(near, np.nan, points)
    width = 1.1 if second[2] == 0.0 else 0.7
    ax.plot(*front.T, color=FAINT, linewidth=width, zorder=3)
    ax.plot(*back.T, color=FAINT, linewidth=width, linestyle=(0, (2, 3)), alpha=0.6, zorder=1)


def _draw_axes(ax: Axes3D) -> None:
    style: dict[str, Any] = {"color": INK, "zorder": 8, "transform": ax.transData}
    style["path_effects"] = [*HALO]
    for name, place in _NAMES:
        point = np.array(place, float)
        (where,) = on_paper(ax, 1.13 * point[np.newaxis])
        bold = {"weight": "bold", "alpha": 1.0 if is_near(point) else 0.55}
        ax.text2D(*where, name, ha="center", va="center", **bold, **style)
    for axis, (name, across, up) in zip(np.eye(3), _AXES, strict=True):
        ends = np.outer((0.0, _AXIS), axis)
        ax.plot(*ends.T, color=FAINT, linewidth=0.7, linestyle=(0, (2, 3)), zorder=1)
        (where,) = on_paper(ax, _AXIS * axis[np.newaxis])
        ax.text2D(*where, name, ha=across, va=up, fontsize="small", **style)
