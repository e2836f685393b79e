"""The composer: validate, lower, plan; one stage a file."""

from optipath.composer.composer import Composer
from optipath.composer.ports import outlets
from optipath.composer.validate import structure_faults, validate
from optipath.composer.values import parameters_of, value_faults

__all__ = [
    "Composer",
    "outlets",
    "parameters_of",
    "structure_faults",
    "validate",
    "value_faults",
]
