"""The face: graphs of elements, paths through points in space, files."""
