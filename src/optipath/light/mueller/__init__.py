"""Mueller matrices between reference frames, and what can be read off them."""
