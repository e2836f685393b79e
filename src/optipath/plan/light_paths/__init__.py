"""Light paths: the ways from a source to a detector one by one, with what each contributes."""

from optipath.plan.light_paths.light_path import LightPath
from optipath.plan.light_paths.listing import light_paths

__all__ = ["LightPath", "light_paths"]
