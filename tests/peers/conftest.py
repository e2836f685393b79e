"""Pytest leaves the scripts alone: the software that they ask need not be installed."""

collect_ignore_glob = ["computing/*"]
