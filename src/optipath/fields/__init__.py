"""Types of the fields of an element of one's own: ``angle: op.fields.Angle = 0.0``."""

from optipath.public_names import public_names

__getattr__, __dir__, __all__ = public_names(__name__)
