"""Checks the built site: each link within it leads somewhere, and nothing is loaded from elsewhere.

    python .ci/check_site.py site

Each public name of optipath, op.plots and op.surfaces has its place in the reference, too.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import optipath as op

LOADING = {"img", "script", "link", "iframe", "source", "video", "audio", "embed", "object"}
ELSEWHERE = re.compile(r"@import|url\(\s*['\"]?(?:https?:)?//")


class Page(HTMLParser):
    """What a page links to, what it loads, and its anchors."""

    def __init__(self, file):
        super().__init__()
        self.links, self.loaded, self.anchors = [], [], set()
        self.feed(file.read_text("utf-8"))

    def handle_starttag(self, tag, attrs):
        """Sort what a tag refers to."""
        given = dict(attrs)
        self.anchors |= {given[name] for name in ("id", "name") if given.get(name)}
        for name in ("href", "src", "data", "poster"):
            if given.get(name):
                (self.loaded if tag in LOADING else self.links).append(given[name])


def broken(target, file, pages):
    """Return what is wrong with a link of a file, or None."""
    parts = urlsplit(target)
    if parts.scheme or parts.netloc:
        return None
    there = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    there = there / "index.html" if there.is_dir() else there
    if not there.exists():
        return "which is not there"
    if parts.fragment and there in pages and unquote(parts.fragment) not in pages[there].anchors:
        return "and that page has no such place"
    return None


def faults_of(site):
    """Yield a sentence for each fault of the site."""
    pages = {file: Page(file) for file in sorted(site.rglob("*.html"))}
    if not pages:
        yield f"{site} has no page"
    for file, page in pages.items():
        here = file.relative_to(site)
        for target in page.loaded:
            if urlsplit(target).netloc:
                yield f"{here} loads {target} from elsewhere"
        for target in page.links + page.loaded:
            if wrong := broken(target, file, pages):
                yield f"{here} links to {target}, {wrong}"
    for sheet in sorted(site.rglob("*.css")):
        if ELSEWHERE.search(sheet.read_text("utf-8")):
            yield f"{sheet.relative_to(site)} loads from elsewhere"
    anchors = set().union(*(page.anchors for page in pages.values()))
    for package in (op, op.plots, op.surfaces):
        for name in package.__all__:
            if not {f"{package.__name__}.{name}", f"optipath.{name}"} & anchors:
                yield f"{package.__name__}.{name} is not in the reference; add it in docs/api"


if __name__ == "__main__":
    faults = list(faults_of(Path(sys.argv[1]).resolve()))
    print("\n".join(faults) or "the site holds together, and loads nothing from elsewhere")
    sys.exit(bool(faults))
