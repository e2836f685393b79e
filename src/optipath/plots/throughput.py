"""Picture of what `optipath bench` measures: rates, by optipath and by hand."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from optipath.lab.bench import rate
from optipath.plots.colors import FAINT, INK, LINES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.lab.composition import Rates
    from optipath.plots.axes import Panel


_WHO = (("optipath", "best", LINES[0]), ("networkx and NumPy by hand", "by_hand", FAINT))


def throughput(rates: Sequence[Rates]) -> Panel:
    """Return a panel for each path, with two bars for each work."""
    panels = {path: [*several][::-1] for path, several in groupby(rates, lambda each: each.path)}
    heights = [len(several) for several in panels.values()]
    figure = Figure((10.0, 1.2 + 0.45 * sum(heights) + 0.4 * len(heights)), layout="constrained")
    axes = figure.subplots(len(panels), sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    for ax, (path, several) in zip(axes, panels.items(), strict=True):
        for place, (label, field, color) in enumerate(_WHO):
            numbers = [getattr(each, field) or np.nan for each in several]
            at = np.arange(len(several)) + 0.2 - 0.4 * place
            bars = ax.barh(at, numbers, 0.4, color=color, label=label)
            texts = ["" if np.isnan(number) else rate(number) for number in numbers]
            ax.bar_label(bars, texts, padding=3, color=INK)
        ax.set_yticks(range(len(several)), [each.work for each in several])
        ax.set_title(path, loc="left", color=INK)
        ax.set_xscale("log")
        ax.spines[["top", "right"]].set_visible(False)
        ax.tick_params(colors=INK)
    axes[-1].set_xlabel("a second, at best", color=INK)
    axes[-1].margins(x=0.1)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return np.array(axes, object)
