"""Mueller matrices between reference frames, and what can be read off them."""

from optipath.light.mueller.lu_chipman import LuChipman
from optipath.light.mueller.matrix import Mueller, stacked

__all__ = ["LuChipman", "Mueller", "stacked"]
