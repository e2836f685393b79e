"""Paths in space: where rays, surfaces, planes of incidence and frames are, and their pictures."""
