"""What a Dataset of light says: variables, coordinates, units and attributes."""
