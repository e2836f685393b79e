"""Rough surfaces: fields of heights, samples of such layers, and photons that walk over them."""
