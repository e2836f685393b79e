"""Spectra: power by wavelength, of lamps, lines and bins, and of what detectors respond to."""
