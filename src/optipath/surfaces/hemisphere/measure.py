"""A rough sample, measured from all directions by photons that walk over it."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import SurfaceError
from optipath.extras import need
from optipath.faults import shown, unknown
from optipath.materials.quantities import YES_OR_NO
from optipath.paths.files.schema import Faults
from optipath.surfaces.energy_shares import processors
from optipath.surfaces.hemisphere.beam import CHUNK, NUMBERS, STATES, PartSums, SensedBeam
from optipath.surfaces.hemisphere.hemisphere import Hemisphere
from optipath.surfaces.hemisphere.sensor import Sensor
from optipath.surfaces.smooth import flat_light
from optipath.surfaces.walk.beam import MOST_PHOTONS, MOST_THREADS, UNPOLARISED, beam_of
from optipath.values.arrays import refuse_too_large
from optipath.values.files import input_file
from optipath.values.precision import whole_number
from optipath.values.wavelength import Wavelength

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike

    import numpy.typing as npt

    from optipath.surfaces.hemisphere.beam import Polarized
    from optipath.surfaces.hemisphere.sensor import ProjectionName
    from optipath.surfaces.sample import Sample


_MOST_EVENTS = 1000
"""From how many events on nothing is left of light between flat interfaces."""

_IN_PLANE = 1e-9
"""The sine of an azimuth whose plane of incidence is that of x, but for roundings."""


def measure(
    sample: Sample,
    incidence: Any,
    photons: int = CHUNK,
    wavelengths: str | npt.ArrayLike | None = None,
    sensor: Sensor | int | ProjectionName = 128,
    seed: int = 0,
    polarized: Polarized = "both",
    *,
    azimuth: Any = 0.0,
    events: int | None = None,
    symmetric: bool | None = None,
    most_events: int = 1000,
    threads: int | None = None,
    store: str | PathLike[str] | None = None,
    scheduler: Any = None,
    progress: Callable[[int, int], None] | None = None,
) -> Hemisphere:
    """Return the Mueller matrix of a sample for light from one direction, in all directions.

    Of a sample of flat interfaces alone all light is known, and goes into one pixel of each side:
    no photons are walked, ``photons`` and the counts are 0, and so are the errors (unless
    ``events`` or less than 1000 ``most_events`` cut the light short).

    Parameters
    ----------
    sample, incidence, seed, most_events, progress
        As `energy` takes them.
    photons : int, optional
        How many photons are walked; 2^22, some 4 million, by default.
    wavelengths : float, str or array_like, optional
        In metres, or ``["400 nm", "550 nm"]``, where an index depends on it. Several ride on the
        same photons where the base alone depends on them, and is opaque.
    sensor : Sensor, int or str, optional
        The pixels, or how many there are along a side, or their projection.
    polarized : {"both", "polarized", "scalar"}, optional
        What is measured: Mueller matrices, what light does without polarisation, or both on the
        same photons, whose difference then has a far smaller error than two separate runs.
    azimuth : float or str, optional
        Towards which side the light goes, from x towards y of the sample. On an isotropic sample
        it makes no difference, and the plane of incidence is that of x.
    events : int, optional
        After how many events light is seen: 1 for what is scattered once; any number by default.
    symmetric : bool, optional
        Whether the two sides of the plane of incidence are taken to be mirror images, which
        halves the variance; by default where the sample is isotropic and rough. One with a
        direction may be so from 0 and 180 deg, as where ``alpha`` is a pair.
    threads : int, optional
        How many walk at a time; as many as there are processors by default. Of what a `scheduler`
        computes, in each chunk; one by default.
    store : str or PathLike, optional
        A Zarr store (``.zarr``) in which every 2^22 photons, a chunk, are kept when they are
        walked. A measurement that was interrupted goes on from there, with the same bits.
    scheduler : str or distributed.Client, optional
        What walks the chunks for a store, as `PathGraph.sweep` takes it: a client, the address of
        a cluster, ``"processes"``, ``"threads"`` or ``"synchronous"``, one chunk after the other;
        by default the client that is active, else this.

    Returns
    -------
    Hemisphere

    Raises
    ------
    JobError
        If the store holds another measurement, or cannot be written; if the scheduler is lost.
    MissingExtraError
        If Numba or xarray is not installed; Dask or Zarr, for a store.

    Examples
    --------
    >>> from optipath.surfaces.sample import Sample
    >>> found = measure(Sample([(0.5 + 2.1j, 0.3)]), "40 deg", photons=16_384, sensor=16)
    >>> found.dataset.mueller.dims, dict(found.dataset.scalar.sizes)
    (('side', 'y', 'x', 'wavelength', 'out', 'in'), {'side': 1, 'y': 16, 'x': 16, 'wavelength': 1})
    """
    faults = Faults(whole_number("photons", photons, 1, MOST_PHOTONS))
    faults += [] if events is None else whole_number("events", events)
    faults += [] if threads is None else whole_number("threads", threads, 1, MOST_THREADS)
    faults += unknown("polarized", polarized, NUMBERS)
    faults += progress_faults(progress)
    pixels = faults.attempt("", Sensor.of, sensor)
    place, mirrors = faults.attempt("", store_argument, store, scheduler), symmetric
    if mirrors is not None:
        mirrors = faults.attempt("", YES_OR_NO.check, "symmetric", mirrors)
    light: dict[str, Any] = {"wavelength": wavelengths, "seed": seed, "most_events": most_events}
    beam = beam_of(sample, incidence, azimuth, **light, others=faults)
    assert pixels is not None  # noqa: S101 - or a fault has been raised
    if mirrors and not sample.isotropic and abs(np.sin(beam.azimuth)) > _IN_PLANE:
        raise SurfaceError(
            f"symmetric is True, and azimuth {np.degrees(beam.azimuth):.6g} deg; pixels are "
            f"mirrored across the plane of x, so give an azimuth of 0 or 180 deg, or leave "
            f"symmetric out"
        )
    states = (UNPOLARISED,) if polarized == "scalar" else STATES
    seen = SensedBeam(replace(beam, states=states), pixels, polarized, events)
    cure, what = "give fewer pixels, wavelengths or parts", "hemisphere of {:.3g} numbers"
    refuse_too_large(seen.shape, 24, cure, SurfaceError, what)
    # Before photons are walked.
    stored = () if place is None else ("zarr", "dask", "distributed")
    need("hemispheres", "numba", "llvmlite", "xarray", *stored)
    when = np.nan if wavelengths is None else Wavelength().resolve(wavelengths).value
    when = np.atleast_1d(np.ravel(when))
    is_known = sample.is_flat and events is None and most_events >= _MOST_EVENTS
    if mirrors is None:  # What a flat sample reflects is in one pixel, and has no noise.
        mirrors = sample.isotropic and not is_known
    if is_known:
        sums = flat_light(seen)
    elif place is None:
        walking, sums = processors() if threads is None else int(threads), PartSums.none(seen.shape)
        for number in range(-(-int(photons) // CHUNK)):  # Added in their order.
            sums.add(seen.chunk(number, int(photons), walking, progress))
    else:
        from optipath.surfaces.hemisphere import chunks  # noqa: PLC0415 - an extra

        job = chunks.ChunkJob(seen, when, int(photons))
        sums = chunks.kept_sums(job, place, scheduler, threads, progress)
    return Hemisphere(seen, sums, when, bool(mirrors))


def progress_faults(progress: object) -> list[str]:
    """Return the sentence for what is no function that is told how far photons have been walked."""
    if progress is None or callable(progress):
        return []
    wanted = "a function of two numbers: how many photons there are, and of how many"
    return [f"progress is {shown(progress)}; give {wanted}"]


def store_argument(store: Any, scheduler: Any) -> str | None:
    """Return where a measurement is to be kept; None where it is not."""
    if store is None:
        if scheduler is not None:
            raise SurfaceError(
                "scheduler= is for a measurement that is kept; give store= besides, such as "
                "store='hemisphere.zarr', or threads= for those of this process"
            )
        return None
    if input_file(store, SurfaceError).suffix != ".zarr":
        raise SurfaceError(
            f"store {shown(str(store))} is no Zarr store; give a name that ends in .zarr, such as "
            f"'hemisphere.zarr'"
        )
    place: str = os.fspath(store)
    return place
