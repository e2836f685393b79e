"""Chains of vertices that light goes along: as points, or by angles."""
