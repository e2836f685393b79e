"""Model choice: the simplest model of light that a rough sample needs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError
from optipath.faults import shown
from optipath.paths.files.schema import Faults
from optipath.surfaces.facet_model import alpha_of
from optipath.surfaces.hemisphere.beam import SIDES, PixelMask
from optipath.surfaces.hemisphere.measure import measure, progress_faults
from optipath.surfaces.smooth import smooth_difference, smooth_exit
from optipath.surfaces.walk.beam import MOST_PHOTONS, beam_of
from optipath.values.precision import real_number, whole_number

if TYPE_CHECKING:
    from collections.abc import Callable

    from optipath.surfaces.hemisphere.beam import Side
    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.surfaces.sample import Sample


_EXIT = np.radians(80.0)
"""Where light comes out that is told of: far from the lobe of the topmost interface."""


def decide(
    sample: Sample,
    incidence: Any,
    tolerance: float = 0.02,
    *,
    photons: int = 1 << 20,
    wavelengths: str | npt.ArrayLike | None = None,
    side: Side = "reflected",
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
    >>> from optipath.surfaces.sample import Sample
    >>> found = decide(Sample([(0.2 + 3j, 0.1)]), "30 deg", 0.1, photons=100_000, sensor=8)
    >>> found.model, found.undecided
    ('single-scattering', ())
    """
    faults = Faults(whole_number("photons", photons, 1, MOST_PHOTONS))
    faults += progress_faults(progress)
    if not 0.0 < (real_number(tolerance) or 0.0) < 1.0:
        faults.append(f"tolerance is {shown(tolerance)}; give one within 0 .. 1, such as 0.02")
    if side not in SIDES:
        faults.append(f"no side is called {shown(side)}; give {' or '.join(SIDES)}")
    mask = faults.attempt("", PixelMask, brighter_than, None)
    light = {"seed": seed, "azimuth": azimuth, "most_events": most_events}
    beam = beam_of(sample, incidence, wavelength=wavelengths, **light, others=faults)
    assert mask is not None  # noqa: S101 - or a fault has been raised
    if side == "transmitted" and beam.indices.opaque:
        raise SurfaceError("nothing goes through an opaque sample; give side='reflected'")
    tolerance, angle = float(tolerance), beam.incidence
    smooth = smooth_difference(beam.indices, angle, side)
    change = f"{100.0 * smooth:z.3f} %"
    evidence = [f"smooth interfaces, exact: polarisation changes all {side} light by {change}"]
    if sample.is_flat:
        model = "scalar" if abs(smooth) <= tolerance else "polarized"
        evidence.append("the sample is flat, so that this is all")
        return ModelChoice(model, tolerance, (), smooth, None, None, None, tuple(evidence))
    if len(sample.layers) > 1 and side == "reflected":
        evidence.append(_exit_evidence(sample, angle, wavelengths))
    light |= {"photons": photons, "wavelengths": wavelengths, "sensor": sensor}
    walk = partial(measure, sample, angle, threads=threads, progress=progress, **light)
    found = walk()
    light_there, pixels = found.scalar_light(found.side(side)), found.sensor.pixels
    counts = mask.bright(light_there)
    if not counts.any():
        brightest = np.nanmax(light_there) / (np.nanmean(light_there) or 1.0)
        raise SurfaceError(
            f"no pixel counts: of {found.photons:,} photons the brightest pixel of {side} light "
            f"has {brightest:.3g} times the mean, and brighter_than is {mask.brighter_than:g}; "
            f"walk more photons, or give a smaller brighter_than, such as 0.2"
        )
    of = f"{found.photons:,} photons, {pixels} x {pixels} pixels, of which {counts.sum()} count"
    evidence.append(f"{of}: {mask}")
    single: bool | None = False
    multiple = apart = None
    if reason := _beyond_the_model(sample, side):
        evidence.append(f"single scattering: {reason}")
    else:
        once = walk(polarized="scalar", events=1)
        multiple, apart = _single_scattering(found, once, counts)
        single = apart.within(tolerance)
        off = "the analytic model is off all light of a pixel at most by"
        evidence += [
            f"of a pixel's light at most {multiple} {_AGAIN}, noise taken in",
            f"{off} {apart}{_VERDICTS[single]}",
        ]
    relative = found.relative_difference(side, brighter_than=mask.brighter_than)
    difference = LargestOf.of(relative.values[counts], relative.se.values[counts])
    scalar = difference.within(tolerance)
    evidence.append(f"{_CHANGES} {difference}{_VERDICTS[scalar]}")
    suffices = {"single-scattering": single, "scalar": scalar}
    model = next((name for name, is_enough in suffices.items() if is_enough), "polarized")
    undecided = [name for name, enough in suffices.items() if enough is None and not single]
    known = difference[:2], multiple and multiple[:2], apart and apart[:2]
    return ModelChoice(model, tolerance, tuple(undecided), smooth, *known, tuple(evidence))


_CHANGES = "polarisation changes the light of a pixel at most by"
_AGAIN = "has met the surface more than once"
_VERDICTS = {
    True: ", noise taken in: less than the tolerance",
    False: ", noise taken in: more than the tolerance",
    None: ", noise taken in: walk more photons to know if that is too much",
}


def _exit_evidence(sample: Sample, incidence: float, wavelengths: Any) -> str:
    results = [
        np.ravel(smooth_exit(sample, incidence, _EXIT, depth, wavelengths))
        for depth in range(1, len(sample.layers))
    ]
    depth = int(np.argmax([np.abs(each).max() for each in results]))
    largest = results[depth][np.argmax(np.abs(results[depth]))]
    return (
        f"nearly smooth, exact: light off interface {depth + 2} that comes out forwards at 80 deg "
        f"changes by {100.0 * largest:z.1f} %"
    )


