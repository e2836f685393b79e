"""Hemispheres: what rough samples send into all directions, by photons."""
