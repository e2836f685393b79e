"""Samples: rough interfaces one below the other, with the media between them, and their files."""
