"""Formulas: what a path does to the numbers it is given, as one list of operations."""

from optipath.formulas.formula import Formula
from optipath.formulas.path_formula import lights_formula, matrix_formula
from optipath.formulas.stages import stages
from optipath.formulas.symbol import Symbol

__all__ = ["Formula", "Symbol", "lights_formula", "matrix_formula", "stages"]
