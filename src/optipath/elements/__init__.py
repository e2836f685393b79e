"""The optical elements, one concept a file; a class of one's own is one more."""
