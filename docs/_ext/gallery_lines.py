"""The lines of the gallery's own axes: colours and dashes of op.plots, told apart in print, too."""

import matplotlib as mpl
from cycler import cycler

from optipath.plots.colors import DASHES, LINES


def use(_gallery_conf, _script):
    """Have lines without a style of their own drawn in these, before each example."""
    mpl.rcParams["axes.prop_cycle"] = cycler(color=LINES, linestyle=DASHES)
