"""The page in the browser: paths, their values and what comes of them, served from this machine."""
