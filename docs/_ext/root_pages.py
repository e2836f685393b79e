"""Pages for the Markdown files beside docs/, so that links to them hold on the site, too.

A page ``docs/security.md`` stands for ``SECURITY.md``: on the site it has the text of that file,
and links of any page to ``../SECURITY.md`` lead to it.
"""

import posixpath
import re
from pathlib import Path

PAGES = {
    "CHANGELOG.md": "changelog",
    "CONTRIBUTING.md": "contributing",
    "README.md": "index",
    "SECURITY.md": "security",
}
LINK = re.compile(r"(?<=\]\()(?![a-z]+:|#)([^)#\s]+)")


def _linked(text, folder):
    """Return a text of a folder, seen from the root, whose links are those of a page of docs/."""

    def target(link):
        file = posixpath.normpath(posixpath.join(folder, link[1]))
        return f"{PAGES[file]}.md" if file in PAGES else posixpath.relpath(file, "docs")

    return LINK.sub(target, text)


def _read(app, name, source):
    root = Path(app.srcdir).parent
    if "/" in name:
        return
    for file, page in PAGES.items():
        if page == name != "index":
            app.env.note_dependency(str(root / file))
            source[0] = _linked((root / file).read_text("utf-8"), "")
            return
    source[0] = _linked(source[0], "docs")


def setup(app):
    """Replace what is read of the pages."""
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
