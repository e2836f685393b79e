"""What is to be said of an uncertainty besides its number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from optipath.errors import listed
from optipath.sweeps.labels.light_quantities import QUANTITIES
from optipath.sweeps.uncertainty.light_figures import figures_of
from optipath.sweeps.uncertainty.linearity import FLAT, LARGEST

if TYPE_CHECKING:
    from optipath.light.light import Light
    from optipath.sweeps.uncertainty.uncertain_value import UncertainValue

_CURE = "method='monte-carlo' needs no slopes"


def notes_of_first_order(
    light: Light, uncertain: tuple[UncertainValue, ...], uncertainties: Any, left: Any
) -> list[str]:
    """Return what is doubtful to the first order, a sentence each.

    Shapes: uncertainties (..., 10); left (..., 10, k).
    """
    notes = [
        f"{each.name} is closer to the ends of its range, {each.range_text}, than its uncertainty, "
        f"and a normal distribution would leave it; {_CURE}, and stays inside"
        for each in uncertain
        if each.leaves_its_range
    ]
    for place, each in enumerate(uncertain):
        of_one = left[..., place]
        flat, curved = of_one > FLAT, (of_one > LARGEST) & (of_one <= FLAT)
        if np.any(flat):
            notes.append(
                f"doubtful along {each.name}: {_named(flat)}: no slope here, as at an extremum, "
                f"and yet a change within the uncertainty; {_CURE}"
            )
        if np.any(curved):
            most = f"{100.0 * np.max(of_one[curved]):.2g} %"
            notes.append(
                f"doubtful along {each.name}: {_named(curved)}: changes within the uncertainty "
                f"are not as the slope says, by up to {most} of the result; {_CURE}"
            )
    if np.any(corner := ~np.isnan(figures_of(light)) & np.isnan(uncertainties)):
        notes.append(
            f"nan: {_named(corner)}: a corner, as the degree of polarisation has in unpolarised "
            f"light, or a slope that is no number; {_CURE}"
        )
    return notes


def _named(where: Any) -> str:
    """Return the quantities for which something holds, and for how many values it does."""
    paths = where.reshape(-1, len(QUANTITIES))
    names = [
        each.variable for each, some in zip(QUANTITIES, paths.any(axis=0), strict=True) if some
    ]
    count = int(paths.any(axis=1).sum())
    return listed(names) + (f" (of {count} in {len(paths)} paths)" if len(paths) > 1 else "")


def notes_of_lost_figures(lost: Any) -> list[str]:
    """Return what is said of figures that some samples do not have, if there are any.

    Shape: lost (..., 10).

    Examples
    --------
    >>> notes_of_lost_figures(np.zeros(10, bool))
    []
    """
    if not np.any(lost):
        return []
    return [f"nan: {_named(lost)}: some samples do not have it, as circular light has no AoP"]


def notes_of_lost_light(lost: Any) -> list[str]:
    """Return what is said of light that no float holds, if there is any.

    Shape: lost (...).

    Examples
    --------
    >>> notes_of_lost_light(np.array(False))
    []
    """
    count = int(np.count_nonzero(lost))
    told = f"nan: the light of {count} in {lost.size} paths is too faint or bright for a float"
    return [told] if count else []
