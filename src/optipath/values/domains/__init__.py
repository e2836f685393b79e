"""Domains: which values a quantity of an element may take."""
