"""LightPath: one way of light from a source to an end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light


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

    @property
    def intensity(self) -> npt.NDArray[Any]:
        """The intensity that it contributes, of shape (...)."""
        return self.light.intensity

    def __str__(self) -> str:
        brightest = float(np.max(self.intensity, initial=0.0))
        return f"{brightest:.6g}  {' -> '.join((*self.route, self.end))}"
