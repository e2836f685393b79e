"""The command line."""

from optipath.cli.main import main

__all__ = ["main"]
