"""Light along a chain of vertices: vectors, planes of incidence, angles."""
