"""Materials and spectra: what depends on the wavelength."""
