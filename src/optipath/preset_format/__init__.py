"""The form of preset files: keys, values, and the writing of a path."""

from optipath.preset_format import schema
from optipath.preset_format.codec import decode, decode_given
from optipath.preset_format.writer import to_toml

__all__ = ["decode", "decode_given", "schema", "to_toml"]
