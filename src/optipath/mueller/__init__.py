"""Mueller matrices between reference frames, and what can be read off them."""

from optipath.mueller.lu_chipman import LuChipman
from optipath.mueller.matrix import Mueller, stacked

__all__ = ["LuChipman", "Mueller", "stacked"]
