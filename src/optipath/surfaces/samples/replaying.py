"""What a sample is asked of the room above it: one photon, replayed."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt


class Replaying:
    """A sample whose photons can be walked again, one at a time."""

    def photon(
        self,
        number: int,
        incidence: Any = 0.0,
        *,
        seed: int = 0,
        azimuth: Any = 0.0,
        wavelength: str | npt.ArrayLike | None = None,
        stokes: npt.ArrayLike = (1.0, 0.0, 0.0, 0.0),
        most_events: int = 1000,
    ) -> Any:
        """Return one of the photons that `energy` counts, with all that happens to it.

        Parameters
        ----------
        number : int
            Which photon, from 0. Those of its block of 16384 that come before it are walked, too.
        incidence : float or str, optional
            The angle of incidence in radians, 0 up to pi/2, or a text such as ``"60 deg"``.
        seed : int, optional
            That which `energy` is given.
        azimuth : float or str, optional
            Towards which side the light goes, from x towards y of the sample. On an isotropic
            sample each photon has an azimuth of its own.
        wavelength : float, str or array_like, optional
            In metres, or ``"550 nm"``, where an index depends on it; several as `energy` has them.
        stokes : array_like, optional
            The Stokes vector of the light, the x of its frame horizontal; unpolarised by default.
        most_events : int, optional
            After how many events it is given up.

        Returns
        -------
        Photon

        Raises
        ------
        SurfaceError
            With all faults at once, or if photons meet nothing of a finite field.

        Examples
        --------
        >>> from optipath.surfaces.samples.sample import Sample
        >>> photon = Sample([(1.5, 0.0)]).photon(3, "40 deg")
        >>> photon
        <Photon 3 of seed 0: down after 1 event>
        >>> print(photon.events[0].onwards[2].round(6))
        -0.90353
        """
        room = import_module("optipath.surfaces.replay.replayed_photon")
        return room.replayed_photon(
            self,
            number,
            incidence,
            seed=seed,
            azimuth=azimuth,
            wavelength=wavelength,
            stokes=stokes,
            most_events=most_events,
        )
