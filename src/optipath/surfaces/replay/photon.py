"""Photon: one of those that are walked over a sample, with all that happens to it."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from optipath.elements.source import Source
from optipath.errors import SurfaceError, shown
from optipath.surfaces.replay.event_path import event_path
from optipath.surfaces.replay.event_table import event_table

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.frames import Frame
    from optipath.paths.path_graph import PathGraph
    from optipath.surfaces.replay.event_path import Place
    from optipath.surfaces.replay.photon_event import PhotonEvent
    from optipath.surfaces.samples.sample import Sample
    from optipath.surfaces.walk.photon_beam import PhotonBeam


@dataclass(frozen=True, eq=False, repr=False)
class Photon:
    """A photon that has been walked over a sample; ``print(photon)`` has a table of its events.

    Attributes
    ----------
    beam : PhotonBeam
        The photons of which it is one.
    number : int
        Which one.
    surface : int
        Which realisation of the sample's random surfaces it was on.
    events : tuple of PhotonEvent
        Where it has met facets, in their order.
    end : str
        How it ends: ``"up"``, ``"down"``, ``"sideways"`` beside a finite field, or ``"stuck"``
        after as many events as allowed.
    start : Frame
        That of the light that comes: z goes down, x is horizontal. On an isotropic sample it comes
        from an azimuth of its own.
    frame : Frame
        That of the light that leaves: z is its direction, x is s of the last facet.
    stokes : ndarray, shape (..., 4)
        The Stokes vector that leaves, divided by the probability of the way; for each wavelength.
    scalar : ndarray, shape (...)
        The intensity that leaves where there is no polarisation: with the mean of the shares of s
        and p at each event.
    """

    beam: PhotonBeam
    number: int
    surface: int
    events: tuple[PhotonEvent, ...]
    end: str
    start: Frame
    frame: Frame
    stokes: npt.NDArray[np.float64]
    scalar: npt.NDArray[np.float64]

    @property
    def sample(self) -> Sample:
        """What it fell on."""
        return self.beam.sample

    @property
    def seed(self) -> int:
        """That of all random numbers but those of the surfaces."""
        return self.beam.seed

    @property
    def weight(self) -> float:
        """One over the probability of the way: the product of those of all events."""
        return prod(1.0 / event.probability for event in self.events)

    def path(self, which: Place | None = None) -> PathGraph:
        """Return the way of the photon as a path, whose light is that of the photon.

        The source has the whole weight, and each event is an `Interface`. The frames of the path
        stand relative to each other, so its light is in that of the photon: the numbers of
        ``path().trace().stokes`` are `stokes`, in `frame`.

        Parameters
        ----------
        which : int or tuple of int, optional
            Which of several wavelengths, by its place; all of them by default.

        Returns
        -------
        PathGraph
            Its nodes are ``source``, ``facet-1`` and so on, and ``detector``.

        Raises
        ------
        SurfaceError
            If there is no such wavelength.

        Examples
        --------
        >>> from optipath.surfaces.samples.sample import Sample
        >>> photon = Sample([(1.5, 0.3)], cells=320).photon(7, "60 deg")
        >>> path = photon.path()
        >>> photon, bool(abs(path.trace().stokes - photon.stokes).max() < 1e-13)
        (<Photon 7 of seed 0: down after 1 event>, True)
        """
        if which is not None:
            _check_place(which, self.beam.indices.n.shape)
        source = Source(self.weight, self.beam.states[0])
        return event_path(source, self.events, which, repr(self)[1:-1])

    def __repr__(self) -> str:
        count = len(self.events)
        events = f"{count} event{'s' if count != 1 else ''}"
        return f"<Photon {self.number} of seed {self.seed}: {self.end} after {events}>"

    def __str__(self) -> str:
        stokes = np.array2string(self.stokes, precision=6)
        return f"{repr(self)[1:-1]}, with light\n{stokes}\n{event_table(self.events)}"


def _check_place(which: Place, shape: tuple[int, ...]) -> None:
    """Refuse a place at which there is no wavelength."""
    try:
        is_one = not isinstance(which, bool) and np.empty(shape)[which].ndim == 0
    except (IndexError, TypeError, ValueError):
        is_one = False
    if is_one:
        return
    if not shape:
        raise SurfaceError(f"which is {shown(which)}, but the photon has one light; leave it out")
    last = tuple(each - 1 for each in shape)
    raise SurfaceError(
        f"which is {shown(which)}, but wavelengths have the shape {shape}; give the place of one, "
        f"such as {last[0] if len(last) == 1 else last}"
    )
