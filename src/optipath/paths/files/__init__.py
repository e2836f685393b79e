"""Preset files: paths read from TOML and written as it."""
