"""The simplest model of light on a rough sample that some photons say is good enough."""

from __future__ import annotations

from typing import TYPE_CHECKING

from optipath.surfaces.decisions.model_choice import ModelChoice
from optipath.surfaces.fields.height_field import HeightField

if TYPE_CHECKING:
    from collections.abc import Sequence

    from optipath.surfaces.decisions.largest_of import LargestOf
    from optipath.surfaces.decisions.paired_run import PairedRun


def chosen_model(
    run: PairedRun, tolerance: float, smooth: float, told: Sequence[str]
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
    asked = {"single-scattering": single, "scalar": scalar}
    undecided = () if single else tuple([name for name, good in asked.items() if good is None])
    return ModelChoice(
        model,
        tolerance,
        undecided,
        smooth,
        _known(difference),
        _known(multiple),
        _known(apart),
        (*told, run.told, *evidence),
    )


def _single_scattering(
    run: PairedRun, tolerance: float
) -> tuple[bool | None, LargestOf | None, LargestOf | None, list[str]]:
    """Return whether the analytic model serves, None if that is not known, and what says so."""
    if reason := _beyond_the_model(run):
        return False, None, None, [f"single scattering: {reason}"]
    multiple, apart = run.multiple, run.beside_model
    told = [
        (
            f"of a pixel's light at most {multiple} has met the surface more than once, noise "
            "taken in"
        ),
        (
            f"the analytic model is off all light of a pixel at most by {apart}"
            f"{_verdict(apart, tolerance)}"
        ),
    ]
    return _serves(apart, tolerance), multiple, apart, told


def _known(found: LargestOf | None) -> tuple[float, float] | None:
    return None if found is None else (found.value, found.error)


def _serves(found: LargestOf, tolerance: float) -> bool | None:
    """Return whether something is within the tolerance; None if the noise does not tell."""
    if found.is_below(tolerance):
        return True
    return False if found.is_above(tolerance) else None


def _verdict(found: LargestOf, tolerance: float) -> str:
    if found.is_below(tolerance):
        return ", noise taken in: less than the tolerance"
    if found.is_above(tolerance):
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
