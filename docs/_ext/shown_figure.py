"""The pictures of the gallery: a block shows the figure that it ends with, as in a notebook."""

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
    return figure_rst([path], gallery_conf["src_dir"])
