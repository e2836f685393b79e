"""Indices of refraction by wavelength: formulas of dispersion."""
