"""Sweeps: labelled axes, larger than memory, larger than one machine; uncertainty of light."""
