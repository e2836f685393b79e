"""The command line."""

from optipath.cli.command import main

__all__ = ["main"]
