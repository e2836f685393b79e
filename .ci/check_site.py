"""Checks the built site: each link within it leads somewhere, and nothing is loaded from elsewhere.

    python .ci/check_site.py site

Each public name of optipath, and of the groups that it has, has its place in the reference, too.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import optipath as op

LOADING = {"img", "script", "link", "iframe", "source", "video", "audio", "embed", "object"}
LOADING |= {"track", "input", "image", "use", "feimage"}
IN_STYLES = re.compile(r"(?:@import\s|url\()\s*(?:url\()?\s*['\"]?(?:https?:)?//[^;)]*")
IN_SCRIPTS = re.compile(
    r"\b(?:import|from|fetch|importScripts)\s*\(?\s*['\"`](?:https?:)?//[^'\"`]*"
)


class Page(HTMLParser):
    """What a page links to, what it loads, its styles and scripts, and its anchors."""

    def __init__(self, file):
        super().__init__()
        self.links, self.loaded, self.anchors = [], [], set()
        self.texts, self.within = {"style": [], "script": []}, ""
        self.feed(file.read_text("utf-8"))

    def handle_starttag(self, tag, attrs):
        """Sort what a tag refers to."""
        given = {name: value.strip() for name, value in attrs if value}
        self.within = tag
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        self.texts["style"].append(given.get("style", ""))
        for name in ("href", "xlink:href", "src", "data", "poster"):
            if name in given:
                (self.loaded if tag in LOADING or name == "src" else self.links).append(given[name])
        sets = f"{given.get('srcset', '')},{given.get('imagesrcset', '')}".split(",")
        self.loaded += [each.split()[0] for each in sets if each.strip()]

    def handle_endtag(self, _tag):
        """Leave a style or a script."""
        self.within = ""

    def handle_data(self, data):
        """Keep styles and scripts."""
        if self.within in self.texts:
            self.texts[self.within].append(data)

    def loaded_elsewhere(self):
        """Yield what is loaded from elsewhere: by tags, by styles and by scripts."""
        yield from (target for target in self.loaded if urlsplit(target).netloc)
        yield from IN_STYLES.findall("\n".join(self.texts["style"]))
        yield from IN_SCRIPTS.findall("\n".join(self.texts["script"]))


def broken(target, file, pages, site):
    """Return what is wrong with a link of a file, or None."""
    parts = urlsplit(target)
    if parts.scheme == "file":
        return "which is of one machine"
    if parts.scheme or parts.netloc:
        return None
    there = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    there = there / "index.html" if there.is_dir() else there
    if not there.is_relative_to(site):
        return "which is outside the site"
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
        for target in page.loaded_elsewhere():
            yield f"{here} loads {target} from elsewhere"
        for target in page.links + page.loaded:
            if wrong := broken(target, file, pages, site):
                yield f"{here} links to {target}, {wrong}"
    for pattern, kind in ((IN_STYLES, "css"), (IN_SCRIPTS, "js")):
        for file in sorted(site.rglob(f"*.{kind}")):
            for target in pattern.findall(file.read_text("utf-8")):
                yield f"{file.relative_to(site)} loads {target} from elsewhere"
    anchors = set().union(*(page.anchors for page in pages.values()))
    groups = [op.errors, op.fields, op.plots, op.surfaces]
    for package in (op, *groups):
        for name in package.__all__:
            if (
                getattr(package, name) not in groups
                and not {f"{package.__name__}.{name}", f"optipath.{name}"} & anchors
            ):
                yield f"{package.__name__}.{name} is not in the reference; add it in docs/api"


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("give the folder of the built site, as in: python .ci/check_site.py site")
    faults = list(faults_of(Path(sys.argv[1]).resolve()))
    print("\n".join(faults) or "the site holds together, and loads nothing from elsewhere")
    sys.exit(bool(faults))
