"""The optical elements, one family a file; a class of one's own is one more."""
