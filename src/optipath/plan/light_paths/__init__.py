"""Light paths: the ways from a source to a detector one by one, with what each contributes."""
