"""Colour: what spectral light looks like to the standard observer, and on a display."""
