"""Pictures of light and of matrices: ellipses, the Poincare sphere, bars, maps of elements."""