def _single_scattering(
    found: Hemisphere, once: Hemisphere, counts: npt.NDArray[np.bool_]
) -> tuple[LargestOf, LargestOf]:
    """Return the share of light after several events, and how far the analytic model is off."""
    sums = np.concatenate([each.own.sums[..., -1:] for each in (found, once)], axis=-1)
    several = found.own._replace(sums=sums).estimate(lambda each: 1.0 - each[..., 1] / each[..., 0])
    facets = found.single_scattering().values[..., 0, 0]
    off = found.own.estimate(lambda each: facets / found.matrices(each)[:1, ..., 0, 0] - 1.0)
    one, other = (LargestOf.of(each[0][0][counts], each[1][0][counts]) for each in (several, off))
    return one, other


def _beyond_the_model(sample: Sample, side: str) -> str:
    """Return why the analytic model cannot tell the light of the sample; nothing if it can."""
    reasons = {
        "the sample is layered, and it tells the light of one interface": len(sample.layers) > 1,
        "it tells reflected light": side == "transmitted",
        "the interface has no alpha, and it takes a density of slopes": alpha_of(sample) is None,
    }
    return next((why for why, holds in reasons.items() if holds), "")


@dataclass(frozen=True)
class ModelChoice:
    """The simplest model that is good enough, of those that were compared.

    Attributes
    ----------
    model : {"single-scattering", "scalar", "polarized"}
        The analytic model of one reflection, the walk without polarisation, or with it.
    tolerance : float
        The relative error of a pixel's light that will do.
    undecided : tuple of str
        The simpler models of which the noise does not tell whether they would do.
    smooth : float
        (S0 - U) / U of all light on that side, were all interfaces flat: exact; of several
        wavelengths, the largest.
    difference : tuple of float or None
        The largest abs(S0 - U) / U of a pixel, and its standard error; None where the sample is
        flat, and nothing was walked.
    multiple : tuple of float or None
        The largest share of a pixel's light that has met the surface more than once, and its
        standard error; None where it was not asked for.
    beside_model : tuple of float or None
        The largest abs(model - S0) / S0 of a pixel, of the analytic model of one reflection and
        all light of the pixel, and its standard error; None where it was not asked for.
    evidence : tuple of str
        All of it in words, a line each.
    """

    model: str
    tolerance: float
    undecided: tuple[str, ...]
    smooth: float
    difference: tuple[float, float] | None
    multiple: tuple[float, float] | None
    beside_model: tuple[float, float] | None
    evidence: tuple[str, ...]

    def explain(self) -> str:
        """Return the decision and its evidence as text.

        Examples
        --------
        >>> from optipath.surfaces.model_choice import decide
        >>> from optipath.surfaces.sample import Sample
        >>> print(decide(Sample([(1.5, 0.0), (2.4, 0.0)]), "60 deg").explain())
        the polarised model is needed for a tolerance of 2 %
          smooth interfaces, exact: polarisation changes all reflected light by -2.900 %
          the sample is flat, so that this is all
        """
        return "\n  ".join([self.said, *self.evidence])

    @property
    def said(self) -> str:
        """The decision in one sentence."""
        needed = self.model == "polarized" and not self.undecided
        what = "the polarised model is needed" if needed else _REASONS[self.model]
        message = f"{what} for a tolerance of {100.0 * self.tolerance:g} %"
        if not self.undecided:
            return message
        which = " or ".join([_NAMES[name] for name in self.undecided])
        return f"{message}; whether {which} would do, the noise does not tell"


_REASONS = {
    "single-scattering": "the analytic model of single scattering suffices",
    "scalar": "the model without polarisation suffices",
    "polarized": "the polarised model serves",
}

_NAMES = {"single-scattering": "single scattering", "scalar": "the model without polarisation"}


_SURE = 3.0
"""How many standard errors one number is taken to be away from what it is, at most."""


class LargestOf(NamedTuple):
    """The largest of noisy numbers, and within what it is."""

    value: float
    error: float
    least: float
    most: float

    @classmethod
    def of(cls, values: npt.ArrayLike, errors: npt.ArrayLike) -> Self:
        """Return the largest size among some numbers (...) with errors."""
        sizes = np.abs(np.ravel(values))
        if np.isnan(sizes).all():
            return cls(np.nan, np.nan, 0.0, np.inf)
        # A pixel that is dark at one of several wavelengths has no ratio there.
        known = np.where(np.isnan(sizes + np.ravel(errors)), np.inf, np.ravel(errors))
        sizes = np.nan_to_num(sizes)
        at = int(np.argmax(sizes))
        # The tail of the normal distribution beyond k is below exp(-k^2 / 2).
        several = max(int(np.isfinite(known).sum()), 1)
        among = np.sqrt(_SURE * _SURE + 2.0 * np.log(several))
        least = float((sizes - among * known).max())
        most = float((sizes + _SURE * known).max())
        error = float(known[at])
        return cls(float(sizes[at]), error if error < np.inf else np.nan, max(least, 0.0), most)

    def within(self, tolerance: float) -> bool | None:
        """Tell whether all are within a tolerance; None if the noise does not tell."""
        return True if self.most <= tolerance else False if self.least > tolerance else None

    def __str__(self) -> str:
        least, most = 100.0 * self.least, 100.0 * self.most
        return f"{least:.3g} .. {most:.3g} %" if most < np.inf else f"{least:.3g} % or more"
