"""LightPath: one way of light from a source to an end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from optipath.light import Light


@dataclass(frozen=True)
class LightPath:
    """One way from a source to a detector or a dump.

    Attributes
    ----------
    route : tuple of str
        The out-ports by which light leaves element after element, as ``"node.port"``.
    end : str
        The detector or dump.
    bounces : int
        How often it has been reflected.
    light : Light
        What it contributes.
    """

    route: tuple[str, ...]
    end: str
    bounces: int
    light: Light

    def __str__(self) -> str:
        brightest = float(np.max(self.light.intensity, initial=0.0))
        return f"{brightest:.6g}  {' -> '.join((*self.route, self.end))}"
