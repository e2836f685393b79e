"""Polarised light along optical paths.

Optical elements are nodes of a path graph, each with its own reference frames. A composer aligns
the frames and orders the work; the plan it makes runs on one set of values or on millions.

Names of a kind are in groups: `errors` (and warnings), `fields` (types of those of elements of
one's own), `plots` and `surfaces`. What there is besides, the stub ``__init__.pyi`` lists by kind.
"""

import optipath.cli.interruption  # noqa: F401 - before all else, for Ctrl-C while it is imported
from optipath.public_names import public_names

__getattr__, __dir__, __all__ = public_names(__name__)
