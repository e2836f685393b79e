"""The way of a photon as a path: a source, an interface for each event, and a detector."""

from __future__ import annotations

from math import atan2
from typing import TYPE_CHECKING

import numpy as np

from optipath.elements.interface import Interface
from optipath.elements.source import Source
from optipath.elements.terminal import Detector
from optipath.errors import SurfaceError, shown
from optipath.kernels.fresnel.boundary import lossless_boundary
from optipath.kernels.numbers.primitives import FLOAT
from optipath.paths.path_graph import PathGraph

if TYPE_CHECKING:
    from optipath.surfaces.replay.photon import Photon
    from optipath.surfaces.replay.photon_event import PhotonEvent


def photon_path(photon: Photon, which: int | tuple[int, ...] | None = None) -> PathGraph:
    """Return the way of a photon as a path.

    Parameters
    ----------
    photon : Photon
        Which photon.
    which : int or tuple of int, optional
        Which of several wavelengths, as `Photon.path` takes it.

    Returns
    -------
    PathGraph

    Raises
    ------
    SurfaceError
        If there is no such wavelength.
    """
    shape = photon.beam.indices.n.shape
    if which is not None:
        _check_place(which, shape)
    path = PathGraph(description=repr(photon)[1:-1])
    leaves = path.add("source", Source(photon.weight, photon.beam.stokes))
    last = leaves.name
    for number, event in enumerate(photon.events, 1):
        name = f"facet-{number}"
        path.add(name, _interface(event, which))
        path.connect(last, name)
        last = f"{name}.{'reflected' if event.reflected else 'transmitted'}"
    path.add("detector", Detector())
    path.connect(last, "detector")
    return path


def _interface(event: PhotonEvent, which: int | tuple[int, ...] | None) -> Interface:
    index = event.n2 if which is None or not np.ndim(event.n2) else event.n2[which]
    angle, measured_in = event.incidence, None
    if not event.reflected and event.n1 > index:
        # Next to the critical angle, that of refraction has digits which that of incidence lacks.
        wave = lossless_boundary(FLOAT)(event.n1, index, event.cos, event.sin)
        angle, measured_in = atan2(wave.n1 * wave.s, wave.a), index
    # Facets stand at any angle to each other, for which no law of parallel faces holds.
    return Interface(index, angle, event.n1, event.turn, measured_in, parallel=False)


def _check_place(which: int | tuple[int, ...], shape: tuple[int, ...]) -> None:
    """Refuse a place of a wavelength that there is none at."""
    try:
        alone = np.empty(shape)[which].ndim == 0
    except (IndexError, TypeError, ValueError):
        alone = False
    if not alone or isinstance(which, bool):
        several = f"the wavelengths have the shape {shape}" if shape else "there is one light alone"
        cure = f"give a place in it, such as {(0,) * len(shape)}" if shape else "leave it out"
        raise SurfaceError(f"which is {shown(which)}, but {several}; {cure}")
