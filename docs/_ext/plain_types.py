"""Words of types that are no names, "shape" of "array_like, shape (..., 4)", stay plain text."""

from docutils import nodes
from sphinx import addnodes

WORDS = {"shape"}


def _plain(_app, doctree):
    for reference in list(doctree.findall(addnodes.pending_xref)):
        if reference["refdomain"] == "py" and reference["reftarget"] in WORDS:
            reference.replace_self(nodes.Text(reference.astext()))


def setup(app):
    """Take the references away once a page has been read."""
    app.connect("doctree-read", _plain)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
