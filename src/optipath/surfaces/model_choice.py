"""Model choice: the simplest model of light that a rough sample needs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from typing import TYPE_CHECKING, Any, NamedTuple, Self, cast

import numpy as np
import numpy.typing as npt

from optipath.errors import SurfaceError, shown
from optipath.paths.files.schema import Faults
from optipath.surfaces.height_field import HeightField
from optipath.surfaces.hemisphere.beam import PixelMask
from optipath.surfaces.hemisphere.measure import measure
from optipath.surfaces.smooth import smooth_difference, smooth_exit
from optipath.surfaces.walk.beam import beam_of
from optipath.values.messages import PHOTONS_REPORTED, no_function
from optipath.values.precision import Numbers, whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from optipath.surfaces.hemisphere.hemisphere import Hemisphere
    from optipath.surfaces.sample import Sample


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
    >>> from optipath.surfaces.sample import Sample
    >>> found = decide(Sample([(0.2 + 3j, 0.1)]), "30 deg", 0.1, photons=100_000, sensor=8)
    >>> found.model, found.undecided
    ('single-scattering', ())
    """
    faults = Faults(whole_number("photons", photons))
    faults += no_function("progress", progress, PHOTONS_REPORTED)
    if not _is_share(tolerance):
        faults.append(
            f"tolerance is {shown(tolerance)}; give one above 0 and below 1, such as 0.02"
        )
    if side not in _SIDES:
        faults.append(f"no side is called {shown(side)}; give {' or '.join(_SIDES)}")
    mask = faults.attempt("", PixelMask, brighter_than, None)
    beam = beam_of(
        sample,
        incidence,
        azimuth,
        wavelength=wavelengths,
        seed=seed,
        most_events=most_events,
        others=faults,
    )
    if side == "transmitted" and beam.indices.opaque:
        raise SurfaceError("nothing goes through an opaque sample; give side='reflected'")
    angle = float(np.arctan2(beam.sin, beam.cos))
    smooth = smooth_difference(beam.indices, angle, side)
    change = f"{100.0 * smooth:z.3f} %"
    messages = [f"smooth interfaces, exact: polarisation changes all {side} light by {change}"]
    if _is_flat(sample):
        model = "scalar" if abs(smooth) <= tolerance else "polarized"
        messages.append("the sample is flat, so that this is all")
        return ModelChoice(model, float(tolerance), (), smooth, None, None, None, tuple(messages))
    if len(sample.layers) > 1 and side == "reflected":
        messages.append(_exit_evidence(sample, angle, wavelengths))
    walked = {"photons": photons, "wavelengths": wavelengths, "sensor": sensor, "seed": seed}
    walked |= {"azimuth": azimuth, "most_events": most_events, "threads": threads}
    run = PairedRun(sample, angle, cast("PixelMask", mask), side, walked | {"progress": progress})
    return chosen_model(run, float(tolerance), smooth, messages)


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


def _is_flat(sample: Sample) -> bool:
    return all(
        each.roughness.is_flat if isinstance(each.roughness, HeightField) else not each.is_random
        for each in sample.layers
    )


def _is_share(value: Any) -> bool:
    real = isinstance(value, Real) and not isinstance(value, bool | np.bool_)
    return real and 0.0 < float(value) < 1.0


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


@dataclass(frozen=True, eq=False)
class PairedRun:
    """Photons that fall on a sample, all that come back, and those that have met it once."""

    sample: Sample
    incidence: Any
    mask: PixelMask
    side: str
    walked: dict[str, Any]

    @cached_property
    def hemisphere(self) -> Hemisphere:
        """The light of all photons."""
        return measure(self.sample, self.incidence, **self.walked)

    @cached_property
    def once(self) -> Hemisphere:
        """The light of those of the same photons that have met the surface once."""
        return measure(self.sample, self.incidence, **self.walked, polarized="scalar", events=1)

    @cached_property
    def counts(self) -> npt.NDArray[np.bool_]:
        """The pixels that count, (rows, columns): at least one."""
        result = self.hemisphere
        light = result.scalar_light(result.side(self.side))
        counts = self.mask.bright(light)
        if not counts.any():
            raise SurfaceError(self._none_counts(light))
        return counts

    @cached_property
    def difference(self) -> LargestOf:
        """The largest abs(S0 - U) / U of a pixel at a wavelength."""
        result = self.hemisphere.relative_difference(
            self.side, brighter_than=self.mask.brighter_than
        )
        counts = self.counts
        return LargestOf.of(result.values[counts], result.se.values[counts])

    @cached_property
    def multiple(self) -> LargestOf:
        """The largest share of a pixel's light that has met the surface more than once."""
        every, single = self.hemisphere.own, self.once.own
        both = every._replace(
            sums=np.concatenate([every.sums[..., -1:], single.sums[..., -1:]], axis=-1)
        )
        value, error = both.estimate(lambda light: 1.0 - light[..., 1] / light[..., 0])
        at, counts = self.hemisphere.side(self.side), self.counts
        return LargestOf.of(value[at][counts], error[at][counts])

    @cached_property
    def beside_model(self) -> LargestOf:
        """How far the analytic model is off all light of a pixel, over that light, at most."""
        result = self.hemisphere
        model = result.single_scattering().values[..., 0, 0]
        value, error = result.own.estimate(
            lambda light: model / result.matrices(light)[:1, ..., 0, 0] - 1.0
        )
        return LargestOf.of(value[0][self.counts], error[0][self.counts])

    @property
    def told(self) -> str:
        """How it was made, in words."""
        sensor = self.hemisphere.sensor
        return (
            f"{self.hemisphere.photons:,} photons, {sensor.pixels} x {sensor.pixels} pixels, of "
            f"which {self.counts.sum()} count: {self.mask}"
        )

    def _none_counts(self, light: Numbers) -> str:
        photons, most = self.hemisphere.photons, np.nanmax(light)
        if not most:
            other = ", or look at the other side" if len(self.hemisphere.seen.sides) > 1 else ""
            return (
                f"no pixel counts: of {photons:,} photon{'s' if photons > 1 else ''} none is "
                f"{self.side}; walk more photons{other}"
            )
        brightest = most / np.nanmean(light)
        return (
            f"no pixel counts: none has {self.mask.brighter_than:g} times the mean light of the "
            f"hemisphere's pixels, and the brightest {brightest:.3g} times; give a smaller "
            f"brighter_than, such as 0.2"
        )


