"""PhotonEvent: a photon meets a facet, and is reflected or refracted."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from optipath.surfaces.walk.kept_meshes import kept_meshes
from optipath.surfaces.walk.packed_meshes import HIGH, NUMBERS
from optipath.surfaces.walk.walk_layout import (
    COLUMN,
    COS,
    COS_2A,
    DIRECTION,
    FACET,
    LAYER,
    LINE,
    N1,
    N2,
    NORMAL,
    OPAQUE,
    POINT,
    REFLECTED,
    SHARE,
    SIN,
    SIN_2A,
)

if TYPE_CHECKING:
    from optipath.surfaces.walk.photon_beam import PhotonBeam
    from optipath.surfaces.walk.walked_block import WalkedBlock

Vector = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PhotonEvent:
    """A photon meets a facet.

    Vectors have three components, along the x and y of the sample and upwards.
    """

    layer: int
    facet: tuple[int, int, int]
    position: Vector
    on_mesh: Vector
    normal: Vector
    direction: Vector
    onwards: Vector
    cos: float
    sin: float
    turn: float
    reflected: bool
    probability: float
    n1: float
    n2: Any

    @property
    def incidence(self) -> float:
        """The angle of incidence in radians."""
        return atan2(self.sin, self.cos)


def event_of(
    beam: PhotonBeam, surface: int, walked: WalkedBlock, number: int, onwards: Vector
) -> PhotonEvent:
    """Return an event out of the record of a photon."""
    row = walked.record[number]
    layer, column, line, facet = (int(row[place]) for place in (LAYER, COLUMN, LINE, FACET))
    position = row[POINT : POINT + 3].copy()
    return PhotonEvent(
        layer=layer,
        facet=(column, line, facet),
        position=position,
        on_mesh=_on_mesh(beam, surface, layer, (column, line), position, walked.starts),
        normal=row[NORMAL : NORMAL + 3].copy(),
        direction=row[DIRECTION : DIRECTION + 3].copy(),
        onwards=onwards,
        cos=float(row[COS]),
        sin=float(row[SIN]),
        turn=0.5 * atan2(row[SIN_2A], row[COS_2A]),
        reflected=bool(row[REFLECTED]),
        probability=float(row[SHARE]),
        n1=float(row[N1]),
        n2=beam.indices.base if row[N2] == OPAQUE else float(row[N2]),
    )


def _on_mesh(
    beam: PhotonBeam,
    surface: int,
    layer: int,
    cell: tuple[int, int],
    position: Vector,
    starts: Vector,
) -> Vector:
    """Return a point of the walk as that of a layer's own field, in the cell that was met."""
    field = beam.sample.fields(surface)[layer]
    top = kept_meshes(beam.sample).of(surface).meshes.numbers[NUMBERS * layer + HIGH]
    shift = *starts[2 * layer : 2 * layer + 2], field.heights.max() - top
    found: Vector = position + np.array(shift)
    if field.periodic:
        middle = (np.array(cell) + 0.5) * field.spacing
        found[:2] -= np.round((found[:2] - middle) / field.size) * field.size
    return found
