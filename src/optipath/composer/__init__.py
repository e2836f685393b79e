"""The composer: validate, lower, plan; one stage a file."""

from optipath.composer.composer import CHOICES, Composer
from optipath.composer.path_values import parameters_of, value_faults
from optipath.composer.validate import partial_faults, validate
from optipath.composer.wiring import KEPT, LOOPS, Wiring

__all__ = [
    "CHOICES",
    "KEPT",
    "LOOPS",
    "Composer",
    "Wiring",
    "parameters_of",
    "partial_faults",
    "validate",
    "value_faults",
]
