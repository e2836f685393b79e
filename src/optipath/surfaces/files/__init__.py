"""Hemispheres in files: all that was measured, and what other software reads."""
