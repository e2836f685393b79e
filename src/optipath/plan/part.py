"""Part: a piece of a stream of light."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from optipath.light.light import Light


class Part(NamedTuple):
    """A part of a batch, and its light."""

    where: tuple[int | slice, ...]
    light: Light
