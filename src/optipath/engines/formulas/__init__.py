"""Formulas: what a path does to the numbers it is given, as one list of operations."""
