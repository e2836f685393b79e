"""From what is given to light with its uncertainty."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import OptipathError, ParameterError
from optipath.plan.choosing import only
from optipath.sweeps.uncertainty.correlation import read_correlation
from optipath.sweeps.uncertainty.first_order import changes_of, spread_of
from optipath.sweeps.uncertainty.light_at import LightAt
from optipath.sweeps.uncertainty.linearity import nonlinearity_of
from optipath.sweeps.uncertainty.monte_carlo import samples_at_once, spread_of_samples
from optipath.sweeps.uncertainty.notes import (
    notes_of_first_order,
    notes_of_lost_light,
)
from optipath.sweeps.uncertainty.propagation import Propagation
from optipath.sweeps.uncertainty.read_uncertain import read_uncertain
from optipath.sweeps.uncertainty.stokes_slopes import slopes_of
from optipath.values.arrays.memory import enough_for
from optipath.values.by_name import check_named

if TYPE_CHECKING:
    import numpy.typing as npt

    from optipath.light.light import Light
    from optipath.paths.path_graph import PathGraph
    from optipath.plan.plan import Plan
    from optipath.sweeps.uncertainty.propagate_options import PropagateOptions

_BYTES = 1100
"""What a path takes for each value that is uncertain, with all that is made on the way."""

_BYTES_OF_A_SAMPLE = 2600
"""What a path takes in each sample that runs at once; those of other blocks take nothing."""


def propagate(
    path: PathGraph,
    unnamed: tuple[object, ...],
    given: dict[str, Any],
    options: PropagateOptions,
) -> Propagation:
    """Return the light of a path with its uncertainty; see `PathGraph.propagate`."""
    plan = path.compose()
    check_named("propagate", unnamed, plan.inputs.open)
    if clashes := options.clashes(plan.inputs):
        raise ParameterError(*clashes)
    exact, uncertain, faults = read_uncertain(plan.inputs, given)
    # A value whose uncertainty cannot be read is one of them all the same.
    names = [n for n, value in given.items() if isinstance(value, tuple) and n not in exact]
    correlation, wrong = read_correlation(options.correlation, names)
    faults += options.faults() + wrong
    detector, no_detector = _detector(plan, options.detector)
    faults += no_detector
    if faults:
        raise ParameterError(*faults)
    composer = options.composer
    asked = plan if composer is None else path.plan_by(composer)
    values = {n: v[0] if isinstance(v, tuple) and n in names else v for n, v in given.items()}
    asked.answers.large_angles.look(values)
    asked.answers.large_angles.look_at_uncertainties({n: given[n][1] for n in names})
    light_at = LightAt(asked, detector, exact, tuple(uncertain))
    light = light_at({})
    if options.draws:
        block = min(options.count, samples_at_once(light.shape)), *light.shape
        with enough_for(block, _BYTES_OF_A_SAMPLE, error=ParameterError):
            return _by_samples(light_at, light, correlation, options)
    with enough_for(light.shape, _BYTES * len(uncertain), error=ParameterError):
        if composer is None:
            return _to_first_order(light_at, light, correlation, options)
        exactly = replace(composer, engine="auto", dtype="float64", tolerance=None, model="auto")
        smooth = replace(light_at, plan=exactly.compose(path))
        return _to_first_order(smooth, light, correlation, options)


def _detector(plan: Plan, asked: Any) -> tuple[str, list[str]]:
    names = tuple(plan.program.detectors)
    try:
        return only("detector", names, f"propagate(detector='{names[0]}', ...)", asked), []
    except OptipathError as fault:
        return "", list(fault.faults)


def _to_first_order(
    light_at: LightAt,
    light: Light,
    correlation: npt.NDArray[np.float64],
    options: PropagateOptions,
) -> Propagation:
    slopes, method, rounding = slopes_of(light_at, options.method)
    center = light_at({})
    changes = changes_of(center, slopes, light_at.uncertain, rounding)
    changes = np.where(_is_lost(light)[..., np.newaxis, np.newaxis], np.nan, changes)
    spread = spread_of(changes, correlation)
    left = nonlinearity_of(light_at, center, changes, spread.uncertainties, correlation)
    there = np.where(_is_lost(light)[..., np.newaxis], 0.0, spread.uncertainties)
    notes = notes_of_first_order(light, light_at.uncertain, there, left)
    mean = np.asarray(light.stokes, np.float64)
    return Propagation(
        light=light,
        mean=mean,
        covariance=spread.covariance,
        uncertain=light_at.uncertain,
        method=method,
        notes=(*notes_of_lost_light(_is_lost(light)), *notes),
        uncertainties=spread.uncertainties,
        shares=spread.shares,
        left=left,
    )


def _by_samples(
    light_at: LightAt,
    light: Light,
    correlation: npt.NDArray[np.float64],
    options: PropagateOptions,
) -> Propagation:
    count, seed = options.count, options.beginning
    spread, mean, notes = spread_of_samples(light_at, light, correlation, count, seed)
    lost = _is_lost(light)
    uncertainties = np.where(lost[..., np.newaxis], np.nan, spread.uncertainties)
    return Propagation(
        light=light,
        mean=mean,
        covariance=np.where(lost[..., np.newaxis, np.newaxis], np.nan, spread.covariance),
        uncertain=light_at.uncertain,
        method=f"Monte Carlo, {count:,} samples, seed {seed}",
        notes=(*notes_of_lost_light(lost), *notes),
        uncertainties=uncertainties,
        shares=spread.shares,
        left=np.zeros_like(spread.shares),
    )


def _is_lost(light: Light) -> npt.NDArray[np.bool_]:
    """Return which light is too faint, or too bright, for a float."""
    s0 = np.asarray(light.stokes)[..., 0]
    lost = (np.abs(s0) < np.finfo(np.float64).tiny) | np.isinf(s0)
    return np.asarray(lost & (light.exponent != 0))
