"""Fresnel's equations: one boundary by every method, refraction, stacks of layers."""
