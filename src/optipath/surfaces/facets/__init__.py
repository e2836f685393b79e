"""The single-scattering model: rough surfaces as facets that light meets once."""
