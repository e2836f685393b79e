"""Polarisation ellipses: what the field of light draws across its direction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.lines import Line2D

from optipath.plots.line_colours import DASHES, FAINT, INK, LINES
from optipath.plots.own_axes import own_axes
from optipath.plots.states.drawn_ellipse import (
    draw_axes_of,
    draw_ellipse,
    draw_unpolarised,
    unpolarised_share,
)
from optipath.plots.states.lights_to_draw import lights_to_draw
from optipath.plots.states.state_words import digits, figures_text, no_ellipse, state_text
from optipath.plots.titles_and_keys import fitting, head, key_below

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes

    from optipath.light.light import Light

_REACH = 1.15
_DASHED: dict[str, Any] = {"linewidth": 0.8, "linestyle": (0, (4, 3))}
"""Of the part of one of several lights that is unpolarised."""

_SIDE = "seen towards the source (⊙\u00a0z)"


def ellipse(
    light: Light | Mapping[str, Light],
    ax: Axes | None = None,
    *,
    labels: str | Sequence[str] | None = None,
) -> Axes:
    """Draw the polarisation ellipse of light as who looks at the source sees it.

    x of the frame of the light is to the right, y upwards, and z towards the eye, so that a
    right-handed field (S3 > 0, `Light.handedness`) turns counter-clockwise, from x to y. Each
    light is drawn over the root of its own S0: the squares of the half axes a and b add up to the
    DoP, and a dashed circle has the power of the part that is unpolarised.

    Parameters
    ----------
    light : Light, or mapping of str to Light
        One, a batch of shape (n,), or single ones by their names; six at most. One alone has
        its axes and its angle drawn.
    ax : Axes, optional
        Where; a figure of its own by default, ``.figure`` of what is returned.
    labels : str or sequence of str, optional
        The name of the one, or of each of the batch.

    Returns
    -------
    Axes

    Raises
    ------
    OptipathError
        If there are too many, or they and their names do not fit.
    ParameterError
        If JAX traces the light.

    Examples
    --------
    >>> import optipath as op
    >>> ax = ellipse(op.Light([2.0, 0.0, 0.6, 0.8]))
    >>> print(ax.get_title())
    right-handed elliptical
    S0 = 2, DoP = 0.5, AoP = 45°, b/a = 0.5
    """
    several = lights_to_draw(light, labels)
    ax = own_axes(ax, (5.0, 5.8 + 0.3 * (len(several) - 1)))
    ax.axhline(0.0, color=FAINT, linewidth=0.6, zorder=0)
    ax.axvline(0.0, color=FAINT, linewidth=0.6, zorder=0)
    if len(several) == 1:
        keys = _draw_one(ax, *next(iter(several.items())))
    else:
        keys = _draw_several(ax, several)
    reach = max(_REACH, 1.1 * max(map(abs, (*ax.dataLim.min, *ax.dataLim.max))))
    ax.update_datalim([(-reach, -reach), (reach, reach)])
    ax.margins(0.0)
    # A box that shrinks instead is not known to what lays texts out.
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_ylabel("Ey / √S0")
    ax.set(xticks=(-1, 0, 1), yticks=(-1, 0, 1))
    ax.set_xlabel(f"Ex / √S0\n{fitting(ax, _SIDE)}")
    key_below(ax, keys, "small" if len(several) == 1 else "x-small")
    # Limits only grow while texts are laid out.
    ax.figure.figure.draw_without_rendering()
    ax.autoscale_view()
    return ax


def _draw_one(ax: Axes, name: str, light: Light) -> list[Any]:
    title = f"{name}: {state_text(light)}" if name else state_text(light)
    head(ax, f"{title}\n{figures_text(light)}")
    keys = []
    share = unpolarised_share(light)
    line: dict[str, Any] = {"edgecolor": FAINT, "facecolor": "#8a8a8a22", "linestyle": (0, (4, 3))}
    if circle := draw_unpolarised(ax, light, line):
        circle.set_label(fitting(ax, f"unpolarised: {_percent(share)} of S0", less=5))
        keys.append(circle)
    if not no_ellipse(light):
        curve = draw_ellipse(ax, light, {"color": LINES[0], "linewidth": 2.2})
        draw_axes_of(ax, light)
        curve.set_label(fitting(ax, f"polarised: {_percent(float(light.dop))} of S0", less=5))
        keys.insert(0, curve)
    return keys


def _draw_several(ax: Axes, several: Mapping[str, Light]) -> list[Any]:
    keys: list[Any] = []
    for place, (name, light) in enumerate(several.items()):
        line: dict[str, Any] = {"color": LINES[place], "linestyle": DASHES[place]}
        told = fitting(ax, f"{name}: {state_text(light)}, {figures_text(light)}", "x-small", less=5)
        rest = {"edgecolor": LINES[place], "facecolor": "none"} | _DASHED
        circle = draw_unpolarised(ax, light, rest)
        if no_ellipse(light):
            seen = {"color": LINES[place]} | _DASHED if circle else {"linestyle": "none"}
            keys.append(Line2D([], [], label=told, **seen))
            continue
        curve = draw_ellipse(ax, light, line | {"linewidth": 1.8})
        curve.set_label(told)
        keys.append(curve)
    if any(unpolarised_share(light) > 0.0 for light in several.values()):
        keys.append(Line2D([], [], label="unpolarised part", color=INK, **_DASHED))
    return keys


def _percent(share: float) -> str:
    return f"{digits(100.0 * share, 3)} %"
