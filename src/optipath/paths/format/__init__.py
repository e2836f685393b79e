"""The form of preset files: keys, values, and the writing of a path."""
