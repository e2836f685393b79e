"""How fast a path is: the measurements behind ``optipath bench``."""

from optipath.lab.bench.report import Report, bench
from optipath.lab.bench.timing import Timing, race

__all__ = ["Report", "Timing", "bench", "race"]
