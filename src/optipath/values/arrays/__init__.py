"""Arrays as they are given: what is taken for one, its shape, whether there is memory for it."""
