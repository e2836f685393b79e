"""PlaneQuantity: what curves in the plane of incidence show."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optipath.errors import SurfaceError
from optipath.sweeps.labels.light_quantities import QUANTITIES as OF_LIGHT

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from optipath.plots.hemispheres.plane_cut import PlaneCut

    Numbers = npt.NDArray[np.float64]

_OF_LIGHT = {each.variable: each for each in OF_LIGHT}


class PlaneQuantity(NamedTuple):
    """What curves in the plane of incidence show."""

    variable: str
    label: str
    of: Callable[[PlaneCut, Numbers], Numbers]
    limits: tuple[float | None, float | None] = (None, None)
    known_to: float = np.inf
    period: float = np.inf

    def known(self, cut: PlaneCut, known_to: float | None) -> tuple[Numbers, Numbers]:
        """Return it with its standard errors, NaN where it is not known.

        Shape: returns value, error (columns,).
        """
        if self.variable == "difference" and any(cut.seen.source[1:]):
            raise SurfaceError("difference is of unpolarised light; leave source out")
        own = cut.seen.measured.own
        value, error = own.estimate(lambda numbers: self.of(cut, numbers))
        if np.isfinite(self.period):
            half = self.period / 2.0
            _, error = own.estimate(
                lambda numbers: np.remainder(self.of(cut, numbers) - value + half, self.period)
            )
            # An angle that goes on from the other end is no line across.
            value = np.where(np.abs(np.diff(value, append=value[-1])) > half, np.nan, value)
        limit = self.known_to if known_to is None else known_to
        there = np.isinf(limit) | (error <= limit)
        return np.where(there, value, np.nan), np.where(there, error, np.nan)


def _of_light(variable: str, unit: float, cut: PlaneCut, numbers: Numbers) -> Numbers:
    return unit * np.asarray(_OF_LIGHT[variable].of(cut.light(numbers)))


def _difference(cut: PlaneCut, numbers: Numbers) -> Numbers:
    scalar, stokes = cut.scalar(numbers), cut.light(numbers).stokes
    return 100.0 * (stokes[..., 0] / scalar - 1.0)


_WHOLE = (0.0, 1.02)

QUANTITIES = (
    PlaneQuantity("S0", "S0 (1/sr)", partial(_of_light, "S0", 1.0), (0.0, None)),
    PlaneQuantity("S1", "S1 (1/sr)", partial(_of_light, "S1", 1.0)),
    PlaneQuantity("S2", "S2 (1/sr)", partial(_of_light, "S2", 1.0)),
    PlaneQuantity("S3", "S3 (1/sr)", partial(_of_light, "S3", 1.0)),
    PlaneQuantity("DoP", "degree of polarisation", partial(_of_light, "DoP", 1.0), _WHOLE, 0.1),
    PlaneQuantity(
        "DoLP", "degree of linear polarisation", partial(_of_light, "DoLP", 1.0), _WHOLE, 0.1
    ),
    PlaneQuantity(
        "AoP",
        "angle of polarisation (°)",
        partial(_of_light, "AoP", float(np.degrees(1.0))),
        (-92.0, 92.0),
        10.0,
        180.0,
    ),
    PlaneQuantity("difference", "S0 / U - 1 (%)", _difference, known_to=5.0),
)
