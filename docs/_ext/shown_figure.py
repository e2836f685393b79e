"""The pictures of the gallery: a block shows the figure that it ends with, as in a notebook."""

from pathlib import Path

from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

DOTS_PER_INCH = 150


def scraper(_block, block_vars, gallery_conf):
    """Save the figure that is the value of a block's last expression, and return its RST.

    Sphinx-Gallery keeps that value under the name ``___``; it is forgotten there, so that the next
    block does not show it again.
    """
    names = block_vars["example_globals"]
    figure, names["___"] = names.get("___"), None
    if not isinstance(figure, Figure):
        return ""
    path = next(block_vars["image_path_iterator"])
    figure.savefig(path, dpi=DOTS_PER_INCH)
    return figure_rst([path], gallery_conf["src_dir"], _described(figure, path))


def _described(figure, path):
    """Return what stands at the axes of a figure, for those who do not see it."""
    about = Path(path).stem.removeprefix("sphx_glr_plot_").rpartition("_")[0].replace("_", " ")
    told = [about, figure.get_suptitle()]
    for ax in figure.axes:
        x, y = ax.get_xlabel(), ax.get_ylabel()
        told += [ax.get_title(), f"{y} over {x}" if x and y else x or y]
    return "; ".join(dict.fromkeys(" ".join(text.split()) for text in told if text))
