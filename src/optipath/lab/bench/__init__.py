"""How fast a path is: the measurements behind ``optipath bench``."""
