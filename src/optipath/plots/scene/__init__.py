"""Paths drawn as they stand in space, or flat on an optical bench."""
