"""Which model of light a rough sample needs, for a stated tolerance."""

from __future__ import annotations

from numbers import Real
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown
from optipath.paths.format.faults import Faults
from optipath.surfaces.decisions.chosen_model import chosen_model
from optipath.surfaces.decisions.model_choice import ModelChoice
from optipath.surfaces.decisions.paired_run import PairedRun
from optipath.surfaces.decisions.smooth_exit import smooth_exit
from optipath.surfaces.decisions.smooth_light import smooth_difference
from optipath.surfaces.fields.height_field import HeightField
from optipath.surfaces.hemispheres.pixel_mask import PixelMask
from optipath.surfaces.walk.given_beam import given_beam
from optipath.values.given_function import PHOTONS_TOLD, no_function
from optipath.values.whole_numbers import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.samples.sample import Sample

_SIDES = ("reflected", "transmitted")

_EXIT = np.radians(80.0)
"""Where light comes out that is told of: far from the lobe of the topmost interface."""


def decide(
    sample: Sample,
    incidence: Any,
    tolerance: float = 0.02,
    *,
    photons: int = 1 << 20,
    wavelengths: str | npt.ArrayLike | None = None,
    side: str = "reflected",
    brighter_than: float = 0.2,
    sensor: int = 64,
    seed: int = 0,
    azimuth: Any = 0.0,
    most_events: int = 1000,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> ModelChoice:
    """Return the simplest model that tells the light of each pixel within a tolerance.

    First the exact difference that polarisation makes were all interfaces smooth; of a flat sample
    that is all. Then some photons with and without polarisation, on the same ways, and on a single
    interface how far all their light is from that of the analytic model of one reflection. It is
    unpolarised light that is meant, and its intensity: who asks for states of polarisation needs
    the polarised model.

    Parameters
    ----------
    sample, incidence, photons, wavelengths, sensor, seed, azimuth, most_events, threads, progress
        As `measure` takes them.
    tolerance : float, optional
        The relative error of a pixel's light that will do, more than 0 and less than 1.
    side : {"reflected", "transmitted"}, optional
        Where light is looked at.
    brighter_than : float, optional
        Pixels count that have more light than so many times the mean; see `Hemisphere.adm`.

    Returns
    -------
    ModelChoice
        Where the noise does not tell whether a simpler model suffices, the next better one.

    Raises
    ------
    SurfaceError
        With all faults at once; if no pixel has light that counts.

    Examples
    --------
    >>> from optipath.surfaces.samples.sample import Sample
    >>> found = decide(Sample([(0.2 + 3j, 0.1)]), "30 deg", 0.1, photons=100_000, sensor=8)
    >>> found.model, found.undecided
    ('single-scattering', ())
    """
    faults = Faults(whole_number("photons", photons))
    faults += no_function("progress", progress, PHOTONS_TOLD)
    if not _is_share(tolerance):
        faults.append(
            f"tolerance is {shown(tolerance)}; give one above 0 and below 1, such as 0.02"
        )
    if side not in _SIDES:
        faults.append(f"no side is called {shown(side)}; give {' or '.join(_SIDES)}")
    mask = faults.attempt("", PixelMask, brighter_than, None)
    beam = given_beam(
        sample,
        incidence,
        azimuth,
        wavelength=wavelengths,
        seed=seed,
        most_events=most_events,
        beside=faults,
    )
    if side == "transmitted" and beam.indices.opaque:
        raise SurfaceError("nothing goes through an opaque sample; give side='reflected'")
    angle = float(np.arctan2(beam.sin, beam.cos))
    smooth = smooth_difference(beam.indices, angle, side)
    change = f"{100.0 * smooth:z.3f} %"
    told = [f"smooth interfaces, exact: polarisation changes all {side} light by {change}"]
    if _is_flat(sample):
        model = "scalar" if abs(smooth) <= tolerance else "polarized"
        told.append("the sample is flat, so that this is all")
        return ModelChoice(model, float(tolerance), (), smooth, None, None, None, tuple(told))
    if len(sample.layers) > 1 and side == "reflected":
        told.append(_exit_evidence(sample, angle, wavelengths))
    walked = {"photons": photons, "wavelengths": wavelengths, "sensor": sensor, "seed": seed}
    walked |= {"azimuth": azimuth, "most_events": most_events, "threads": threads}
    run = PairedRun(sample, angle, cast("PixelMask", mask), side, walked | {"progress": progress})
    return chosen_model(run, float(tolerance), smooth, told)


def _exit_evidence(sample: Sample, incidence: float, wavelengths: Any) -> str:
    found = [
        np.ravel(smooth_exit(sample, incidence, _EXIT, depth, wavelengths))
        for depth in range(1, len(sample.layers))
    ]
    depth = int(np.argmax([np.abs(each).max() for each in found]))
    largest = found[depth][np.argmax(np.abs(found[depth]))]
    return (
        f"nearly smooth, exact: light off interface {depth + 2} that comes out forwards at 80 deg "
        f"changes by {100.0 * largest:z.1f} %"
    )


def _is_flat(sample: Sample) -> bool:
    return all(
        each.roughness.is_flat if isinstance(each.roughness, HeightField) else not each.is_random
        for each in sample.layers
    )


def _is_share(value: Any) -> bool:
    real = isinstance(value, Real) and not isinstance(value, bool | np.bool_)
    return real and 0.0 < float(value) < 1.0
