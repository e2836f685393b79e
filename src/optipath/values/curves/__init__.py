"""What depends on the wavelength: curves, and the values of them that stand in a path."""
