"""Other software beside optipath: one race, each name above its mark."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.ticker import LogLocator

from optipath.lab.bench.timing import duration
from optipath.plots.charts.chart_frame import LEFT, LINE, RIGHT, WIDTH
from optipath.plots.charts.chart_marks import POINTS
from optipath.plots.line_colours import FAINT, INK, LINES
from optipath.plots.text_width import shortened, width_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from optipath.lab.accuracy.peer_times import PeerTimes

_MAIN = 2.2
_ROOM = WIDTH - LEFT - RIGHT


class PeerFrame(NamedTuple):
    """Which times are seen, and in which row each name stands."""

    names: tuple[str, ...]
    rows: tuple[int, ...]
    times: tuple[float, float]

    @classmethod
    def of(cls, peers: PeerTimes) -> PeerFrame:
        """Return the frame of all names."""
        names = [shortened(racer.name, _ROOM / 2, POINTS) for racer in peers.racers]
        wide = np.array([1.04 * width_of(name, POINTS) + 0.15 for name in names])
        at = np.log10([racer.ns for racer in peers.racers])
        first = at.min() - 0.2
        # Wide enough that the last name ends within.
        decades = max(1.0, float(np.max((at - first) * _ROOM / (_ROOM - wide))))
        begin = (at - first) * _ROOM / decades
        rows = np.zeros(len(names), int)
        done: list[int] = []
        for place in np.argsort(begin)[::-1]:
            beneath = [rows[other] for other in done if begin[other] < begin[place] + wide[place]]
            rows[place] = max(beneath, default=-1) + 1
            done.append(int(place))
        times = float(10.0**first), float(10.0 ** (first + decades))
        return cls(tuple(names), tuple(rows.tolist()), times)

    @property
    def height(self) -> float:
        """How high the panel is, in inches."""
        return _MAIN + LINE * (max(self.rows) + 1.3)


def draw_peers(axes: Axes, peers: PeerTimes, frame: PeerFrame) -> None:
    """Draw error over time of all who took part in a race."""
    errors = np.log10([racer.error for racer in peers.racers])
    low, high = errors.min() - 0.7, errors.max() + 0.7
    top = low + (high - low) * frame.height / _MAIN
    axes.set(xscale="log", yscale="log", xlim=frame.times, ylim=(10.0**low, 10.0**top))
    powers = np.arange(np.ceil(low), np.floor(high) + 1)
    axes.set_yticks(10.0 ** powers[:: len(powers) // 6 + 1])
    axes.minorticks_off()
    axes.xaxis.set_major_locator(LogLocator(numticks=10))
    axes.xaxis.set_major_formatter(lambda ns, _: duration(1e-9 * ns))
    axes.tick_params(colors=INK, labelsize=POINTS)
    axes.grid(visible=True, color="#ececec", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    words: dict[str, Any] = {"fontsize": POINTS, "va": "bottom", "parse_math": False}
    across = axes.get_xaxis_transform()
    for racer, name, row in zip(peers.racers, frame.names, frame.rows, strict=True):
        colour = LINES[0] if racer.is_own else FAINT
        y = (_MAIN + LINE * (row + 0.1)) / frame.height
        in_axes = low + (top - low) * y
        axes.plot([racer.ns] * 2, [racer.error, 10.0**in_axes], color=colour, lw=0.8, alpha=0.7)
        axes.plot(racer.ns, racer.error, "o", color=colour, markersize=11)
        text = axes.text(racer.ns, y, name, transform=across, color=INK, **words)
        text.set_fontweight("normal")
    axes.set_xlabel("time a path", fontsize=POINTS, color=INK)
    axes.set_ylabel("largest error / S0", fontsize=POINTS, color=INK)
    middle = _MAIN / 2 / frame.height
    axes.yaxis.set_label_coords(-0.9 / _ROOM, middle)


def told_of_peers(peers: PeerTimes) -> list[str]:
    """Return what is said above the panel, a sentence each."""
    return [
        "Other software (grey) beside optipath (blue), in one race over random paths;",
        f"times x {peers.ratio:.3g}, which makes '{peers.shared}' as fast as above",
    ]
