"""StokesPicture: the light of a hemisphere for one source, as a picture in OpenEXR."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.extras import needing
from optipath.surfaces.walk.given_beam import UNPOLARISED, given_state
from optipath.values.written_files import drafted

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    import numpy.typing as npt

    from optipath.surfaces.hemispheres.hemisphere import Hemisphere

_NANOMETRE = 1e-9
_HANDEDNESS = (
    "S3 > 0 is a field that turns in time as the fingers of a right hand whose thumb points along "
    "the light, counter-clockwise to who looks at the source: right-handed to IEEE and IAU"
)
_UNIT = "W.m^-2.sr^-1"


@dataclass(frozen=True)
class StokesPicture:
    """What light of one source a hemisphere sends into each direction.

    Shape: channels (pixels, pixels).
    """

    channels: Mapping[str, npt.NDArray[np.float32]]
    attributes: Mapping[str, str]

    @classmethod
    def of(cls, hemisphere: Hemisphere, source: Any = None, side: Any = None) -> StokesPicture:
        """Return the picture of a hemisphere."""
        sides = hemisphere.seen.sides
        if side is None and len(sides) > 1:
            raise SurfaceError(
                "a picture is of one hemisphere, and the sample lets light through; give "
                "side='reflected' or side='transmitted'"
            )
        place = hemisphere.side(sides[0] if side is None else side)
        state = np.array(given_state("source", UNPOLARISED if source is None else source))
        with np.errstate(over="ignore"):
            brdf = hemisphere.brdf().to_numpy()[place]
            light = np.asarray(brdf @ (state / state[0]), np.float32)
        seen = np.where(np.isnan(light), np.float32(0.0), light)[::-1]
        return cls(
            _channels(seen, hemisphere.wavelengths),
            _attributes(hemisphere, sides[place], state),
        )

    def write(self, file: Path) -> None:
        """Write the picture."""
        with needing("pictures of Stokes vectors"):
            import OpenEXR  # noqa: PLC0415 - an extra
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        with drafted(file) as draft:
            draft.touch()  # What is wrong with the place is told by the system, not by OpenEXR.
            OpenEXR.File(header | dict(self.attributes), dict(self.channels)).write(str(draft))


def _channels(
    light: npt.NDArray[np.float32], wavelengths: npt.NDArray[np.float64]
) -> dict[str, npt.NDArray[np.float32]]:
    """Return channels by their names: a layer for each Stokes component."""
    found = {"Y": light[..., 0].mean(axis=-1)}
    for place, wavelength in enumerate(wavelengths):
        name = "Y" if np.isnan(wavelength) else _name(wavelength)
        found |= {f"S{each}.{name}": light[:, :, place, each] for each in range(4)}
    return {name: np.ascontiguousarray(each) for name, each in found.items()}


def _name(wavelength: float) -> str:
    """Return the name of a channel: the wavelength with a comma, which splits no layers.

    Examples
    --------
    >>> _name(550.25e-9)
    '550,250000nm'
    """
    return f"{wavelength / _NANOMETRE:.6f}nm".replace(".", ",")


def _attributes(
    hemisphere: Hemisphere, side: str, state: npt.NDArray[np.float64]
) -> dict[str, str]:
    told = {name: str(each) for name, each in hemisphere.dataset.attrs.items()}
    written = f"optipath {version('optipath')}"
    layout = {
        "spectralLayoutVersion": "1.0",
        "emissiveUnits": _UNIT,
        "polarisationHandedness": "right",
    }
    return (
        told
        | layout
        | {
            "software": written,
            "side": side,
            "source": " ".join(map(str, (state / state[0]).tolist())),
            "handedness": _HANDEDNESS,
            "comments": f"radiance of a sample that gets 1 W/m^2, in {_UNIT}, over directions",
        }
    )
