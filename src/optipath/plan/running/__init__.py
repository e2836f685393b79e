"""Running: what is given, sorted; paths one by one, step by step, or many at a time."""
