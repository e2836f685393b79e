"""Published experiments on rough surfaces, done again."""
