"""Names beside points."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import Stroke

import optipath as op
from optipath.plots.states.named_points import name_points
from tables import rows


def square():
    """Axes of one unit, of 400 pixels a side."""
    figure = Figure(figsize=(4.0, 4.0), dpi=100)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0))
    return ax


@rows("turn", np.radians([0.0, 30.0, 60.0, 90.0, 120.0]))
def test_a_name_stands_beside_the_line_through_its_point(turn):
    ax = square()
    across = np.array([np.cos(turn), np.sin(turn)])
    ends = 0.5 + np.outer([-0.4, 0.4], across)
    ax.plot(*ends.T)
    name_points(ax, np.array([[0.5, 0.5]]), ["12"])
    box = ax.texts[0].get_window_extent()
    line = ax.transData.transform(
        ends[0] + np.linspace(0.0, 1.0, 500)[:, None] * (ends[1] - ends[0])
    )
    assert not any(box.contains(x, y) for x, y in line)


@rows("preset", ["ellipsometer-pcsa", "dichroic-sheet"])
def test_numbers_and_letters_of_a_sphere_are_seen_over_lines(preset):
    ax = op.plots.poincare_path(op.load_preset(preset))
    texts = [text for text in ax.texts if text.get_text()]
    halos = [text.get_path_effects() for text in texts]
    assert all(isinstance(each[0], Stroke) for each in halos)


def test_numbers_of_a_sphere_do_not_lie_over_the_lines_between_lights():
    ax = op.plots.poincare_path(op.load_preset("ellipsometer-pcsa"))
    ax.figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in ax.texts if text.get_text()[:1].isdigit()]
    dashed = [each for each in ax.collections if hasattr(each, "get_segments")]
    segments = np.concatenate([each.get_segments() for each in dashed])
    share = np.linspace(0.0, 1.0, 300)[:, None, None]
    points = (segments[:, 0] + share * (segments[:, 1] - segments[:, 0])).reshape(-1, 2)
    pixels = ax.transData.transform(points)
    assert len(boxes) > 1
    assert not any(((pixels > box.min) & (pixels < box.max)).all(axis=1).any() for box in boxes)