def chosen_model(
    run: PairedRun, tolerance: float, smooth: float, messages: Sequence[str]
) -> ModelChoice:
    """Return the simplest model that photons allow."""
    single, multiple, apart, evidence = _single_scattering(run, tolerance)
    difference = run.difference
    scalar = _serves(difference, tolerance)
    evidence.append(
        f"polarisation changes the light of a pixel at most by {difference}"
        f"{_verdict(difference, tolerance)}"
    )
    model = "single-scattering" if single else "scalar" if scalar else "polarized"
    requests = {"single-scattering": single, "scalar": scalar}
    undecided = () if single else tuple([name for name, good in requests.items() if good is None])
    return ModelChoice(
        model,
        tolerance,
        undecided,
        smooth,
        _known(difference),
        _known(multiple),
        _known(apart),
        (*messages, run.told, *evidence),
    )


def _single_scattering(
    run: PairedRun, tolerance: float
) -> tuple[bool | None, LargestOf | None, LargestOf | None, list[str]]:
    """Return whether the analytic model serves, None if that is not known, and what says so."""
    if reason := _beyond_the_model(run):
        return False, None, None, [f"single scattering: {reason}"]
    multiple, apart = run.multiple, run.beside_model
    messages = [
        (
            f"of a pixel's light at most {multiple} has met the surface more than once, noise "
            "taken in"
        ),
        (
            f"the analytic model is off all light of a pixel at most by {apart}"
            f"{_verdict(apart, tolerance)}"
        ),
    ]
    return _serves(apart, tolerance), multiple, apart, messages


def _known(result: LargestOf | None) -> tuple[float, float] | None:
    return None if result is None else (result.value, result.error)


def _serves(result: LargestOf, tolerance: float) -> bool | None:
    """Return whether something is within the tolerance; None if the noise does not tell."""
    if result.is_below(tolerance):
        return True
    return False if result.is_above(tolerance) else None


def _verdict(result: LargestOf, tolerance: float) -> str:
    if result.is_below(tolerance):
        return ", noise taken in: less than the tolerance"
    if result.is_above(tolerance):
        return ", noise taken in: more than the tolerance"
    return ", noise taken in: walk more photons to know if that is too much"


def _beyond_the_model(run: PairedRun) -> str:
    """Return why the analytic model cannot tell the light of the sample; nothing if it can."""
    if len(run.sample.layers) > 1:
        return "the sample is layered, and it tells the light of one interface"
    if run.side == "transmitted":
        return "it tells reflected light"
    rough = run.sample.layers[0].roughness
    if isinstance(rough, HeightField) and rough.alpha is None:
        return "the interface has no alpha, and it takes a density of slopes"
    return ""


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
        """Return the largest size among some numbers (...) with errors.

        >>> found = LargestOf.of([0.01, -0.05], [0.001, 0.005])
        >>> print(round(found.value, 3), found.is_below(0.07), found.is_above(0.03))
        0.05 True True
        """
        sizes, known = np.abs(np.ravel(values)), np.ravel(errors)
        message = ~np.isnan(sizes)
        if not message.any():
            return cls(np.nan, np.nan, 0.0, np.inf)
        # A pixel that is dark at one of several wavelengths has no ratio there.
        sizes, known = np.where(message, sizes, 0.0), np.where(message, known, np.nan)
        known = np.where(np.isnan(known), np.inf, known)
        at = int(np.argmax(sizes))
        # The tail of the normal distribution beyond k is below exp(-k^2 / 2).
        several = max(int(np.isfinite(known).sum()), 1)
        among = np.sqrt(_SURE * _SURE + 2.0 * np.log(several))
        least = float((sizes - among * known).max())
        most = float((sizes + _SURE * known).max())
        error = float(known[at])
        return cls(float(sizes[at]), error if error < np.inf else np.nan, max(least, 0.0), most)

    def is_below(self, limit: float) -> bool:
        """Tell whether none is above a limit, noise taken in."""
        return self.most <= limit

    def is_above(self, limit: float) -> bool:
        """Tell whether one is above a limit, noise taken in."""
        return self.least > limit

    def __str__(self) -> str:
        least, most = 100.0 * self.least, 100.0 * self.most
        return f"{least:.3g} .. {most:.3g} %" if most < np.inf else f"{least:.3g} % or more"
