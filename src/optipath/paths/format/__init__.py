"""The form of preset files: keys, values, and the writing of a path."""

from optipath.paths.format import schema
from optipath.paths.format.codec import decode, decode_given
from optipath.paths.format.writer import complex_parts_of, to_toml

__all__ = ["complex_parts_of", "decode", "decode_given", "schema", "to_toml"]
