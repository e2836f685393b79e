"""Reading presets: from a parsed TOML document to a path, all faults at once."""

from optipath.paths.presets.reader.document import read

__all__ = ["read"]
