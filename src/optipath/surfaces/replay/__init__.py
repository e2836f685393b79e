"""One photon of a sample, event by event, and as a path of elements."""
