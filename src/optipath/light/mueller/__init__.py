"""Mueller matrices between reference frames, and what can be read off them."""

from optipath.light.mueller.matrix import LuChipman, Mueller, stacked

__all__ = ["LuChipman", "Mueller", "stacked"]
