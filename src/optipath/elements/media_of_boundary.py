"""MediaOfBoundary: the media on the two sides of a boundary, and what it takes over of them."""

from __future__ import annotations

from typing import Any, ClassVar

from optipath.values.arrays.read_only import changed
from optipath.values.follows import FOLLOWS
from optipath.values.made import not_known_sound


class MediaOfBoundary:
    """What a boundary has and other elements have not: media, ``outside`` in front."""

    may_follow: ClassVar[tuple[str, ...]] = ("outside",)
    lit_from_absorbing: ClassVar[bool] = False
    media_fields: ClassVar[tuple[str, str]] = ("outside", "index")

    def medium_at(self, port: str) -> Any:
        """Return the index of refraction at a port, in front or behind."""
        face: Any = self
        return face.outside if port in ("in", "reflected") else face.index

    def followed(self) -> tuple[str, ...]:
        """Return the fields that are taken over from the boundary before."""
        return tuple([name for name in self.may_follow if getattr(self, name) is FOLLOWS])

    def taking_over(self, **values: Any) -> Any:
        """Return a boundary like it with values of the one before in place of `FOLLOWS`."""
        face: Any = self
        return not_known_sound(changed(face, **values))
