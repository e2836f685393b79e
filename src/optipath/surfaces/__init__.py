"""Rough surfaces: fields of heights, samples of such layers, and photons that walk over them."""

from optipath.public_names import public_names

__getattr__, __dir__, __all__ = public_names(__name__)
