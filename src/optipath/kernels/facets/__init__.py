"""Facets of rough surfaces: how they stand, how many there are, and which see the light."""
