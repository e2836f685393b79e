"""Photons that walk over meshes, in compiled code."""
