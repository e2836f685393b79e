"""Materials by name: the pages of refractiveindex.info, found and read."""
