"""Reading presets: from a parsed TOML document to a path, all faults at once."""
