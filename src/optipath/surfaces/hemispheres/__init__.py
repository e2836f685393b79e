"""Light from a sample in all directions, pixel by pixel, as a virtual ellipsometer sees it."""
