"""The site of documentation; README.md has the command that builds it."""

import os
import shutil
import sys
from importlib.metadata import version as installed_version
from pathlib import Path

from sphinx_gallery.sorting import ExplicitOrder

from optipath import Element

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "_ext"))
# Examples compile code, which is kept beside the site and not in the user's folder.
os.environ.setdefault("OPTIPATH_CACHE", str(DOCS / "gallery-pages" / "cache"))

# A name or an example that is gone would leave the page that an earlier build made of it.
shutil.rmtree(DOCS / "api" / "generated", ignore_errors=True)
for page in DOCS.glob("gallery-pages/**/plot_*.rst"):
    script = DOCS / "gallery" / page.relative_to(DOCS / "gallery-pages").with_suffix(".py")
    if not script.exists():
        page.unlink()

project = "optipath"
author = "the authors of optipath"
project_copyright = author
version = release = installed_version("optipath")

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "myst_parser",
    "sphinx_gallery.gen_gallery",
    "mathml",
    "plain_types",
    "root_pages",
]
exclude_patterns = [
    "_*",
    "api/generated/README*",
    "gallery",
    "gallery-pages/index.rst",  # the page Gallery has it within
    "**/cache",
]
templates_path = ["_templates"]
language = "en"  # Sphinx's own texts in en_GB break the search page

nitpicky = True
# The words of numpydoc for types ("array_like", "shape (..., 4)") and other libraries' names are
# no targets here; a role that names optipath is.
nitpick_ignore_regex = [("py:.*", r"(?!optipath\b).*")]
default_role = "py:obj"

autosummary_generate = True
autosummary_imported_members = True
autosummary_context = {"of_every_element": ", ".join(dir(Element))}
autodoc_typehints = "none"
autodoc_member_order = "groupwise"
autodoc_default_options = {"members": True}
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4

html_theme = "furo"
html_title = f"optipath {version}"
html_math_renderer = "mathml"
html_show_sphinx = False
html_copy_source = False
html_show_search_summary = False  # its script fetches pages, which browsers refuse of files

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "gallery-pages",
    "image_scrapers": ("shown_figure.scraper",),
    "reset_modules": ("gallery_lines.use",),
    "capture_repr": (),
    "subsection_order": ExplicitOrder(
        [f"gallery/{section}" for section in ("experiments", "instruments", "colours", "space")]
    ),
    "within_subsection_order": "ExampleTitleSortKey",
    "remove_config_comments": True,
    "first_notebook_cell": "%matplotlib inline",  # or a figure is shown as its name
    "abort_on_example_error": True,
    "show_signature": False,
    "write_computation_times": False,
    "min_reported_time": 10,
    "doc_module": ("optipath",),
    "backreferences_dir": "gallery-pages/backreferences",
}
