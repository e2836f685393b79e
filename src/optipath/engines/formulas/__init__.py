"""Formulas: what a path does to the numbers it is given, as one list of operations."""

from optipath.engines.formulas.formula import Formula
from optipath.engines.formulas.left import DOUBLE, LEFT, left_formula
from optipath.engines.formulas.path_formula import (
    bounds_formula,
    lights_formula,
    matrix_formula,
    slack_of,
)
from optipath.engines.formulas.stages import stages
from optipath.engines.formulas.symbol import Symbol

__all__ = [
    "DOUBLE",
    "LEFT",
    "Formula",
    "Symbol",
    "bounds_formula",
    "left_formula",
    "lights_formula",
    "matrix_formula",
    "slack_of",
    "stages",
]
