"""How uncertain light is, from how uncertain the values are that a path is given."""
